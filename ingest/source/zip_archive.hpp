#pragma once

#include <string>

#include "geo/result.hpp"

namespace relevo::ingest {

/// Is it an HGT tile, zipped or not, that cannot be opened? GDAL 3.6 knows such a tile by its name and size
/// alone, and then reads through no file: a crash.
bool is_unreadable_hgt(const std::string& gdal_name);

/// Reads an entry of a zip archive (/vsizip/...), or all of an archive (NAME.zip), to the end and compares
/// with the sizes and checksums in it: GDAL gives out rows of damaged entries without a word, since it seldom
/// comes to their ends. The checksums of entries that are stored uncompressed are not looked at. Other inputs
/// pass. Fails with ErrorKind::input.
Result<void> check_archive(const std::string& input);

}  // namespace relevo::ingest
