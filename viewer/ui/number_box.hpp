#pragma once

#include <string>

#include "viewer/ui/ui.hpp"

namespace relevo::viewer {

/// Boxes in which a number is typed that counts once it is whole: with Enter, Tab or a click elsewhere. One
/// serves all boxes of a panel, as one at a time is typed in.
class NumberBox {
  public:
    /// Draws a box for a value. True in the frame in which it has become another number, at least `least`
    /// and at most `most`. \pre between Ui::begin and end
    bool draw(const Ui& ui, const char* label, double& value, double least, double most);

  private:
    unsigned typed_in_ = 0;  // the box, as Dear ImGui numbers them; 0: none
    std::string text_;
};

}  // namespace relevo::viewer
