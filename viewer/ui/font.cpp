#include "viewer/ui/font.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <imgui.h>

namespace relevo::viewer {

namespace {

/// A TrueType file with the letters that we need; empty where there is none.
std::string font_file() {
    if (const char* chosen = std::getenv("RELEVO_FONT");
        chosen != nullptr && std::filesystem::exists(chosen)) {
        return chosen;
    }
    for (const char* file :
         {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
          "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
          "/usr/local/share/fonts/DejaVuSans.ttf"}) {
        if (std::filesystem::exists(file)) return file;
    }
    return {};
}

}  // namespace

void add_font(ImFontAtlas& atlas, float scale) {
    static constexpr ImWchar kLetters[] = {0x20, 0xff, 0};  // Latin-1: with the degree sign
    const std::string file = font_file();
    if (!file.empty() &&
        atlas.AddFontFromFileTTF(file.c_str(), std::round(kLetterPx * scale), nullptr, kLetters)) {
        return;
    }
    ImFontConfig own;
    own.SizePixels = std::round(13 * scale);
    atlas.AddFontDefault(&own);
}

}  // namespace relevo::viewer
