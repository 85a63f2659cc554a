#pragma once

#include <vector>

namespace relevo::viewer {

/// A part of the window, in the user interface's units.
struct Box {
    float left = 0;
    float top = 0;
    float right = 0;
    float bottom = 0;
};

/// What panels cover of a picture: marks and letters on it keep to the rest.
class Covered {
  public:
    void add(const Box& box) { boxes_.push_back(box); }
    const std::vector<Box>& boxes() const { return boxes_; }

    bool touches(const Box& box) const;
    /// How high something may be that stands on the lower side of a box, as high as the box at most: 0 where
    /// there is no room for any of it.
    float height_free(const Box& box) const;

  private:
    std::vector<Box> boxes_;
};

}  // namespace relevo::viewer
