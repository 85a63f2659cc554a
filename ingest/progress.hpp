#pragma once

#include <functional>

#include "geo/result.hpp"

namespace relevo::ingest {

/// Called with the part done, 0 to 1; returns whether to go on.
using Progress = std::function<bool(double)>;

inline Error interrupted() {
    return {ErrorKind::internal, "interrupted: the scene is not in its place"};
}

/// A part of a longer work: its own 0 to 1 is `from` to `to` of the whole. May be empty.
class Stage {
  public:
    Stage(const Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}
    /// Go on?
    bool operator()(double done) const { return !whole_ || whole_(from_ + (to_ - from_) * done); }

  private:
    const Progress& whole_;
    double from_;
    double to_;
};

}  // namespace relevo::ingest
