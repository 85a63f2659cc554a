#pragma once

#include <array>
#include <limits>
#include <vector>

#include <glm/vec2.hpp>

#include "geo/angle.hpp"

namespace relevo::lod {

/// Posts of the level that a mesh carries, to its spacing: waves of 2 posts are the shortest of a level, with
/// 4 vertices to them.
inline constexpr double kPostsPerSpacing = 2;

/// A square of sea that repeats, drawn as two copies that drift with the wind. The second is larger, turned
/// and so never in step with the first: at one tile's shift the sea is only half like itself, not the same.
/// Each has half the map's variance. Copies move as they are: waves of all lengths as fast as the middling
/// ones.
///
/// Between posts it is the cubic B-spline through them. Catmull and Rom's cubics take the same sixteen posts
/// but have kinks in their slope, which glint, and follow waves of 4 and 8 posts to 12 and 0.9 %, where this
/// does to 6 and 0.3 %; and this one's weights are not negative, so that coefficients bound it and a graphics
/// card sums them in pairs.
class WaveMap {
  public:
    /// Coefficients of a spline, row by row; (0, 0) is half a level's post north-east of the tile's corner.
    /// Level 0 goes through the posts. Level i has the means of 2^i x 2^i posts for coefficients: it smooths,
    /// where a spline through them would make the most of waves that are too short for it.
    struct Level {
        int side;
        std::vector<float> coefficients;
    };

    /// \param heights_m  row by row from the south, each from the west, in metres; their mean is taken off
    /// \param tile_m     the square's side
    /// \pre side is a power of two, heights_m has side x side, tile_m > 0
    WaveMap(int side, const std::vector<float>& heights_m, double tile_m, geo::Degrees wind_from);

    /// Metres above the still sea, for a mesh of this spacing: waves that it cannot carry with 4 vertices
    /// are averaged away, smoothly in the spacing. Spacing 0: all waves. Ground `depth_m` below the still sea
    /// takes of each copy the `depth_part` (waves.hpp) of its middling waves.
    double height(const glm::dvec2& at, double time_s, double spacing_m = 0,
                  double depth_m = std::numeric_limits<double>::infinity()) const;

    /// The map itself, which both copies are made of, for a mesh of this spacing. Lengths are parts of a
    /// tile.
    double tile_height(const glm::dvec2& at, double spacing) const;

    /// No wave rises or sinks more, whatever the spacing.
    double crest_m() const;
    /// 2 pi sqrt(variance / slope variance) of the map: what decides how fast it drifts.
    double mean_length_m() const { return mean_length_m_; }
    const std::vector<Level>& levels() const { return levels_; }

    /// How a copy lies: it is the map at turn (at - time velocity) / tile_m, a tile to 1.
    struct Copy {
        double tile_m;
        glm::dvec2 turn;  ///< cosine and sine, clockwise
        glm::dvec2 velocity_m_s;
        double length_m;  ///< of its middling waves

        /// Where in the tile a place of the chart lies, the tile to 1; not wrapped.
        glm::dvec2 in_tile(const glm::dvec2& at, double time_s) const;
    };
    const std::array<Copy, 2>& copies() const { return copies_; }

  private:
    std::vector<Level> levels_;  ///< side posts, side / 2, ... 1, which is 0
    double mean_length_m_;
    std::array<Copy, 2> copies_;
};

}  // namespace relevo::lod
