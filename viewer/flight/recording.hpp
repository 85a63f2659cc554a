#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "viewer/flight/flight_recorder.hpp"

namespace relevo::viewer {

/// A file of a folder that is not there yet: name-0001.ending and so on.
std::filesystem::path fresh_file(const std::filesystem::path& folder, const char* name, const char* ending);

/// What is flown, from its first frame on, for a file.
class Recording {
  public:
    explicit Recording(std::filesystem::path file) : file_(std::move(file)) {}

    /// To be told the view of each frame.
    void see(const ViewState& view, std::chrono::steady_clock::time_point now);

    /// Writes it, and says what was written; nothing where no frame was seen.
    Result<std::optional<std::string>> write() const;

  private:
    std::filesystem::path file_;
    FlightRecorder recorder_;
    std::chrono::steady_clock::time_point begin_{};
};

}  // namespace relevo::viewer
