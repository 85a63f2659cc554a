#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/ui/ui.hpp"

namespace relevo::viewer {

/// What a folder has that can be opened: folders, scenes and files that may be, by name.
struct ChooserEntry {
    enum class Kind { folder, scene, file };
    Kind kind = Kind::folder;
    std::string name;
};
std::vector<ChooserEntry> openable_in(const std::filesystem::path& folder);

/// A box with a folder's scenes and files, and a line to type a path in.
class FileChooser {
  public:
    void show();
    void hide() { shown_ = false; }
    bool shown() const { return shown_; }

    /// \pre between Ui::begin and end. What was chosen, in the frame in which it is.
    std::optional<std::filesystem::path> draw(const Ui& ui);

  private:
    void enter(const std::filesystem::path& folder);

    bool shown_ = false;
    bool fresh_ = false;
    std::filesystem::path folder_;
    std::vector<ChooserEntry> entries_;
    std::string typed_;
};

}  // namespace relevo::viewer
