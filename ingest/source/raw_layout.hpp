#pragma once

#include <filesystem>
#include <string>

#include "geo/result.hpp"

namespace relevo::ingest {

/// What a headerless file of heights holds: rows from the north, one value after the other.
struct RawLayout {
    int columns = 0;
    int rows = 0;
    std::string type;  ///< uint8, int16, uint16, int32, float32, float64
    bool little_endian = true;
};

/// From "3601x3601,int16,be": columns, rows, type, le or be (which bytes alone may leave out). Fails with
/// ErrorKind::usage.
Result<RawLayout> raw_layout(const std::string& text);

/// A GDAL data set (VRT text) for such a file. Fails where the file's size is not what the layout needs.
Result<std::string> raw_dataset(const std::filesystem::path& file, const RawLayout& layout);

}  // namespace relevo::ingest
