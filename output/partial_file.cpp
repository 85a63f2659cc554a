#include "output/partial_file.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace relevo::output {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& file) {
    return {ErrorKind::internal, fmt::format("cannot write {}: {}", file.string(), lod::last_system_error())};
}

Result<void> check_free(const fs::path& target, bool overwrite) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(target, error);
    if (!fs::exists(status)) return {};
    if (!fs::is_regular_file(status))
        return Error{ErrorKind::usage, fmt::format("{} is not a file: choose another name", target.string())};
    if (overwrite) return {};
    return Error{ErrorKind::usage,
                 fmt::format("{} exists: choose another name, or give --overwrite", target.string())};
}

}  // namespace

Result<PartialFile> PartialFile::create(const fs::path& path, bool overwrite) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(fs::absolute(path), error);  // of a link: what it leads to
    if (error || !target.has_filename() || path.filename().empty())
        return Error{ErrorKind::usage, fmt::format("'{}' is not a name for a file", path.string())};
    if (!fs::is_directory(target.parent_path(), error)) {
        return Error{ErrorKind::usage,
                     fmt::format("there is no folder {} to put the file in", target.parent_path().string())};
    }
    if (const auto free = check_free(target, overwrite); !free) return free.error();
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const fs::path hidden =
            target.parent_path() /
            fmt::format(".{}.partial-{}-{}", target.filename().string(), ::getpid(), attempt);
        lod::Descriptor file(::open(hidden.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (file) return PartialFile(target, hidden, std::move(file), overwrite);
        if (errno != EEXIST && errno != EINTR) break;
    }
    return cannot_write(target);
}

PartialFile::PartialFile(fs::path target, fs::path hidden, lod::Descriptor file, bool overwrite)
    : target_(std::move(target)), hidden_(std::move(hidden)), file_(std::move(file)), overwrite_(overwrite) {}

PartialFile::PartialFile(PartialFile&& other) noexcept
    : target_(std::move(other.target_)),
      hidden_(std::exchange(other.hidden_, {})),
      file_(std::move(other.file_)),
      overwrite_(other.overwrite_) {}

PartialFile::~PartialFile() {
    std::error_code ignored;
    if (!hidden_.empty()) fs::remove(hidden_, ignored);
}

Result<void> PartialFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file_.number(), bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return cannot_write(target_);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

std::uint64_t PartialFile::bytes() const {
    std::error_code error;
    const auto size = fs::file_size(hidden_.empty() ? target_ : hidden_, error);
    return error ? 0 : static_cast<std::uint64_t>(size);
}

Result<void> PartialFile::take() {
    // By its name: who wrote it (see hidden) may have made another file of it.
    const lod::Descriptor whole(::open(hidden_.c_str(), O_RDONLY | O_CLOEXEC));
    if (!whole || ::fsync(whole.number()) != 0) return cannot_write(target_);
    if (const auto free = check_free(target_, overwrite_); !free) return free;
    int done = -1;
    if (!overwrite_) {
        done = ::renameat2(AT_FDCWD, hidden_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE);
        if (done != 0 && errno != EINVAL && errno != ENOSYS) return cannot_write(target_);
    }
    // Where the file system cannot refuse by itself, the look above has to do.
    if (done != 0 && ::rename(hidden_.c_str(), target_.c_str()) != 0) return cannot_write(target_);
    hidden_.clear();
    const auto folder = lod::Folder::open(target_.parent_path());
    if (!folder) return folder.error();
    return folder->sync_names();
}

}  // namespace relevo::output
