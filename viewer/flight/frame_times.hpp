#pragma once

#include <vector>

namespace relevo::viewer {

/// How long frames took. The first is left out as soon as there is a second: it compiles the programs.
class FrameTimes {
  public:
    void add(double ms);
    std::size_t count() const { return count_; }
    /// Time that this part of the frames, 0 to 1, did not exceed; 0 without frames.
    double quantile(double part) const;
    /// Smoothed over the last frames, for showing.
    double shown() const { return shown_; }

  private:
    std::vector<double> ms_;
    std::size_t count_ = 0;
    double shown_ = 0;
};

}  // namespace relevo::viewer
