#include "lod/measure/viewshed.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lod/measure/sight_line.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/read_box.hpp"

namespace relevo::lod {
namespace {

/// Heights above the ellipsoid of a box of posts, and the highest of ever larger squares of cells. A cell
/// with a void corner is infinitely high there, so that no line is taken to pass over it unseen.
class HighGround {
  public:
    HighGround(const Scene& scene, const BlockGrid::Box& box, const Raster<float>& H)
        : h_(box.columns, box.rows) {
        const geo::GridFrame& frame = scene.info().frame;
        for_each_row(box.rows, [&](int row) {
            for (int column = 0; column < box.columns; ++column) {
                double h = static_cast<double>(H.at(column, row));
                if (scene.geoid() != nullptr && !std::isnan(h)) {
                    const geo::GridPosition at{box.column + column + 0.0, box.row + row + 0.0};
                    h += scene.geoid()->undulation(frame.lat_lon(at)).m;
                }
                h_.at(column, row) = h;
            }
        });
        Raster<float> cells(std::max(box.columns - 1, 1), std::max(box.rows - 1, 1));
        for_each_row(cells.rows(), [&](int row) {
            for (int column = 0; column < cells.columns(); ++column) {
                const Cell c = cell(column, row);
                const double highest = std::max({c.nw, c.ne, c.sw, c.se});
                const bool is_void = std::isnan(c.nw + c.ne + c.sw + c.se);
                cells.at(column, row) = is_void ? std::numeric_limits<float>::infinity()
                                                : std::nextafter(static_cast<float>(highest),
                                                                 std::numeric_limits<float>::infinity());
            }
        });
        levels_.push_back(std::move(cells));
        while (levels_.back().columns() > 1 || levels_.back().rows() > 1) {
            const Raster<float>& fine = levels_.back();
            Raster<float> coarse((fine.columns() + 1) / 2, (fine.rows() + 1) / 2,
                                 -std::numeric_limits<float>::infinity());
            for (int row = 0; row < fine.rows(); ++row) {
                for (int column = 0; column < fine.columns(); ++column) {
                    float& highest = coarse.at(column / 2, row / 2);
                    highest = std::max(highest, fine.at(column, row));
                }
            }
            levels_.push_back(std::move(coarse));
        }
    }

    struct Cell {
        double nw;
        double ne;
        double sw;
        double se;
        double at(double u, double v) const {
            const double north = nw + u * (ne - nw);
            const double south = sw + u * (se - sw);
            return north + v * (south - north);
        }
    };
    /// \pre it is one of the box's; of a box one post wide the same post twice
    Cell cell(int column, int row) const {
        const int east = std::min(column + 1, h_.columns() - 1);
        const int south = std::min(row + 1, h_.rows() - 1);
        return {h_.at(column, row), h_.at(east, row), h_.at(column, south), h_.at(east, south)};
    }
    int cell_column(double column) const {
        return std::clamp(static_cast<int>(std::floor(column)), 0, levels_[0].columns() - 1);
    }
    int cell_row(double row) const {
        return std::clamp(static_cast<int>(std::floor(row)), 0, levels_[0].rows() - 1);
    }

    double post(int column, int row) const { return h_.at(column, row); }

    /// As GridPath has it, of the box: where that ends before the data does, no line goes.
    bool inside(double column, double row) const {
        constexpr double kSlack = 0.5 * HeightSampler::kPostTolerance;
        return column >= -kSlack && row >= -kSlack && column <= h_.columns() - 1 + kSlack &&
               row <= h_.rows() - 1 + kSlack;
    }

    /// Nothing between these columns and rows is higher.
    double highest(double west, double east, double north, double south) const {
        int x0 = cell_column(west);
        int x1 = cell_column(east);
        int y0 = cell_row(north);
        int y1 = cell_row(south);
        std::size_t level = 0;
        while (x1 - x0 > 1 || y1 - y0 > 1) {
            ++level;
            x0 /= 2;
            x1 /= 2;
            y0 /= 2;
            y1 /= 2;
        }
        const Raster<float>& cells = levels_[level];
        float most = -std::numeric_limits<float>::infinity();
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) most = std::max(most, cells.at(x, y));
        }
        return static_cast<double>(most);
    }

  private:
    template <class Work>
    static void for_each_row(int rows, const Work& work) {
        tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const tbb::blocked_range<int>& range) {
            for (int row = range.begin(); row < range.end(); ++row) work(row);
        });
    }

    Raster<double> h_;
    std::vector<Raster<float>> levels_;
};

/// A coordinate along a line: a cubic of t in [0, 1].
struct Cubic {
    double a = 0;
    double b = 0;
    double c = 0;
    double d = 0;

    /// Through values at 0, 1/3, 2/3 and 1.
    static Cubic through(double p0, double p1, double p2, double p3) {
        return {p0, -5.5 * p0 + 9 * p1 - 4.5 * p2 + p3, 9 * p0 - 22.5 * p1 + 18 * p2 - 4.5 * p3,
                -4.5 * p0 + 13.5 * p1 - 13.5 * p2 + 4.5 * p3};
    }
    double at(double t) const { return a + t * (b + t * (c + t * d)); }
    /// An eighth of the largest second derivative: how far it bends off a chord over t of length 1.
    double bend() const { return std::max(std::abs(2 * c), std::abs(2 * c + 6 * d)) / 8; }
};

/// One line of sight over the ground.
class Line {
  public:
    Line(const HighGround& ground, const Cubic& column, const Cubic& row, const SightLine& sight,
         double steepest)
        : ground_(ground),
          column_(column),
          row_(row),
          sight_(sight),
          bend_(std::max(column.bend(), row.bend())),
          // A straight line's height bends away from its chord by no more than this over a whole length: its
          // second derivative is the curvature times (1 + 2 tan^2) of its angle with the horizon, nearly.
          sag_(sight.length_m() * sight.length_m() * sight.effective_curvature() / 8 *
               (1.01 + 2 * steepest * steepest)) {}

    /// Is ground in the way between two parts of the length?
    bool is_blocked(double from, double to) { return blocked(at(from), at(to)); }

    bool unknown = false;  ///< a void was met, or the data left
    double blocked_at = 0;

  private:
    struct Point {
        double t;
        double column;
        double row;
        double height;
    };

    Point at(double t) const { return {t, column_.at(t), row_.at(t), sight_.height(t * sight_.length_m())}; }

    bool blocked(const Point& p, const Point& q) {
        const double dt = q.t - p.t;
        const double bend = bend_ * dt * dt + 1e-9;
        const auto [west, east] = std::minmax(p.column, q.column);
        const auto [north, south] = std::minmax(p.row, q.row);
        const double lowest = std::min(p.height, q.height) - std::max(sag_, 0.0) * dt * dt;
        const bool inside =
            ground_.inside(west - bend, north - bend) && ground_.inside(east + bend, south + bend);
        if (inside && ground_.highest(west - bend, east + bend, north - bend, south + bend) <= lowest)
            return false;
        constexpr double kShort = 2;
        constexpr double kStraight = 2e-5;
        if (east - west <= kShort && south - north <= kShort && bend <= kStraight)
            return blocked_in_cells(p, q);
        const Point middle = at(0.5 * (p.t + q.t));
        return blocked(p, middle) || blocked(middle, q);
    }

    /// Exactly, over few cells, in which the line is straight: 2e-5 posts from the cubic at most.
    bool blocked_in_cells(const Point& p, const Point& q) {
        std::array<double, 12> cuts{};
        std::size_t count = 0;
        cuts[count++] = 0;
        const auto cross = [&](double from, double to) {
            const double low = std::min(from, to);
            const double high = std::max(from, to);
            for (double whole = std::floor(low) + 1; whole < high && count + 1 < cuts.size(); ++whole)
                cuts[count++] = (whole - from) / (to - from);
        };
        cross(p.column, q.column);
        cross(p.row, q.row);
        cuts[count++] = 1;
        for (std::size_t i = 1; i < count; ++i) {  // sorted by insertion: they are few
            for (std::size_t k = i; k > 0 && cuts[k] < cuts[k - 1]; --k) std::swap(cuts[k], cuts[k - 1]);
        }
        for (std::size_t i = 0; i + 1 < count; ++i) {
            if (cuts[i + 1] > cuts[i] && blocked_in_cell(p, q, cuts[i], cuts[i + 1])) return true;
        }
        return false;
    }

    bool blocked_in_cell(const Point& p, const Point& q, double from, double to) {
        const double dc = q.column - p.column;
        const double dr = q.row - p.row;
        const double middle = 0.5 * (from + to);
        const bool inside = ground_.inside(p.column + middle * dc, p.row + middle * dr);
        const int column = ground_.cell_column(p.column + middle * dc);
        const int row = ground_.cell_row(p.row + middle * dr);
        const HighGround::Cell cell = ground_.cell(column, row);
        if (!inside || std::isnan(cell.nw + cell.ne + cell.sw + cell.se)) {
            unknown = unknown || (to - from) * std::max(std::abs(dc), std::abs(dr)) > 1e-6;
            return false;
        }
        const auto clearance = [&](double part) {
            const double t = p.t + part * (q.t - p.t);
            return sight_.height(t * sight_.length_m()) -
                   cell.at(p.column + part * dc - column, p.row + part * dr - row);
        };
        const double first = clearance(from);
        const double half = clearance(middle);
        const double last = clearance(to);
        double least = std::min({first, half, last});
        const double curve = first + last - 2 * half;
        if (curve > 0) {
            const double off = 0.5 * (first - last) / curve;  // of half the piece, from its middle
            if (std::abs(off) < 1) least = std::min(least, clearance(middle + 0.5 * off * (to - from)));
        }
        if (least >= -kSightTolerance) return false;
        blocked_at = (p.t + middle * (q.t - p.t)) * sight_.length_m();
        return true;
    }

    const HighGround& ground_;
    const Cubic& column_;
    const Cubic& row_;
    const SightLine& sight_;
    double bend_;
    double sag_;
};

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

/// Lines of sight from one eye.
class Lookout {
  public:
    Lookout(const geo::GridFrame& frame, const BlockGrid::Box& box, const HighGround& ground, geo::LatLon eye,
            double eye_h, const Looking& looking)
        : frame_(frame),
          box_(box),
          ground_(ground),
          looking_(looking),
          eye_(frame.grid_position(eye)),
          eye_h_(eye_h) {
        eye_place_ = {eye.lat, frame.is_polar() ? eye.lon : frame.lat_lon(eye_).lon};
    }

    /// \param hint  where the last line was blocked, and then this
    Viewshed::Seen look(int column, int row, double radius, double& hint) const {
        const double ground = ground_.post(column, row);
        if (std::isnan(ground)) return Viewshed::none;
        const geo::GeodesicPath path(eye_place_, place(column, row));
        const double length = path.length_m();
        if (length > radius) return Viewshed::none;
        if (length == 0) return Viewshed::visible;
        const auto [columns, rows] = cubics(path, column, row);
        const double target_h = ground + looking_.target_height_m;
        const SightLine sight(length, mean_curvature(path), looking_.refraction, eye_h_, target_h);
        const double steepest =
            std::abs(target_h - eye_h_) / length + length * std::abs(sight.effective_curvature());
        Line line(ground_, columns, rows, sight, steepest);
        if (hint > 0 && hint < length) {
            // Neighbours are mostly hidden by the same ridge.
            const double reach = 3 / std::max(1.0, std::hypot(column - eye_.column, row - eye_.row));
            const double middle = hint / length;
            if (line.is_blocked(std::max(0.0, middle - reach), std::min(1.0, middle + reach))) {
                hint = line.blocked_at;
                return Viewshed::hidden;
            }
        }
        line.unknown = false;
        if (line.is_blocked(0, 1)) {
            hint = line.blocked_at;
            return Viewshed::hidden;
        }
        return line.unknown ? Viewshed::unknown : Viewshed::visible;
    }

    /// How far, in posts, the cubic to a post is from the geodesic.
    double bend_error(int column, int row) const {
        const geo::GeodesicPath path(eye_place_, place(column, row));
        if (path.length_m() == 0) return 0;
        const auto [columns, rows] = cubics(path, column, row);
        double worst = 0;
        for (const double t : {1.0 / 6, 0.5, 5.0 / 6}) {
            const auto at = position(path, t);
            worst = std::max({worst, std::abs(columns.at(t) - at.column), std::abs(rows.at(t) - at.row)});
        }
        return worst;
    }

  private:
    geo::LatLon place(int column, int row) const {
        return frame_.lat_lon({box_.column + column + 0.0, box_.row + row + 0.0});
    }

    /// In the box.
    geo::GridPosition position(const geo::GeodesicPath& path, double part) const {
        const geo::LatLon at = path.at(part * path.length_m());
        geo::GridPosition grid;
        if (frame_.is_polar()) {
            grid = frame_.grid_position(at);
        } else {
            grid = {(at.lon.value - frame_.west) / frame_.step_x,
                    (frame_.north - at.lat.value) / frame_.step_y};
        }
        return {grid.column - box_.column, grid.row - box_.row};
    }

    std::pair<Cubic, Cubic> cubics(const geo::GeodesicPath& path, int column, int row) const {
        const auto first = position(path, 1.0 / 3);
        const auto second = position(path, 2.0 / 3);
        return {Cubic::through(eye_.column - box_.column, first.column, second.column, column),
                Cubic::through(eye_.row - box_.row, first.row, second.row, row)};
    }

    const geo::GridFrame& frame_;
    BlockGrid::Box box_;
    const HighGround& ground_;
    const Looking& looking_;
    geo::GridPosition eye_;
    double eye_h_;
    geo::LatLon eye_place_;
};

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
