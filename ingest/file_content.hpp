#pragma once

#include <string>
#include <vector>

namespace relevo::ingest {

/// What a file can be to a scene.
enum class FileContent {
    elevation,  ///< a scene is made of it
    imagery,    ///< a picture, for ImageFile
    vectors,    ///< lines and points, for VectorFile
};

/// What a file holds, by its content and not by its name:
///
/// | it is | it holds |
/// | --- | --- |
/// | a raster with a palette, or of three bands or more besides alpha | imagery |
/// | a raster of one or two bands of another type than bytes | elevation |
/// | a raster of one or two bands of bytes without a palette: shades of grey, or coarse heights | either |
/// | no raster, but lines, points or polygons in a format that VectorFile reads | vectors |
///
/// Anything else, a folder and what cannot be opened at all too, counts as elevation: importing it says what
/// is wrong. The likelier of two comes first. Opens the file and reads no more than its head, but of some
/// vector formats, which OGR reads whole.
std::vector<FileContent> contents_of(const std::string& file);

}  // namespace relevo::ingest
