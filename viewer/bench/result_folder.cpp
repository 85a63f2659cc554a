#include "viewer/bench/result_folder.hpp"

#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace relevo::viewer {

namespace fs = std::filesystem;

namespace {

/// As it is written: absolute and without a slash at the end, so that it has a name and a parent.
fs::path plain(const fs::path& folder) {
    std::error_code ignored;
    const fs::path whole = fs::absolute(folder, ignored).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

Error cannot_write(const fs::path& folder, const std::string& why) {
    return {ErrorKind::internal, fmt::format("{}: cannot be written: {}", folder.string(), why)};
}

}  // namespace

Result<void> check_result_folder(const fs::path& folder, bool overwrite) {
    const auto wrong = [&](const char* why) {
        return Error{ErrorKind::usage, fmt::format("-o {}: {}", folder.string(), why)};
    };
    std::error_code failed;
    if (!fs::is_directory(plain(folder).parent_path(), failed))
        return wrong("there is no such folder to put it in");
    if (!fs::exists(folder, failed)) return {};
    if (!fs::is_directory(folder, failed)) return wrong("it is there and not a folder");
    if (!overwrite && !fs::is_empty(folder, failed))
        return wrong("the folder is not empty; --overwrite writes into it");
    return {};
}

Result<void> write_result_folder(const fs::path& folder, const std::map<std::string, std::string>& files) {
    const fs::path target = plain(folder);
    const fs::path unfinished =
        target.parent_path() /
        fmt::format(".{}.partial-{}", target.filename().string(), static_cast<long>(getpid()));
    std::error_code failed;
    const auto give_up = [&](const std::string& why) {
        std::error_code ignored;
        fs::remove_all(unfinished, ignored);
        return cannot_write(folder, why);
    };
    fs::create_directory(unfinished, failed);
    if (failed) return cannot_write(folder, failed.message());
    for (const auto& [name, text] : files) {
        std::ofstream stream(unfinished / name, std::ios::binary);
        stream << text;
        stream.close();
        if (!stream) return give_up(name);
    }
    if (!fs::exists(target, failed)) {
        fs::rename(unfinished, target, failed);
        if (!failed) return {};
    }
    for (const auto& [name, text] : files) {
        fs::rename(unfinished / name, target / name, failed);
        if (failed) return give_up(failed.message());
    }
    fs::remove_all(unfinished, failed);
    return {};
}

}  // namespace relevo::viewer
