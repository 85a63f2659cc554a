#include "lod/scene/scene_place.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lod/scene/scene_files.hpp"

namespace relevo::lod {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJobFile = "job";

std::string hidden_name(const fs::path& target, std::string_view what) {
    return fmt::format(".{}.{}", target.filename().string(), what);
}

fs::path lock_file(const fs::path& target) {
    return target.parent_path() / hidden_name(target, "lock");
}

/// Is it the name of a folder of a level of a pyramid, as level_folder gives it?
bool is_level(const std::string& name) {
    constexpr int kMost = 32;
    for (int level = 1; level <= kMost; ++level) {
        for (const char* folder : {kHeightsFolder, kVerticesFolder})
            if (name == level_folder(folder, level)) return true;
    }
    return false;
}

/// Nothing of somebody else's is ever deleted: a scene has scene.json, and nothing but a scene's files and
/// what GDAL and QGIS leave beside a raster.
bool holds_only_a_scene(const fs::path& folder) {
    constexpr std::array<std::string_view, 5> kNames{kSceneFile, kMosaicFile, kHeightsFolder, kMarksFolder,
                                                     kGeoidFile};
    constexpr std::array<std::string_view, 3> kOfOlderFormats{"undulation.tif", "metrics", "lattice"};
    const auto is_among = [](const auto& names, const std::string& name) {
        return std::ranges::find(names, name) != names.end();
    };
    std::error_code error;
    if (!fs::is_regular_file(folder / kSceneFile, error)) return false;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        const bool known = is_among(kNames, name) || is_among(kOfOlderFormats, name) || is_level(name);
        if (!known && !name.ends_with(".aux.xml") && !name.ends_with(".qmd")) return false;
    }
    return !error;
}

Result<void> check_free(const fs::path& target, bool overwrite) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(target, error);
    if (!fs::exists(status)) return {};
    const std::string name = target.string();
    if (!overwrite) {
        return Error{ErrorKind::usage,
                     fmt::format("{} exists: choose another name, or give --overwrite", name)};
    }
    if (!fs::is_directory(status) || !holds_only_a_scene(target)) {
        return Error{
            ErrorKind::usage,
            fmt::format("{} is not a scene (or holds more than one), and only scenes are overwritten: "
                        "choose another name",
                        name)};
    }
    return {};
}

Error cannot(const char* what, const fs::path& path) {
    return {ErrorKind::internal, fmt::format("cannot {} {}: {}", what, path.string(), last_system_error())};
}

/// Is the locked file still the one that has the name? The writer before us deletes it while it holds the
/// lock.
bool has_name(const Descriptor& lock, const fs::path& file) {
    struct stat held {};
    struct stat named {};
    return ::fstat(lock.number(), &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// A link to a scene: the scene is replaced, not the link.
Result<fs::path> target_of(const fs::path& path) {
    std::error_code error;
    fs::path target = fs::weakly_canonical(path, error);
    if (!target.has_filename()) target = target.parent_path();
    if (error || !target.has_filename())
        return Error{ErrorKind::usage, fmt::format("'{}' is not a place for a scene", path.string())};
    return target;
}

Result<Descriptor> take_lock(const fs::path& target) {
    const fs::path file = lock_file(target);
    for (;;) {
        Descriptor lock(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (!lock) return cannot("write", file);
        if (::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EINTR) continue;
            if (errno != EWOULDBLOCK) return cannot("lock", file);
            return Error{ErrorKind::internal,
                         fmt::format("another Relevo is writing {}: wait until it is done", target.string())};
        }
        if (has_name(lock, file)) return lock;
    }
}

/// Deletes a folder unless somebody reads a scene in it: then a later writer of the same scene does.
void remove_unless_read(const fs::path& path) {
    const Result<Folder> folder = Folder::open(path);
    if (!folder || folder->in_use()) return;
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

/// Where the place is locked, no folder of this kind belongs to a living writer.
std::vector<fs::path> left_behind(const fs::path& target) {
    const std::string prefix = hidden_name(target, "partial-");
    std::error_code error;
    std::vector<fs::path> found;
    for (fs::directory_iterator it(target.parent_path(), error), end; !error && it != end;
         it.increment(error)) {
        if (it->path().filename().string().starts_with(prefix)) found.push_back(it->path());
    }
    return found;
}

/// A folder in which a writer has begun the same job; nothing where there is none.
std::optional<Folder> begun(const std::vector<fs::path>& folders, const std::string& job) {
    if (job.empty()) return std::nullopt;
    for (const fs::path& path : folders) {
        Result<Folder> folder = Folder::open(path);
        if (!folder || folder->in_use()) continue;
        const auto bytes = folder->read(kJobFile);
        if (bytes && std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()) == job)
            return std::move(*folder);
    }
    return std::nullopt;
}

Result<Folder> make_partial(const fs::path& target) {
    // More than one try: a scene that is still being read may have the name of its own, earlier, partial
    // folder.
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const std::string name = hidden_name(target, fmt::format("partial-{}-{}", ::getpid(), attempt));
        const fs::path path = target.parent_path() / name;
        if (::mkdir(path.c_str(), 0777) == 0) return Folder::open(path);
        if (errno != EEXIST) return cannot("make the folder", path);
    }
    return cannot("make a folder beside", target);
}

/// rename, and where the file system knows no flags, the nearest that it can do.
int rename_with(const fs::path& from, const fs::path& to, unsigned int flags) {
    const int done = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags);
    if (done == 0 || (errno != EINVAL && errno != ENOSYS)) return done;
    if (flags != RENAME_EXCHANGE) return ::rename(from.c_str(), to.c_str());
    const fs::path aside = from.string() + "-old";
    if (::rename(to.c_str(), aside.c_str()) != 0 || ::rename(from.c_str(), to.c_str()) != 0) return -1;
    return ::rename(aside.c_str(), from.c_str());
}

}  // namespace

ScenePlace::ScenePlace(fs::path target, bool overwrite, Descriptor lock, Folder partial, bool resumed)
    : target_(std::move(target)),
      overwrite_(overwrite),
      lock_(std::move(lock)),
      partial_(std::move(partial)),
      resumed_(resumed) {}

ScenePlace::ScenePlace(ScenePlace&& other) noexcept
    : target_(std::move(other.target_)),
      overwrite_(other.overwrite_),
      lock_(std::move(other.lock_)),
      partial_(std::move(other.partial_)),
      resumed_(other.resumed_),
      keep_(other.keep_),
      owner_(std::exchange(other.owner_, false)) {}

ScenePlace::~ScenePlace() {
    if (!owner_) return;
    if (!keep_) remove_unless_read(partial_.path());
    std::error_code ignored;
    fs::remove(lock_file(target_), ignored);  // while it is locked: see has_name
}

bool ScenePlace::can_resume(const fs::path& path, const std::string& job) {
    const Result<fs::path> target = target_of(path);
    return target && begun(left_behind(*target), job);
}

Result<ScenePlace> ScenePlace::claim(const fs::path& path, const SceneClaim& claim) {
    const Result<fs::path> named = target_of(path);
    if (!named) return named.error();
    fs::path target = *named;
    std::error_code error;
    if (!fs::is_directory(target.parent_path(), error)) {
        return Error{ErrorKind::usage,
                     fmt::format("there is no folder {} to put the scene in", target.parent_path().string())};
    }
    if (const Result<void> free = check_free(target, claim.overwrite); !free) return free.error();
    Result<Descriptor> lock = take_lock(target);
    if (!lock) return lock.error();
    const std::vector<fs::path> old = left_behind(target);
    std::optional<Folder> mine = claim.resume ? begun(old, claim.job) : std::nullopt;
    for (const fs::path& folder : old) {
        if (!mine || folder != mine->path()) remove_unless_read(folder);
    }
    if (mine) return ScenePlace(std::move(target), claim.overwrite, std::move(*lock), std::move(*mine), true);
    Result<Folder> partial = make_partial(target);
    if (!partial) {
        fs::remove(lock_file(target), error);
        return partial.error();
    }
    ScenePlace place(std::move(target), claim.overwrite, std::move(*lock), std::move(*partial), false);
    if (!claim.job.empty()) {
        if (auto done = place.partial_.write(kJobFile, std::as_bytes(std::span(claim.job))); !done)
            return done.error();
    }
    return place;
}

Result<void> ScenePlace::forget_job() {
    return partial_.remove(kJobFile);
}

Result<void> ScenePlace::take() {
    // Again, since hours may have passed.
    if (const Result<void> free = check_free(target_, overwrite_); !free) return free;
    std::error_code ignored;
    const bool replaces = fs::exists(target_, ignored);
    const unsigned int how = replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE;
    if (rename_with(partial_.path(), target_, how) != 0) return cannot("put the scene at", target_);
    Result<Folder> parent = Folder::open(target_.parent_path());
    if (!parent) return parent.error();
    // From here on the hidden name, if there still is something, is the scene that was replaced.
    keep_ = false;
    return parent->sync_names();
}

}  // namespace relevo::lod
