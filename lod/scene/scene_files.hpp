#pragma once

#include <string>

#include "lod/scene/block_file.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

// The names of a scene's files, and the two of them that are text (docs/scene-format.md).
inline constexpr const char* kSceneFile = "scene.json";
inline constexpr const char* kMosaicFile = "heights.vrt";
inline constexpr const char* kHeightsFolder = "heights";
inline constexpr const char* kMarksFolder = "marks";
inline constexpr const char* kVerticesFolder = "vertices";
inline constexpr const char* kGeoidFile = "geoid.tif";

/// "heights-3": where the blocks of a level of the pyramid are, from level 1 on. \param folder kHeightsFolder
/// or kVerticesFolder
std::string level_folder(const char* folder, int level);

/// "heights/r0000-c0001.tif": the only name that a block may have.
std::string block_file_name(const std::string& folder, int block_column, int block_row);

/// Where the samples of a block of heights lie, from its first post.
GeoReference geo_reference(const geo::GridFrame& frame, int column, int row);

/// scene.json: the same text for the same scene, with a checksum of itself.
std::string scene_text(const SceneInfo& info);
Result<SceneInfo> scene_info_from_text(const std::string& text);

/// heights.vrt: the blocks of heights as one raster for GDAL and QGIS, by paths relative to it.
std::string mosaic_text(const SceneInfo& info);

/// Does the text of a heights.vrt still join the scene's blocks? GDAL and QGIS write statistics into it in
/// their own form, so it need not be mosaic_text; Relevo itself never reads heights through it.
bool joins_all_blocks(const std::string& mosaic, const SceneInfo& info);

}  // namespace relevo::lod
