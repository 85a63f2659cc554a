#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace relevo::viewer {

/// What ground is made of in pictures. `grain` is no ground but the detail that is laid over each of them
/// near the eye.
enum class Material { grass, rock, gravel, snow, grain };
inline constexpr int kMaterials = 5;

std::string_view to_string(Material material);

/// A texel: brightness, which of the material's two colours (shaders/cover.glsl), slope along the row and up
/// the column. Each is a part of 255; the mean of all four over a tile is 0.5 to 0.01, so that from afar a
/// tile is the mean of its colours, flat, and lit as without it.
using MaterialTexel = std::array<std::uint8_t, 4>;

inline constexpr int kMaterialSide = 256;

/// A material's tile, row by row upwards. It repeats in both directions without a seam, and is the
/// same bytes for the same seed.
std::vector<MaterialTexel> material_tile(Material material, std::uint64_t seed = 1);

}  // namespace relevo::viewer
