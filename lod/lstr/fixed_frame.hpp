#pragma once

#include <glm/vec3.hpp>

#include "lod/terrain.hpp"

namespace relevo::lod {

/// Places around a terrain as whole numbers of a unit, a power of two: half the memory of doubles, and the
/// same on both sides of a border whatever they are counted from.
struct FixedFrame {
    glm::dvec3 origin{0};  ///< ECEF
    double unit_m = 1;     ///< 0.06 mm for 40 km, 0.24 mm for 250 km, 1.6 cm for the earth

    /// One that holds a terrain with its heights exaggerated.
    static FixedFrame of(const Terrain& terrain, double exaggeration);

    glm::ivec3 fixed(const glm::dvec3& ecef) const;
    glm::dvec3 place(const glm::ivec3& at) const { return origin + unit_m * glm::dvec3(at); }
};

}  // namespace relevo::lod
