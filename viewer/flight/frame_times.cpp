#include "viewer/flight/frame_times.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

void FrameTimes::add(double ms) {
    if (count_ == 1) ms_.clear();
    ms_.push_back(ms);
    shown_ += (ms - shown_) * (count_ < 5 ? 1 : 0.15);
    ++count_;
}

double FrameTimes::quantile(double part) const {
    if (ms_.empty()) return 0;
    std::vector<double> sorted = ms_;
    const auto at = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size() - 1)));
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(at);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

}  // namespace relevo::viewer
