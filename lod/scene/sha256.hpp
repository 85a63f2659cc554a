#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "geo/result.hpp"

namespace relevo::lod {

/// SHA-256 of some bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::span<const std::byte> bytes);

/// SHA-256 of a file's contents, read in pieces. Fails with ErrorKind::input where the file cannot be read.
Result<std::string> sha256_of_file(const std::filesystem::path& file);

}  // namespace relevo::lod
