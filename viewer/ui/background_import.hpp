#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "geo/result.hpp"

namespace relevo::viewer {

/// Makes a scene of an elevation file; the viewer itself cannot. Calls `progress` with the part done, 0 to 1,
/// and stops where it says false. Gives the scene's place.
using SceneMaker = std::function<Result<std::filesystem::path>(const std::filesystem::path& file,
                                                               const std::function<bool(double)>& progress)>;

/// An elevation file that is imported while the window goes on. Ends with it.
class BackgroundImport {
  public:
    BackgroundImport(std::filesystem::path file, SceneMaker make);
    BackgroundImport(const BackgroundImport&) = delete;
    BackgroundImport& operator=(const BackgroundImport&) = delete;
    /// Stops it where it goes on.
    ~BackgroundImport();

    const std::filesystem::path& file() const { return file_; }
    double progress() const { return progress_; }
    void cancel() { cancelled_ = true; }
    bool cancelled() const { return cancelled_; }

    /// What came of it, once it is over.
    std::optional<Result<std::filesystem::path>> result() const;

  private:
    std::filesystem::path file_;
    std::atomic<double> progress_ = 0;
    std::atomic<bool> cancelled_ = false;
    std::atomic<bool> over_ = false;
    std::optional<Result<std::filesystem::path>> result_;  // written before over_ is set
    std::thread thread_;
};

}  // namespace relevo::viewer
