#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "lod/ocean/sea_spacing.hpp"
#include "lod/ocean/sea_view.hpp"

namespace relevo::lod {

/// Vertices and triangles that never change. What a vertex's numbers mean, its mesh says.
struct OceanPatch {
    std::vector<glm::i16vec2> vertices;
    std::vector<std::uint16_t> indices;  ///< three a triangle, counter-clockwise from above

    std::size_t triangles() const { return indices.size() / 3; }
};

/// Cells of columns x rows, each two triangles; vertices count from (0, 0), x east, y north.
OceanPatch cells_patch(int columns, int rows);

/// What is in a part of the sea's surface.
enum class Water {
    none,   ///< land alone
    shore,  ///< both
    open,   ///< sea alone
};

/// What of a mesh a picture draws.
struct OceanPicture {
    /// Copies of a patch. What their numbers mean, the mesh says.
    struct Copies {
        std::vector<glm::vec4> open;
        std::vector<glm::vec4> shore;  ///< there is land in them: where water ends is to be found out
    };
    std::vector<Copies> copies;  ///< of each patch

    void add(std::size_t patch, Water water, const glm::vec4& copy) {
        if (water == Water::open) copies[patch].open.push_back(copy);
        if (water == Water::shore) copies[patch].shore.push_back(copy);
    }

    /// What the shader needs besides.
    std::vector<glm::vec4> numbers;
    static constexpr std::size_t kMostNumbers = 256;
};

/// What is in a disc on the sea. `centre` is from the eye's nadir, in the chart.
using WaterIn = std::function<Water(const glm::dvec2& centre, double radius_m)>;

/// A mesh of the sea: patches that stay in the memory of what draws them, and for each picture which copies
/// of them are seen. Where a vertex goes, the mesh's shader (viewer/shaders/ocean_*.glsl) works out from its
/// copy's numbers.
class OceanMesh {
  public:
    virtual ~OceanMesh() = default;

    virtual const std::vector<OceanPatch>& patches() const = 0;

    /// What a picture draws. Nothing is drawn where all copies are empty.
    virtual void arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                         OceanPicture& picture) const = 0;
};

/// May any of the sea between four places be in the picture? They are from the nadir, along the chart's axes.
bool patch_in_view(const SeaView& sea, const std::array<glm::dvec2, 4>& corners);

}  // namespace relevo::lod
