#include "lod/measure/viewshed.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lod/measure/high_ground.hpp"
#include "lod/measure/lookout.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/read_box.hpp"

namespace relevo::lod {
namespace {

/// The posts that may be within a radius.
BlockGrid::Box box_around(const geo::GridFrame& frame, geo::LatLon eye, double radius) {
    const geo::GridPosition at = frame.grid_position(eye);
    double columns = 0;
    double rows = 0;
    if (frame.is_polar()) {
        // The scale grows from the pole outwards: the farthest place has the most columns a metre.
        const auto far = frame.spacing({at.column, at.row});
        const double slack = 1 + radius / 6.3e6;
        columns = radius * slack * slack / far.column_m;
        rows = radius * slack * slack / far.row_m;
    } else {
        const double angle = radius / 6.33e6;  // less than any radius of curvature
        const double lat = std::abs(eye.lat.radians());
        rows = geo::Degrees::from_radians(angle).value / frame.step_y;
        const double ratio = std::sin(std::min(angle, 1.5)) / std::max(std::cos(lat), 1e-9);
        columns =
            (ratio < 1 ? geo::Degrees::from_radians(std::asin(ratio)).value * 1.01 : 360) / frame.step_x;
    }
    const auto range = [](double middle, double reach, int count) {
        const double low = std::clamp(std::floor(middle - reach), 0.0, count - 1.0);
        const double high = std::clamp(std::ceil(middle + reach), 0.0, count - 1.0);
        return std::pair{static_cast<int>(low), static_cast<int>(high - low) + 1};
    };
    const auto [column, across] = range(at.column, columns, frame.columns);
    const auto [row, down] = range(at.row, rows, frame.rows);
    return {column, row, across, down};
}

Error no_viewshed(std::string what) {
    return {ErrorKind::usage, std::move(what)};
}

}  // namespace

Result<Viewshed> measure_viewshed(HeightSampler& sampler, geo::LatLon eye, const ViewshedRequest& request) {
    if (const auto good = check(request.looking); !good) return good.error();
    if (!(request.radius_m > 0 && request.radius_m <= 1e6))
        return no_viewshed("the radius of a viewshed is from 0 to 1000000 m");
    const Scene& scene = sampler.scene();
    const geo::GridFrame& frame = scene.info().frame;
    const geo::GridPosition at = frame.grid_position(eye);
    const auto eye_ground = sampler.height(at);
    if (!eye_ground) return eye_ground.error();
    if (!*eye_ground)
        return no_viewshed("the scene has no height where the eye is: it is outside, or in a void");

    Viewshed shed;
    shed.box = box_around(frame, eye, request.radius_m);
    constexpr std::int64_t kMostPosts = 64'000'000;
    const std::int64_t posts = std::int64_t{shed.box.columns} * shed.box.rows;
    if (posts > kMostPosts)
        return no_viewshed(
            fmt::format("{} posts are within {} m, more than the {} million that fit: choose a "
                        "smaller radius",
                        posts, request.radius_m, kMostPosts / 1'000'000));
    const auto heights = read_box(scene, shed.box);
    if (!heights) return heights.error();
    const HighGround ground(scene, shed.box, *heights);
    shed.eye_H_m = **eye_ground + request.looking.eye_height_m;
    const double eye_h = shed.eye_H_m + (scene.geoid() == nullptr ? 0 : scene.geoid()->undulation(eye).m);
    const Lookout lookout(frame, shed.box, ground, eye, eye_h, request.looking);
    constexpr double kStraight = 1e-3;
    for (const int column : {0, shed.box.columns - 1}) {
        for (const int row : {0, shed.box.rows - 1}) {
            if (lookout.bend_error(column, row) > kStraight)
                return no_viewshed(
                    "the radius is too large for lines of sight in this scene's grid, so near a "
                    "pole: choose a smaller one");
        }
    }

    shed.posts = Raster<std::uint8_t>(shed.box.columns, shed.box.rows, Viewshed::none);
    struct Row {
        std::array<std::uint64_t, 3> posts{};
        std::array<double, 3> m2{};
    };
    std::vector<Row> rows(static_cast<std::size_t>(shed.box.rows));
    std::atomic<int> done = 0;
    std::atomic<bool> stopped = false;
    const auto looked = for_each_block(shed.box.rows, [&](int row) -> Result<void> {
        if (stopped) return {};
        double hint = 0;
        Row& sums = rows[static_cast<std::size_t>(row)];
        auto spacing = frame.spacing({at.column, shed.box.row + row + 0.0});
        for (int column = 0; column < shed.box.columns; ++column) {
            const auto seen = lookout.look(column, row, request.radius_m, hint);
            shed.posts.at(column, row) = seen;
            if (seen == Viewshed::none) continue;
            if (frame.is_polar())
                spacing = frame.spacing({shed.box.column + column + 0.0, shed.box.row + row + 0.0});
            ++sums.posts[seen];
            sums.m2[seen] += spacing.column_m * spacing.row_m;
        }
        if (request.progress && !request.progress(static_cast<double>(++done) / shed.box.rows))
            stopped = true;
        return {};
    });
    if (!looked) return looked.error();
    if (stopped) return Error{ErrorKind::internal, "stopped: the viewshed was not measured"};
    for (const Row& row : rows) {
        shed.hidden_posts += row.posts[Viewshed::hidden];
        shed.visible_posts += row.posts[Viewshed::visible];
        shed.unknown_posts += row.posts[Viewshed::unknown];
        shed.hidden_m2 += row.m2[Viewshed::hidden];
        shed.visible_m2 += row.m2[Viewshed::visible];
        shed.unknown_m2 += row.m2[Viewshed::unknown];
    }
    return shed;
}

}  // namespace relevo::lod
