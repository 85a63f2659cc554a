#pragma once

struct ImFontAtlas;

namespace relevo::viewer {

/// Puts the letters of the user interface and of marks into an atlas: of $RELEVO_FONT, else DejaVu Sans where
/// distributions put it, else ImGui's own small font. \param scale  1 is for screens of 96 dots an inch
void add_font(ImFontAtlas& atlas, float scale);

/// Height of letters at scale 1.
inline constexpr float kLetterPx = 15;

}  // namespace relevo::viewer
