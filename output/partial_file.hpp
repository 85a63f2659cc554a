#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "geo/result.hpp"
#include "lod/scene/folder.hpp"

namespace relevo::output {

/// A file that appears under its name when it is whole, and not before: it grows beside it under a hidden
/// name.
class PartialFile {
  public:
    /// Fails with ErrorKind::usage where the name is taken (unless overwrite, and only files are ever
    /// overwritten) or its folder does not exist, ErrorKind::internal where that cannot be written.
    static Result<PartialFile> create(const std::filesystem::path& path, bool overwrite);
    PartialFile(PartialFile&&) noexcept;
    PartialFile& operator=(PartialFile&&) = delete;
    /// Deletes what was not taken().
    ~PartialFile();

    /// The hidden name, for writers that open files themselves.
    const std::filesystem::path& hidden() const { return hidden_; }

    /// Adds to the end.
    Result<void> write(std::span<const std::byte> bytes);

    /// Brings the file to the disk and gives it its name.
    Result<void> take();

    std::uint64_t bytes() const;  ///< so far

  private:
    PartialFile(std::filesystem::path target, std::filesystem::path hidden, lod::Descriptor file,
                bool overwrite);

    std::filesystem::path target_;
    std::filesystem::path hidden_;  // empty: taken, or moved from
    lod::Descriptor file_;
    bool overwrite_;
};

}  // namespace relevo::output
