#include "viewer/ui/background_import.hpp"

#include <exception>
#include <utility>

namespace relevo::viewer {

BackgroundImport::BackgroundImport(std::filesystem::path file, SceneMaker make)
    : file_(std::move(file)), thread_([this, make = std::move(make)] {
          try {
              result_.emplace(make(file_, [this](double done) {
                  progress_ = done;
                  return !cancelled_;
              }));
          } catch (const std::exception& error) {  // no memory, most likely
              result_.emplace(Error{ErrorKind::internal, file_.string() + ": " + error.what()});
          }
          over_ = true;
      }) {}

BackgroundImport::~BackgroundImport() {
    cancel();
    thread_.join();
}

std::optional<Result<std::filesystem::path>> BackgroundImport::result() const {
    if (!over_) return std::nullopt;
    return result_;
}

}  // namespace relevo::viewer
