#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::lod {

/// Bytes compressed without loss (zlib). The same bytes give the same.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

/// The bytes that were compressed, of which there must be exactly `size`. \param name  for the message; fails
/// with ErrorKind::damaged
Result<std::vector<std::byte>> inflated(std::span<const std::byte> bytes, std::size_t size,
                                        const std::string& name);

}  // namespace relevo::lod
