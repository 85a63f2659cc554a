#pragma once

#include <filesystem>
#include <string>

#include "geo/result.hpp"
#include "lod/scene/folder.hpp"

namespace relevo::lod {

/// What a writer wants of a place.
struct SceneClaim {
    bool overwrite = false;  ///< a scene that is there may be replaced
    bool resume = false;     ///< go on from what a writer with the same job has left behind, if there is such
    std::string job = {};    ///< everything that a scene's bytes depend on; "": nobody can resume this one
};

/// The place in a folder at which a scene shall appear, locked for one writer, and the hidden folder beside
/// it in which the scene grows until it is whole.
class ScenePlace {
  public:
    /// Fails where the place is taken (unless overwrite, and only a scene is ever overwritten), locked by
    /// another writer, or in a folder that cannot be written. Sweeps what writers that were killed have left
    /// behind, unless it is to be resumed.
    static Result<ScenePlace> claim(const std::filesystem::path& path, const SceneClaim& claim);
    /// Has a writer with this job left something behind?
    static bool can_resume(const std::filesystem::path& path, const std::string& job);
    ScenePlace(ScenePlace&& other) noexcept;
    ScenePlace& operator=(ScenePlace&& other) = delete;
    ~ScenePlace();

    /// The hidden folder; empty at first unless resumed.
    const Folder& partial() const { return partial_; }
    bool resumed() const { return resumed_; }

    /// The hidden folder stays when this is destroyed.
    void keep() { keep_ = true; }

    /// Takes the note of the job out of the hidden folder, which is a whole scene from here on.
    Result<void> forget_job();

    /// Puts the hidden folder in the place, in one step. A scene that was there is deleted, later where it is
    /// being read.
    Result<void> take();

  private:
    ScenePlace(std::filesystem::path target, bool overwrite, Descriptor lock, Folder partial, bool resumed);

    std::filesystem::path target_;
    bool overwrite_;
    Descriptor lock_;
    Folder partial_;
    bool resumed_;
    bool keep_ = false;
    bool owner_ = true;
};

}  // namespace relevo::lod
