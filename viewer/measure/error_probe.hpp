#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include "lod/oracle.hpp"

namespace relevo::viewer {

/// Measures the error of a picture that is on the screen, by brute force in the background, for as long as
/// that takes: the picture may have moved on by then.
class ErrorProbe {
  public:
    /// Begins with a copy of what is drawn; nothing while one is going on. The terrain must outlive it.
    void begin(const lod::Terrain& terrain, const lod::View& view, const lod::Mesh& mesh, double exaggeration,
               double tau_px);
    bool busy() const { return running_.valid(); }

    /// Takes in what has been found: for people, once; nothing before.
    std::optional<std::string> finish();

    /// What was found, or that it goes on, for people; empty before the first.
    std::vector<std::string> report() const;

  private:
    std::future<std::optional<lod::MeasuredError>> running_;
    double tau_px_ = 0;
    std::vector<std::string> last_;
};

}  // namespace relevo::viewer
