#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "lod/measure/height_sampler.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {

/// A scene on disk made of a function of the post, to measure in. NaN is a void.
class MeasuredScene {
  public:
    MeasuredScene(const geo::GridFrame& frame, const std::function<double(int column, int row)>& height,
                  lod::VerticalDatum datum = lod::VerticalDatum::ellipsoid,
                  const std::optional<geo::GeoidNodes>& geoid = {},
                  const std::function<lod::PostMark(int column, int row)>& mark = {})
        : heights_(frame.columns, frame.rows) {
        SceneParts parts;
        parts.info.frame = frame;
        parts.info.vertical = {datum, datum == lod::VerticalDatum::ellipsoid ? "WGS 84 ellipsoid" : "made up",
                               false};
        for (int row = 0; row < frame.rows; ++row) {
            for (int column = 0; column < frame.columns; ++column) {
                const auto H = static_cast<float>(height(column, row));
                heights_.at(column, row) = H;
                ++(std::isnan(H) ? parts.info.void_posts : parts.info.valid_posts);
            }
        }
        parts.info.resampling_method = "none";
        parts.heights = heights_;
        if (mark) {
            parts.marks = lod::plain_marks(heights_);
            for (int row = 0; row < frame.rows; ++row) {
                for (int column = 0; column < frame.columns; ++column) {
                    lod::PostMark& here = parts.marks.at(column, row);
                    if (!here.is_void()) here = mark(column, row);
                    if (here.post_class() == lod::PostClass::sea) ++parts.info.sea_posts;
                }
            }
        }
        const int side = frame.padded_side();
        parts.metrics = {lod::Raster<std::uint16_t>(side, side), lod::Raster<std::uint16_t>(side, side),
                         lod::Raster<std::uint16_t>(side, side)};
        parts.geoid = geoid;
        const auto written = write_scene(parts, folder_ / "a.relevo");
        if (!written) throw std::runtime_error(written.error().message);
        auto opened = lod::Scene::open(folder_ / "a.relevo");
        if (!opened) throw std::runtime_error(opened.error().message);
        scene_ = std::make_unique<lod::Scene>(*std::move(opened));
        sampler_ = std::make_unique<lod::HeightSampler>(*scene_);
    }

    const lod::Scene& scene() const { return *scene_; }
    const geo::GridFrame& frame() const { return scene_->info().frame; }
    lod::HeightSampler& sampler() { return *sampler_; }
    const lod::Raster<float>& heights() const { return heights_; }

    /// Bilinear height by another way: the four weights, in long double, straight from the posts. NaN in
    /// voids and outside.
    long double brute_height(geo::LatLon place) const {
        const geo::GridFrame& f = frame();
        if (f.is_polar()) return brute_height(polar_position(place));
        const long double row = (static_cast<long double>(f.north) - place.lat.value) / f.step_y;
        long double column = (static_cast<long double>(place.lon.value) - f.west) / f.step_x;
        const long double turn = 360.0L / f.step_x;
        while (column < -1e-6L) column += turn;
        while (column > f.columns - 1 + 1e-6L && column - turn >= -1e-6L) column -= turn;
        return brute_height({column, row});
    }

  private:
    struct Position {
        long double column;
        long double row;
    };

    long double brute_height(Position at) const {
        const geo::GridFrame& f = frame();
        const auto [column, row] = at;
        if (column < -1e-6L || row < -1e-6L || column > f.columns - 1 + 1e-6L || row > f.rows - 1 + 1e-6L)
            return std::nanl("");
        const int i = std::clamp(static_cast<int>(column), 0, std::max(f.columns - 2, 0));
        const int j = std::clamp(static_cast<int>(row), 0, std::max(f.rows - 2, 0));
        const long double u = column - i;
        const long double v = row - j;
        const int east = std::min(i + 1, f.columns - 1);
        const int south = std::min(j + 1, f.rows - 1);
        return (1 - u) * (1 - v) * static_cast<long double>(heights_.at(i, j)) +
               u * (1 - v) * static_cast<long double>(heights_.at(east, j)) +
               (1 - u) * v * static_cast<long double>(heights_.at(i, south)) +
               u * v * static_cast<long double>(heights_.at(east, south));
    }

    /// Snyder (1987), Map projections: a working manual, 15-9, 21-33 and 21-30.
    Position polar_position(geo::LatLon place) const {
        const geo::GridFrame& f = frame();
        const bool north = f.kind == geo::FrameKind::ups_north;
        const long double pi = std::acos(-1.0L);
        const long double flattening = 1 / 298.257223563L;
        const long double e = std::sqrt(flattening * (2 - flattening));
        const long double from_pole =
            90 - static_cast<long double>(north ? place.lat.value : -place.lat.value);
        const long double s = e * std::cos(from_pole * pi / 180);
        const long double t = std::tan(from_pole / 360 * pi) / std::pow((1 - s) / (1 + s), e / 2);
        const long double rho =
            2 * 6378137.0L * 0.994L * t / std::sqrt(std::pow(1 + e, 1 + e) * std::pow(1 - e, 1 - e));
        const long double lon = static_cast<long double>(place.lon.value) * pi / 180;
        const long double northing = 2e6L + (north ? -1 : 1) * rho * std::cos(lon);
        return {(2e6L + rho * std::sin(lon) - f.west) / f.step_x, (f.north - northing) / f.step_y};
    }

    SceneFolder folder_;
    lod::Raster<float> heights_;
    std::unique_ptr<lod::Scene> scene_;
    std::unique_ptr<lod::HeightSampler> sampler_;
};

/// A frame of square steps.
inline geo::GridFrame grid(double west, double north, double step, int columns, int rows) {
    return {geo::FrameKind::geographic, west, north, step, step, columns, rows};
}

inline geo::LatLon lat_lon(double lat, double lon) {
    return {geo::Degrees{lat}, geo::Degrees{lon}};
}

/// Rough ground, the same on every machine: heights between 0 and 1000 m without any pattern.
inline double rough(int column, int row) {
    std::uint64_t x = static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15U ^
                      static_cast<std::uint64_t>(row) * 0xc2b2ae3d27d4eb4fU;
    x ^= x >> 29;
    x *= 0xbf58476d1ce4e5b9U;
    x ^= x >> 32;
    return static_cast<double>(x % 1000000) / 1000;
}

}  // namespace relevo::test
