#pragma once

#include <filesystem>
#include <string>

#include "geo/result.hpp"
#include "lod/scene/folder.hpp"

namespace relevo::lod {

/// The place in a folder at which a scene shall appear, locked for one writer, and the hidden folder beside
/// it in which the scene grows until it is whole.
class ScenePlace {
  public:
    /// Fails where the place is taken (unless overwrite, and only a scene is ever overwritten), locked by
    /// another writer, or in a folder that cannot be written. Sweeps what writers that were killed have left
    /// behind.
    static Result<ScenePlace> claim(const std::filesystem::path& path, bool overwrite);
    ScenePlace(ScenePlace&& other) noexcept;
    ScenePlace& operator=(ScenePlace&& other) = delete;
    ~ScenePlace();

    /// The hidden folder; empty at first.
    const Folder& partial() const { return partial_; }

    /// Puts the hidden folder in the place, in one step. A scene that was there is deleted, later where it is
    /// being read.
    Result<void> take();

  private:
    ScenePlace(std::filesystem::path target, bool overwrite, Descriptor lock, Folder partial);

    std::filesystem::path target_;
    bool overwrite_;
    Descriptor lock_;
    Folder partial_;
    bool owner_ = true;
};

}  // namespace relevo::lod
