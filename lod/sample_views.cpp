#include "lod/sample_views.hpp"

#include <algorithm>
#include <array>
#include <random>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

namespace {

GridPoint random_valid_post(const geo::GridFrame& frame, TruePosts::Reader& posts, std::mt19937_64& random) {
    const auto columns = static_cast<std::uint64_t>(frame.columns);
    const auto rows = static_cast<std::uint64_t>(frame.rows);
    // Plain remainders: the standard's distributions differ between libraries.
    const std::uint64_t start = random() % (columns * rows);
    for (std::uint64_t k = 0; k < columns * rows; ++k) {
        const std::uint64_t i = (start + k) % (columns * rows);
        const GridPoint post{static_cast<int>(i % columns), static_cast<int>(i / columns)};
        if (posts.is_valid(post.column, post.row)) return post;
    }
    return {};
}

/// Longer side of the data, metres.
double terrain_size(const geo::GridFrame& frame) {
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    return std::max(spacing.column_m * frame.columns, spacing.row_m * frame.rows);
}

}  // namespace

std::vector<Camera> sample_views(const Terrain& terrain, int count, std::uint64_t seed, int width,
                                 int height) {
    const std::array<double, 5> pitches{-90, -45, -15, -4, 2};
    const double size = terrain_size(terrain.frame());
    const std::array<double, 6> heights_above_ground{2, 30, 300, 3000, 0.3 * size, 1.5 * size};

    std::mt19937_64 random(seed);
    TruePosts::Reader posts(terrain.posts());
    std::vector<Camera> views;
    for (int k = 0; k < count; ++k) {
        const GridPoint post = random_valid_post(terrain.frame(), posts, random);
        const geo::GridPosition place{static_cast<double>(post.column), static_cast<double>(post.row)};
        const geo::LatLon at = terrain.frame().lat_lon(place);
        const double ground = static_cast<double>(posts.H(post.column, post.row)) +
                              terrain.undulations().at(post.column, post.row);
        const std::size_t i = static_cast<std::size_t>(k);
        const double above = heights_above_ground[(i / pitches.size() + i) % heights_above_ground.size()];
        Camera camera;
        camera.eye = {at.lat, at.lon, {ground + above}};
        camera.heading = geo::Degrees{static_cast<double>(random() % 360)};
        camera.pitch = geo::Degrees{pitches[i % pitches.size()]};
        camera.width = width;
        camera.height = height;
        views.push_back(camera);
    }
    return views;
}

}  // namespace relevo::lod
