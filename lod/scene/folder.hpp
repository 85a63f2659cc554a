#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::lod {

/// What the last failed system call said, in words.
std::string last_system_error();

/// An open file or folder of the operating system.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor();

    explicit operator bool() const { return number_ >= 0; }
    int number() const { return number_; }

  private:
    int number_ = -1;
};

/// An open folder. Files are reached through it and not through its name, so that what was opened stays what
/// is read when another folder takes the name.
class Folder {
  public:
    static Result<Folder> open(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }

    /// A file's contents. `file` is relative to the folder. Fails with ErrorKind::damaged, also where it is
    /// longer than `most` bytes: before memory is taken for them.
    Result<std::vector<std::byte>> read(const std::string& file, std::uint64_t most = kLongestText) const;
    static constexpr std::uint64_t kLongestText = std::uint64_t{1} << 30;  ///< of a scene's lists

    /// Writes a file, in place of one that had the name; sync_all() brings it to the disk. Fails with
    /// ErrorKind::internal; as do all below.
    Result<void> write(const std::string& file, std::span<const std::byte> bytes) const;

    /// Adds to the end of a file, which is made if need be.
    Result<void> append(const std::string& file, std::span<const std::byte> bytes) const;

    /// Gives a file a second name, in place of a file that had it; false where the file system cannot.
    bool link(const std::string& file, const std::string& second) const;

    /// Does nothing where there is no such file.
    Result<void> remove(const std::string& file) const;

    /// With all that is in it.
    Result<void> remove_folder(const std::string& name) const;

    /// Does nothing where it is there already.
    Result<void> make_folder(const std::string& name) const;

    /// Brings everything written so far on this file system to the disk, files and names. One call for
    /// hundreds of files: an fsync of each took 25 ms.
    Result<void> sync_all() const;

    /// Brings the names in this folder to the disk.
    Result<void> sync_names() const;

    /// Readers mark a folder as in use so that no writer deletes it under them; the mark goes with the last
    /// of them.
    void mark_in_use() const;
    bool in_use() const;

    /// Does the folder still have the name that it was opened by?
    bool has_its_name() const;

  private:
    Folder(std::filesystem::path path, Descriptor descriptor);

    Result<void> write_to(const std::string& file, int flags, std::span<const std::byte> bytes) const;

    std::filesystem::path path_;
    Descriptor descriptor_;
};

}  // namespace relevo::lod
