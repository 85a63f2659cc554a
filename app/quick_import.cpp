#include "app/quick_import.hpp"

#include <cstdlib>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "ingest/import.hpp"
#include "ingest/source/inputs.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::app {

namespace fs = std::filesystem;

namespace {

Result<ingest::ImportOptions> options_for(const fs::path& file) {
    const auto inputs = ingest::expand_inputs({file.string()});
    if (!inputs) return inputs.error();
    ingest::ImportOptions options;
    for (const std::string& input : *inputs) {
        ingest::SourceRequest source;
        source.input = input;
        options.mosaic.sources.push_back(source);
    }
    return options;
}

Result<fs::path> folder_for(const fs::path& file) {
    if (access(file.parent_path().c_str(), W_OK) == 0) return file.parent_path();
    const char* data = std::getenv("XDG_DATA_HOME");
    const char* home = std::getenv("HOME");
    fs::path folder;
    if (data != nullptr && fs::path(data).is_absolute()) {
        folder = data;
    } else if (home != nullptr && *home != '\0') {
        folder = fs::path(home) / ".local/share";
    }
    folder /= "relevo";
    std::error_code failed;
    if (folder.is_absolute()) fs::create_directories(folder, failed);
    if (!folder.is_absolute() || failed)
        return Error{ErrorKind::input,
                     fmt::format("{}: no scene can be written beside it, nor in {}; relevo ingest takes a "
                                 "place with -o",
                                 file.string(), folder.string())};
    return folder;
}

}  // namespace

Result<void> check_importable(const fs::path& file) {
    const auto options = options_for(file);
    if (!options) return options.error();
    const auto plan = ingest::plan_import(*options);
    if (plan) return {};
    Error why = plan.error();
    // The flags that it may name are not this command's.
    if (why.message.find(" --") != std::string::npos) why.message += "; `relevo ingest` takes these flags";
    return why;
}

Result<fs::path> quick_import(const fs::path& file, const std::function<bool(double)>& progress) {
    std::error_code failed;
    const fs::path whole = fs::absolute(file, failed).lexically_normal();
    const auto folder = folder_for(whole);
    if (!folder) return folder.error();
    const fs::path place = *folder / (whole.stem().string() + ".relevo");
    if (lod::Scene::open(place)) return place;
    const auto options = options_for(whole);
    if (!options) return options.error();
    const auto imported = ingest::import_scene(*options, {place}, progress);
    if (!imported) return imported.error();
    return place;
}

}  // namespace relevo::app
