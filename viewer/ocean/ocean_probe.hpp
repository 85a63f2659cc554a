#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geo/result.hpp"
#include "lod/ocean/sea_chart.hpp"
#include "lod/ocean/wave_map.hpp"
#include "lod/ocean/waves.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/draw_settings.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ocean/ocean.hpp"

namespace relevo::viewer {

class Renderer;

// What a picture of the sea shows, read back and judged by ways of its own: places by GeographicLib, waves by
// their own function in double, at every pixel. For tests and benchmarks.

/// What is at a picture's pixels, as it was drawn.
struct ProbePicture {
    enum class What : std::uint8_t {
        nothing,
        ground,
        sea,
        filled,  ///< by Ocean::fill
    };
    struct Pixel {
        What what = What::nothing;
        glm::dvec2 place{0};  ///< of the sea: in the chart
        double wave_m = 0;    ///< of the sea: above its level; between vertices as the rasteriser has it
    };

    lod::View view;
    double time_s;
    std::optional<lod::SeaChart> chart;  ///< none where no sea was drawn
    OceanFigures figures;
    std::vector<Pixel> pixels;  ///< row by row from the upper left corner

    int width() const { return view.camera().width; }
    int height() const { return view.camera().height; }
    const Pixel& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
                      static_cast<std::size_t>(x)];
    }
};

/// Draws pictures of a size into floats, one sample a pixel.
class OceanProbe {
  public:
    static Result<OceanProbe> create(int width, int height);

    /// \pre the view's terrain is uploaded and complete, and its picture of this size
    Result<ProbePicture> draw(Renderer& renderer, const lod::View& view, const DrawSettings& settings) const;

  private:
    OceanProbe() = default;
    int width_ = 0;
    int height_ = 0;
    GlRenderbuffer colour_, depth_;
    GlFramebuffer framebuffer_;
};

/// The sea as it ought to be.
struct TrueSea {
    const lod::Waves* waves = nullptr;
    const lod::WaveMap* map = nullptr;   ///< instead of the waves, where there is one
    const EyeHeight* heights = nullptr;  ///< null: the sea is at the ellipsoid
    /// Of the water at a place, metres; NaN where it is not known: there nothing is compared.
    std::function<double(geo::LatLon)> depth_m = [](geo::LatLon) {
        return std::numeric_limits<double>::infinity();
    };

    /// Of its waves above its level, at a place of the chart, over water so deep.
    double wave_m(const glm::dvec2& at, double time_s, double water_m) const;
    /// Of its level above the ellipsoid.
    double level_m(geo::LatLon place) const;
};

/// How far the drawn sea is off, in pixels, over the pixels that show it.
struct SeaError {
    double max_px = 0;  ///< between the true surface and the drawn one at one place of the chart
    double rms_px = 0;
    double p99_px = 0;
    /// Between where a place was drawn, to half a pixel's middle, and where it is: curvature, geoid and the
    /// shaders' floats too.
    double position_max_px = 0;
    double position_rms_px = 0;
    std::uint64_t pixels = 0;
    std::uint64_t over = 0;    ///< pixels that are off by more than one
    std::uint64_t behind = 0;  ///< whose true point is behind the eye: not compared
    glm::ivec2 worst{0};       ///< the pixel of max_px
};
SeaError measure_sea_error(const ProbePicture& picture, const TrueSea& sea);

/// Motion of the sea between two pictures of one time that its waves do not explain: how far the surfaces are
/// apart that both draw at one place, in pixels of the second. The first one's is taken from between four of
/// its pixels, and where that is not certain to 0.02 pixels, nothing is compared.
struct Swimming {
    double max_px = 0;
    double rms_px = 0;
    std::uint64_t pixels = 0;      ///< compared
    std::uint64_t sea_pixels = 0;  ///< of the second picture
};
Swimming measure_swimming(const ProbePicture& first, const ProbePicture& second, const TrueSea& sea);

/// Finds pixels in which nothing was drawn though there is sea, or ground, behind them. Keeps in memory what
/// it has read of the terrain's classes.
class HoleFinder {
  public:
    /// What is referred to must outlive the finder.
    HoleFinder(const lod::Terrain& terrain, const TrueSea& sea) : terrain_(terrain), sea_(sea) {}

    /// Pixels within 1.5 pixels of where nothing is (the horizon, the limb, the edge of data with land) do
    /// not count. Where a wave goes over the eye's head nothing does: it sees water from within.
    std::vector<glm::ivec2> holes(const ProbePicture& picture);

  private:
    bool expects(const lod::View& view, const glm::dvec2& pixel);
    std::optional<geo::LatLon> on_sea_level(const lod::View& view, const glm::dvec3& ray) const;
    bool is_sea(int column, int row);

    const lod::Terrain& terrain_;
    const TrueSea& sea_;
    std::map<std::pair<int, int>, std::optional<lod::Raster<std::uint8_t>>> classes_;
};

}  // namespace relevo::viewer
