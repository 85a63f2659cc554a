#include "lod/scene/folder.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace relevo::lod {
namespace {

template <class Call>
auto retry_interrupted(Call call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

Descriptor open_at(int folder, const std::string& file, int flags) {
    return Descriptor(
        retry_interrupted([&] { return ::openat(folder, file.c_str(), flags | O_CLOEXEC, 0666); }));
}

Error cannot_write(const std::filesystem::path& file) {
    return {ErrorKind::internal, fmt::format("cannot write {}: {}", file.string(), last_system_error())};
}

}  // namespace

std::string last_system_error() {
    return std::error_code(errno, std::generic_category()).message();
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
}

Descriptor::~Descriptor() {
    if (number_ >= 0) ::close(number_);
}

Folder::Folder(std::filesystem::path path, Descriptor descriptor)
    : path_(std::move(path)), descriptor_(std::move(descriptor)) {}

Result<Folder> Folder::open(const std::filesystem::path& path) {
    Descriptor descriptor = open_at(AT_FDCWD, path.string(), O_RDONLY | O_DIRECTORY);
    if (!descriptor) {
        return Error{ErrorKind::input, fmt::format("cannot open {}: {}", path.string(), last_system_error())};
    }
    return Folder(path, std::move(descriptor));
}

Result<std::vector<std::byte>> Folder::read(const std::string& file, std::uint64_t most) const {
    const auto damaged = [&](const std::string& why) {
        return Error{ErrorKind::damaged, fmt::format("{} is damaged: {}: {}", path_.string(), file, why)};
    };
    // Without O_NONBLOCK a pipe in the place of a file would be waited for.
    const Descriptor descriptor = open_at(descriptor_.number(), file, O_RDONLY | O_NONBLOCK);
    if (!descriptor) return damaged(last_system_error());
    struct stat status {};
    if (::fstat(descriptor.number(), &status) != 0) return damaged(last_system_error());
    if (!S_ISREG(status.st_mode)) return damaged("not a file");
    if (static_cast<std::uint64_t>(status.st_size) > most) return damaged("it is longer than it can be");

    std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = retry_interrupted(
            [&] { return ::read(descriptor.number(), bytes.data() + done, bytes.size() - done); });
        if (count < 0) return damaged(last_system_error());
        if (count == 0) return damaged("it became shorter while it was read");
        done += static_cast<std::size_t>(count);
    }
    return bytes;
}

Result<void> Folder::write(const std::string& file, std::span<const std::byte> bytes) const {
    // Never into the old bytes: another name of theirs may be in use.
    if (const auto removed = remove(file); !removed) return removed;
    return write_to(file, O_EXCL, bytes);
}

Result<void> Folder::append(const std::string& file, std::span<const std::byte> bytes) const {
    return write_to(file, O_APPEND, bytes);
}

Result<void> Folder::write_to(const std::string& file, int flags, std::span<const std::byte> bytes) const {
    const Descriptor descriptor = open_at(descriptor_.number(), file, O_WRONLY | O_CREAT | flags);
    if (!descriptor) return cannot_write(path_ / file);
    while (!bytes.empty()) {
        const ssize_t count =
            retry_interrupted([&] { return ::write(descriptor.number(), bytes.data(), bytes.size()); });
        if (count < 0) return cannot_write(path_ / file);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

bool Folder::link(const std::string& file, const std::string& second) const {
    const int folder = descriptor_.number();
    return remove(second) && ::linkat(folder, file.c_str(), folder, second.c_str(), 0) == 0;
}

Result<void> Folder::remove(const std::string& file) const {
    if (::unlinkat(descriptor_.number(), file.c_str(), 0) == 0 || errno == ENOENT) return {};
    return cannot_write(path_ / file);
}

Result<void> Folder::remove_folder(const std::string& name) const {
    std::error_code error;
    std::filesystem::remove_all(path_ / name, error);
    if (error) return cannot_write(path_ / name);
    return {};
}

Result<void> Folder::make_folder(const std::string& name) const {
    if (::mkdirat(descriptor_.number(), name.c_str(), 0777) == 0 || errno == EEXIST) return {};
    return cannot_write(path_ / name);
}

Result<void> Folder::sync_all() const {
    if (retry_interrupted([&] { return ::syncfs(descriptor_.number()); }) != 0) return cannot_write(path_);
    return {};
}

Result<void> Folder::sync_names() const {
    if (retry_interrupted([&] { return ::fsync(descriptor_.number()); }) != 0) return cannot_write(path_);
    return {};
}

// A file system without locks (some network ones) cannot tell; a reader there may lose its files to a new
// scene, which it then reports as missing.
void Folder::mark_in_use() const {
    ::flock(descriptor_.number(), LOCK_SH | LOCK_NB);
}

bool Folder::in_use() const {
    if (::flock(descriptor_.number(), LOCK_EX | LOCK_NB) != 0) return errno == EWOULDBLOCK;
    ::flock(descriptor_.number(), LOCK_UN);
    return false;
}

bool Folder::has_its_name() const {
    struct stat held {};
    struct stat named {};
    return ::fstat(descriptor_.number(), &held) == 0 && ::stat(path_.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

}  // namespace relevo::lod
