#include "ingest/mosaic/layer_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relevo::ingest {
namespace {

constexpr int kSide = 8 * kTransformTile;
constexpr double kPostTolerance = 1e-6;  // within it a measurement is the post (DESIGN: measuring)
constexpr std::int64_t kMostScenePosts = std::int64_t{1} << 22;  // fetched at once

/// A part of the finished scene.
struct ScenePart {
    Window window;
    lod::Raster<float> heights;

    double at(int column, int row) const {
        return static_cast<double>(heights.at(column - window.column, row - window.row));
    }
};

/// Places on the border come out on either side of it, within the tolerance of interpolated positions.
bool on_scene(const geo::GridFrame& frame, Place p) {
    return p.x >= -kPositionTolerance && p.y >= -kPositionTolerance &&
           p.x <= frame.columns - 1 + kPositionTolerance && p.y <= frame.rows - 1 + kPositionTolerance;
}

Place on_frame(const geo::GridFrame& frame, Place p) {
    return {std::clamp(p.x, 0.0, frame.columns - 1.0), std::clamp(p.y, 0.0, frame.rows - 1.0)};
}

/// Height of the scene's surface; NaN where a post that it needs is void. \pre p is on the frame
double surface(const ScenePart& scene, const geo::GridFrame& frame, Place p) {
    if (std::abs(p.x - std::round(p.x)) <= kPostTolerance &&
        std::abs(p.y - std::round(p.y)) <= kPostTolerance)
        return scene.at(static_cast<int>(std::round(p.x)), static_cast<int>(std::round(p.y)));
    const int c0 = static_cast<int>(p.x);
    const int r0 = static_cast<int>(p.y);
    const int c1 = std::min(c0 + 1, frame.columns - 1);
    const int r1 = std::min(r0 + 1, frame.rows - 1);
    const double u = p.x - c0;
    const double v = p.y - r0;
    return (1 - v) * ((1 - u) * scene.at(c0, r0) + u * scene.at(c1, r0)) +
           v * ((1 - u) * scene.at(c0, r1) + u * scene.at(c1, r1));
}

/// The posts of a part that are within half a post of one that a layer above has.
class Covered {
  public:
    static Result<Covered> of(std::span<const LayerInScene> above, Window scene,
                              const geo::GridFrame& frame) {
        Covered covered;
        covered.window_ = whole_tiles(scene, frame);
        for (const LayerInScene& layer : above) {
            const Window common = common_part(layer.reach(), covered.window_);
            if (common.columns == 0 || common.rows == 0) continue;
            const auto posts =
                layer.read(covered.window_, std::vector<bool>(TileCount{covered.window_}.all(), true));
            if (!posts) return posts.error();
            if (covered.there_.columns() == 0)
                covered.there_ = lod::Raster<char>{covered.window_.columns, covered.window_.rows};
            for (std::size_t i = 0; i < covered.there_.samples().size(); ++i)
                if (!std::isnan(posts->heights.samples()[i])) covered.there_.samples()[i] = 1;
        }
        return covered;
    }

    bool operator()(Place p) const {
        if (there_.columns() == 0) return false;
        return there_.at(static_cast<int>(std::round(p.x)) - window_.column,
                         static_cast<int>(std::round(p.y)) - window_.row) != 0;
    }

  private:
    Window window_;
    lod::Raster<char> there_;
};

/// The posts of the scene around some places; nothing where none is on it.
std::optional<Window> scene_window(const geo::GridFrame& frame, const lod::Raster<Place>& places,
                                   Window part) {
    Window found{frame.columns, frame.rows, 0, 0};
    int right = -1;
    int bottom = -1;
    for (int r = part.row; r < part.row + part.rows; ++r)
        for (int c = part.column; c < part.column + part.columns; ++c) {
            if (!on_scene(frame, places.at(c, r))) continue;
            const Place p = on_frame(frame, places.at(c, r));
            found.column = std::min(found.column, static_cast<int>(p.x));
            found.row = std::min(found.row, static_cast<int>(p.y));
            right = std::max(right, std::min(static_cast<int>(p.x) + 1, frame.columns - 1));
            bottom = std::max(bottom, std::min(static_cast<int>(p.y) + 1, frame.rows - 1));
        }
    if (right < 0) return {};
    found.columns = right + 1 - found.column;
    found.rows = bottom + 1 - found.row;
    return found;
}

class Comparison {
  public:
    Comparison(const LayerInScene& layer, std::span<const LayerInScene> above, const geo::GridFrame& frame,
               bool part_wanted, const SceneHeights& scene)
        : layer_(layer), above_(above), frame_(frame), part_wanted_(part_wanted), scene_(scene) {}

    /// Halves a part of the truth until what it needs of the scene can be held at once.
    Result<void> part(const LayerPart& truth, const lod::Raster<Place>& places, Window w) {
        const auto needed = scene_window(frame_, places, w);
        if (needed && std::int64_t{needed->columns} * needed->rows > kMostScenePosts &&
            (w.columns > 1 || w.rows > 1)) {
            Window first = w;
            Window second = w;
            int& count = w.columns >= w.rows ? first.columns : first.rows;
            int& begin = w.columns >= w.rows ? second.column : second.row;
            int& rest = w.columns >= w.rows ? second.columns : second.rows;
            count /= 2;
            begin += count;
            rest -= count;
            if (auto done = part(truth, places, first); !done) return done;
            return part(truth, places, second);
        }
        ScenePart scene;
        Covered covered;
        if (needed) {
            auto heights = scene_(*needed);
            if (!heights) return heights.error();
            scene = {*needed, std::move(*heights)};
            auto above = Covered::of(above_, *needed, frame_);
            if (!above) return above.error();
            covered = std::move(*above);
        }
        for (int r = w.row; r < w.row + w.rows; ++r)
            for (int c = w.column; c < w.column + w.columns; ++c)
                compare(truth.posts.heights.at(c, r), places.at(c, r), scene, covered);
        return {};
    }

    const ErrorSum& sum() const { return sum_; }

  private:
    void compare(double height, Place place, const ScenePart& scene, const Covered& covered) {
        if (std::isnan(height)) return;
        const bool inside =
            place.x >= 0 && place.y >= 0 && place.x <= frame_.columns - 1 && place.y <= frame_.rows - 1;
        if (!on_scene(frame_, place)) {
            if (!part_wanted_) ++sum_.lost;
            return;
        }
        Place p = on_frame(frame_, place);
        // Own posts are the scene's, though their CRS may differ from WGS 84 by a thousandth of a step.
        if (layer_.own()) p = {std::round(p.x), std::round(p.y)};
        if (covered(p)) return;
        if (layer_.shift()) height += layer_.shift()->at(frame_.lat_lon({p.x, p.y}));
        const double difference = surface(scene, frame_, p) - height;
        if (std::isnan(difference)) {
            if (!part_wanted_ || inside) ++sum_.lost;
            return;
        }
        if (part_wanted_ && !inside) return;
        ++sum_.posts;
        sum_.squares += difference * difference;
        sum_.largest = std::max(sum_.largest, std::abs(difference));
    }

    const LayerInScene& layer_;
    std::span<const LayerInScene> above_;
    const geo::GridFrame& frame_;
    bool part_wanted_;
    const SceneHeights& scene_;
    ErrorSum sum_;
};

/// The part of a layer that may lie in the scene.
Window part_in_scene(const LayerInScene& layer, const geo::GridFrame& frame) {
    const Window all{0, 0, layer.layer().columns(), layer.layer().rows()};
    constexpr int kPlaces = 64;
    std::vector<Place> places;
    for (int j = 0; j <= kPlaces; ++j)
        for (int i = 0; i <= kPlaces; ++i)
            places.push_back({(frame.columns - 1.0) * i / kPlaces, (frame.rows - 1.0) * j / kPlaces});
    layer.map().to_source(places);
    double left = all.columns;
    double top = all.rows;
    double right = 0;
    double bottom = 0;
    for (const Place& p : places) {
        // A layer all round the earth has its columns modulo a turn: look at all.
        if (std::isnan(p.x) || layer.layer().turn() > 0) return all;
        left = std::min(left, p.x);
        top = std::min(top, p.y);
        right = std::max(right, p.x);
        bottom = std::max(bottom, p.y);
    }
    // What may bulge out between the places looked at.
    const double spare_x = 0.05 * (right - left) + kTransformTile;
    const double spare_y = 0.05 * (bottom - top) + kTransformTile;
    const auto clamped = [](double at, int most) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most)));
    };
    const int first_column = clamped(left - spare_x, all.columns) / kTransformTile * kTransformTile;
    const int first_row = clamped(top - spare_y, all.rows) / kTransformTile * kTransformTile;
    return {first_column, first_row, std::max(clamped(right + spare_x, all.columns) - first_column, 0),
            std::max(clamped(bottom + spare_y, all.rows) - first_row, 0)};
}

}  // namespace

void ErrorSum::add(const ErrorSum& other) {
    squares += other.squares;
    largest = std::max(largest, other.largest);
    posts += other.posts;
    lost += other.lost;
}

Result<ErrorSum> layer_error(const LayerInScene& layer, std::span<const LayerInScene> above, Window window,
                             const geo::GridFrame& frame, bool part_wanted, const SceneHeights& scene) {
    const auto truth = layer.layer().read(window);
    if (!truth) return truth.error();
    const auto places = transform_posts([&](std::span<Place> p) { layer.map().to_scene(p); }, window);
    Comparison comparison{layer, above, frame, part_wanted, scene};
    if (auto done = comparison.part(*truth, places, {0, 0, window.columns, window.rows}); !done)
        return done.error();
    return comparison.sum();
}

std::vector<Window> windows_to_compare(const LayerInScene& layer, const geo::GridFrame& frame,
                                       bool part_wanted) {
    const Layer& its = layer.layer();
    // The columns of a layer all round the earth end with the turn: what comes again is compared once.
    const int columns = its.turn() > 0 ? its.turn() : its.columns();
    const Window part = part_wanted ? part_in_scene(layer, frame) : Window{0, 0, columns, its.rows()};
    std::vector<Window> windows;
    for (int row = part.row; row < part.row + part.rows; row += kSide)
        for (int column = part.column; column < part.column + part.columns; column += kSide) {
            const Window window =
                common_part({column, row, kSide, kSide}, {0, 0, columns, part.row + part.rows});
            if (window.columns > 0 && its.has_posts_in(window)) windows.push_back(window);
        }
    return windows;
}

}  // namespace relevo::ingest
