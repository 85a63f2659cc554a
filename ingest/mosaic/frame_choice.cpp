#include "ingest/mosaic/frame_choice.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geo/angle.hpp"
#include "ingest/mosaic/frame_plane.hpp"
#include "ingest/mosaic/lattice.hpp"
#include "ingest/mosaic/longitudes.hpp"
#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

constexpr double kSamePost = 1e-6;     // posts: closer than this is the same place
constexpr int kMostColumns = 1 << 30;  // of a frame, so that an absurd step is an error and not an overflow
constexpr double kPolarLatitude = 75;  // degrees
constexpr double kAlmostFinest = 1.02;

/// What all the data covers, in degrees; longitudes continuous.
struct Coverage {
    Bounds bounds;
    bool all_round = false;
    bool north_pole = false;  // one point inside a source
    bool south_pole = false;

    bool pole() const { return north_pole || south_pole; }
};

/// Places to look at a side of each source, fewer of many sources.
int places_a_side(const std::vector<PostGrid>& grids, int of_one, int least) {
    double parts = 0;
    for (const PostGrid& grid : grids) parts += static_cast<double>(grid.parts.size());
    return std::clamp(static_cast<int>(of_one / std::sqrt(parts)), least, of_one);
}

/// Steps of longitude, roughly.
double lon_step(const PostGrid& grid) {
    if (grid.crs->geographic()) return std::abs(grid.posts.x_column) * 360 / grid.crs->full_turn();
    const FramePlane degrees{geo::FrameKind::geographic};
    const auto density = density_of(grid.parts[0], degrees, lattice_of(grid.parts[0], 5));
    return density ? 1 / density->x : 0;
}

std::optional<Coverage> coverage_of(std::vector<PostGrid>& grids, const TargetRequest& request) {
    const FramePlane degrees{geo::FrameKind::geographic};
    const int count = places_a_side(grids, 4096, 33);
    Coverage covered;
    std::vector<Bounds> extents;
    std::vector<LonReach> reaches;
    double step = 0;
    for (PostGrid& grid : grids) {
        step = std::max(step, lon_step(grid));
        for (SourceMap& part : grid.parts) {
            const bool north = holds_pole(part, 90);
            const bool south = holds_pole(part, -90);
            if ((north || south) && request.crop)
                part.set_middle_lon(0.5 * (request.crop->west + request.crop->east) +
                                    (request.crop->east <= request.crop->west ? 180 : 0));
            auto extent = extent_of(part, degrees, count);
            if (!extent) continue;
            if (north) extent->north = 90;
            if (south) extent->south = -90;
            if (north || south) {
                extent->west = part.middle_lon() - 180;
                extent->east = part.middle_lon() + 180;
            }
            covered.north_pole |= north;
            covered.south_pole |= south;
            extents.push_back(*extent);
            reaches.push_back({extent->west, extent->east});
        }
    }
    if (extents.empty()) return {};
    // From the end of the largest gap on, in the turn that the first source is in.
    const double start = start_after_largest_gap(reaches, 360);
    const double base = start + 360 * std::floor((extents[0].west - start) / 360 + 1e-9);
    covered.bounds = {extents[0].west, extents[0].south, extents[0].east, extents[0].north};
    for (Bounds& e : extents) {
        const double turns = 360 * std::floor((e.west - base) / 360 + 1e-9);
        covered.bounds = {
            std::min(covered.bounds.west, e.west - turns), std::min(covered.bounds.south, e.south),
            std::max(covered.bounds.east, e.east - turns), std::max(covered.bounds.north, e.north)};
    }
    covered.all_round = covered.bounds.east - covered.bounds.west >= 360 - 1.5 * step;
    return covered;
}

std::string text_of(const Bounds& b) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", b.west, b.south, b.east, b.north);
}

/// The part of the data's bounds that a crop leaves, whichever turn its longitudes are in.
Result<Bounds> cropped(const std::string& name, const Coverage& data, Bounds crop) {
    if (crop.east <= crop.west) crop.east += 360;
    if (!(crop.north >= crop.south) || crop.east - crop.west > 360)
        return Error{ErrorKind::usage, "--crop: W,S,E,N in degrees, with S < N"};
    const Bounds& all = data.bounds;
    const double turns =
        360 * std::round((0.5 * (all.west + all.east) - 0.5 * (crop.west + crop.east)) / 360);
    Bounds left{crop.west, std::max(crop.south, all.south), crop.east, std::min(crop.north, all.north)};
    if (!data.all_round) {
        left.west = std::max(crop.west + turns, all.west);
        left.east = std::min(crop.east + turns, all.east);
    }
    if (left.west > left.east || left.south > left.north)
        return refusal(name, "--crop leaves nothing of it",
                       fmt::format("It covers W,S,E,N = {}", text_of(all)));
    return left;
}

Result<geo::FrameKind> kind_of(const std::string& name, const Coverage& covered, const Bounds& part,
                               const TargetRequest& request) {
    using geo::FrameKind;
    const bool whole = !request.crop;
    const double middle = 0.5 * (part.south + part.north);
    const FrameKind nearer = whole && covered.north_pole != covered.south_pole
                                 ? (covered.north_pole ? FrameKind::ups_north : FrameKind::ups_south)
                                 : (middle >= 0 ? FrameKind::ups_north : FrameKind::ups_south);
    if (request.frame == FrameChoice::ups) return nearer;
    const bool beyond =
        std::abs(middle) > kPolarLatitude || (whole && covered.north_pole != covered.south_pole);
    if (request.frame == FrameChoice::automatic && beyond) return nearer;
    if (whole && covered.pole())
        return refusal(name, "it has a pole inside, where a grid of latitudes and longitudes cannot hold it",
                       "Take --frame ups, or a part beside the pole with --crop W,S,E,N in degrees");
    return FrameKind::geographic;
}

/// A rectangle of degrees in the plane of a polar grid.
Bounds polar_bounds(const Bounds& degrees, const FramePlane& plane) {
    std::vector<Place> places;
    constexpr int kPlaces = 1440;
    for (int i = 0; i <= kPlaces; ++i) {
        const double lon = degrees.west + (degrees.east - degrees.west) * i / kPlaces;
        const double lat = degrees.south + (degrees.north - degrees.south) * i / kPlaces;
        places.insert(places.end(),
                      {{lon, degrees.south}, {lon, degrees.north}, {degrees.west, lat}, {degrees.east, lat}});
    }
    // Where the sides bulge farthest out.
    for (double lon = 90 * std::ceil(degrees.west / 90); lon <= degrees.east; lon += 90)
        places.insert(places.end(), {{lon, degrees.south}, {lon, degrees.north}});
    plane.from_lon_lat(places);
    Bounds found{places[0].x, places[0].y, places[0].x, places[0].y};
    for (const Place& p : places)
        found = {std::min(found.west, p.x), std::min(found.south, p.y), std::max(found.east, p.x),
                 std::max(found.north, p.y)};
    return found;
}

/// What the scene is to cover, in its plane.
std::optional<Bounds> bounds_in(const FramePlane& plane, const std::vector<PostGrid>& grids,
                                const Bounds& degrees, bool is_crop) {
    if (!plane.is_polar()) return degrees;
    std::optional<Bounds> all;
    const int count = places_a_side(grids, 4096, 33);
    for (const PostGrid& grid : grids)
        for (const SourceMap& part : grid.parts) {
            const auto e = extent_of(part, plane, count);
            if (!e) continue;
            all = !all ? *e
                       : Bounds{std::min(all->west, e->west), std::min(all->south, e->south),
                                std::max(all->east, e->east), std::max(all->north, e->north)};
        }
    if (!all || !is_crop) return all;
    const Bounds crop = polar_bounds(degrees, plane);
    return Bounds{std::max(all->west, crop.west), std::max(all->south, crop.south),
                  std::min(all->east, crop.east), std::min(all->north, crop.north)};
}

/// Posts at which the density is taken: all over a source, or all over what a crop leaves of it.
std::vector<Place> density_places(const SourceMap& map, const std::optional<Bounds>& crop, int count) {
    if (!crop) return lattice_of(map, count);
    std::vector<Place> places;
    const int cells = 2 * count;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            places.push_back({crop->west + (crop->east - crop->west) * i / cells,
                              crop->south + (crop->north - crop->south) * j / cells});
    map.from_lon_lat(places);
    std::erase_if(places, [&](Place p) {
        return !(p.x >= -0.5 && p.x <= map.columns() - 0.5 && p.y >= -0.5 && p.y <= map.rows() - 0.5);
    });
    return places;
}

/// A grid as the frame sees it.
struct Candidate {
    std::optional<Density> density;
    std::optional<double> distance;  // from the plane, where it is a lattice of it
};

bool has_resolution(const PostGrid& grid, const TargetRequest& request) {
    if (!request.resolution) return true;
    return std::abs(request.resolution->first / std::abs(grid.posts.x_column) - 1) < 1e-9 &&
           std::abs(request.resolution->second / std::abs(grid.posts.y_row) - 1) < 1e-9;
}

std::vector<Candidate> candidates(const std::vector<PostGrid>& grids, const FramePlane& plane,
                                  const std::optional<Bounds>& crop) {
    const int count = places_a_side(grids, 33, 3);
    std::vector<Candidate> all;
    for (const PostGrid& grid : grids) {
        Candidate candidate;
        const auto distance = distance_from_plane(grid, plane);
        if (distance && *distance <= kLatticeTolerance) candidate.distance = distance;
        for (const SourceMap& part : grid.parts) {
            const auto density = density_of(part, plane, density_places(part, crop, count));
            if (!density) continue;
            if (!candidate.density) candidate.density = Density{};
            candidate.density->x = std::max(candidate.density->x, density->x);
            candidate.density->y = std::max(candidate.density->y, density->y);
        }
        if (candidate.density && candidate.distance)
            candidate.density = {1 / std::abs(grid.posts.x_column), 1 / std::abs(grid.posts.y_row)};
        all.push_back(candidate);
    }
    return all;
}

/// The densest of the grids whose posts are about as close as the closest.
std::optional<Density> finest_density(const std::vector<PostGrid>& grids, const std::vector<Candidate>& all) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grids.size(); ++i)
        if (all[i].density) least = std::min(least, grids[i].spacing_m);
    std::optional<Density> finest;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (!all[i].density || !(grids[i].spacing_m <= kAlmostFinest * least)) continue;
        if (!finest) finest = Density{};
        finest->x = std::max(finest->x, all[i].density->x);
        finest->y = std::max(finest->y, all[i].density->y);
    }
    return finest;
}

/// The grid whose lattice the frame takes.
const PostGrid* lattice_for(const std::vector<PostGrid>& grids, const std::vector<Candidate>& all,
                            const Density& finest, const TargetRequest& request) {
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (!all[i].density || !all[i].distance || !has_resolution(grids[i], request)) continue;
        const bool close =
            all[i].density->x * kAlmostFinest >= finest.x && all[i].density->y * kAlmostFinest >= finest.y;
        if (request.resolution || close) return &grids[i];
    }
    return nullptr;
}

/// First and number of posts of a lattice along an axis.
struct Posts {
    double first = 0;
    double count = 1;
};

/// Those inside bounds (in steps from the lattice's first post), or those that reach over them.
Posts posts_over(double low, double high, bool inside) {
    if (inside) {
        const double first = std::ceil(low - kSamePost);
        return {first, std::floor(high + kSamePost) - first + 1};
    }
    const double first = std::floor(low + kLatticeTolerance);
    return {first, std::ceil(high - kLatticeTolerance) - first + 1};
}

Result<geo::GridFrame> aligned_frame(const std::string& name, const PostGrid& grid, const FramePlane& plane,
                                     const Bounds& bounds, bool crop, bool all_round) {
    const Affine& posts = grid.posts;
    geo::GridFrame frame;
    frame.kind = plane.kind();
    frame.step_x = std::abs(posts.x_column);
    frame.step_y = std::abs(posts.y_row);
    const double x0 = posts.x_column < 0 ? posts.x0 + posts.x_column * (grid.map.columns() - 1) : posts.x0;
    const double north = posts.y_row > 0 ? posts.y0 + posts.y_row * (grid.map.rows() - 1) : posts.y0;
    const double middle = x0 + 0.5 * frame.step_x * (grid.map.columns() - 1);
    const double turns =
        plane.is_polar() ? 0 : 360 * std::round((0.5 * (bounds.west + bounds.east) - middle) / 360);
    Posts across = posts_over((bounds.west - turns - x0) / frame.step_x,
                              (bounds.east - turns - x0) / frame.step_x, crop);
    const Posts down =
        posts_over((north - bounds.north) / frame.step_y, (north - bounds.south) / frame.step_y, crop);
    if (all_round && !crop && !plane.is_polar()) across.count = std::round(360 / frame.step_x) + 1;
    if (!(across.count >= 1) || !(down.count >= 1))
        return refusal(name, "--crop leaves nothing of it: it lies between its posts", "Take a larger part");
    if (!(across.count < kMostColumns) || !(down.count < kMostColumns))
        return refusal(name, "its grid would have too many posts",
                       "Check --crs and --bounds, or give --resolution");
    // Bit for bit the grid's own where it starts with it.
    const double west = across.first == 0 ? x0 : x0 + across.first * frame.step_x;
    frame.west =
        plane.is_polar() || (west >= -180 && west < 180) ? west : geo::wrapped_180(geo::Degrees{west}).value;
    frame.north = down.first == 0 ? north : north - down.first * frame.step_y;
    frame.columns = static_cast<int>(across.count);
    frame.rows = static_cast<int>(down.count);
    return frame;
}

/// Number of posts from 0 over a span, and the step that makes the last one its end.
struct Axis {
    double posts = 1;
    double step = 1;
};

Axis fitted(double span, double step) {
    if (span < kSamePost * step) return {1, step};
    const double cells = std::max(1.0, std::ceil(span / step - kSamePost));
    return {cells + 1, span / cells};
}

Axis fixed(double span, double step) {
    return {std::ceil(span / step - kSamePost) + 1, step};
}

Result<geo::GridFrame> fitted_frame(const std::string& name, const Density& finest, const FramePlane& plane,
                                    const Bounds& bounds, bool all_round, const TargetRequest& request) {
    const bool closed = all_round && !request.crop && !plane.is_polar();
    const double width = closed ? 360 : bounds.east - bounds.west;
    const double height = bounds.north - bounds.south;
    Axis x = request.resolution ? fixed(width, request.resolution->first) : fitted(width, 1 / finest.x);
    Axis y = request.resolution ? fixed(height, request.resolution->second) : fitted(height, 1 / finest.y);
    if (closed && request.resolution) x.posts = std::round(360 / x.step) + 1;
    if (!plane.is_polar())
        y.posts = std::min(y.posts, std::floor((bounds.north + 90) / y.step + kSamePost) + 1);
    if (!(x.posts < kMostColumns) || !(y.posts < kMostColumns) || !(x.posts >= 1) || !(y.posts >= 1))
        return refusal(name, "its grid would have too many posts",
                       "Check --crs and --bounds, or give --resolution");
    geo::GridFrame frame;
    frame.kind = plane.kind();
    frame.west = plane.is_polar() ? bounds.west : geo::wrapped_180(geo::Degrees{bounds.west}).value;
    frame.north = bounds.north;
    frame.step_x = x.step;
    frame.step_y = y.step;
    frame.columns = static_cast<int>(x.posts);
    frame.rows = static_cast<int>(y.posts);
    return frame;
}

/// The posts of a grid that are the frame's, where it lies on its lattice.
std::optional<OwnPosts> own_posts(const PostGrid& grid, const geo::GridFrame& frame) {
    const int columns = grid.map.columns();
    const int rows = grid.map.rows();
    Affine lattice;
    lattice.x0 = frame.west;
    lattice.x_column = frame.step_x;
    lattice.y0 = frame.north;
    lattice.y_row = -frame.step_y;
    OwnPosts own;
    Affine posts = grid.posts;
    own.flip_columns = posts.x_column < 0;
    own.flip_rows = posts.y_row > 0;
    if (own.flip_columns) {
        posts.x0 += posts.x_column * (columns - 1);
        posts.x_column = -posts.x_column;
    }
    if (own.flip_rows) {
        posts.y0 += posts.y_row * (rows - 1);
        posts.y_row = -posts.y_row;
    }
    if (!frame.is_polar()) {
        const double middle = frame.west + 0.5 * frame.step_x * (frame.columns - 1);
        const double its_middle = posts.x0 + 0.5 * posts.x_column * (columns - 1);
        posts.x0 += 360 * std::round((middle - its_middle) / 360);
    }
    const auto window = window_in(lattice, posts, columns, rows);
    if (!window) return {};
    own.column = own.flip_columns ? columns - 1 + window->column : -window->column;
    own.row = own.flip_rows ? rows - 1 + window->row : -window->row;
    return own;
}

Result<void> check(const std::string& name, double south, double north) {
    constexpr double kTiny = 1e-6;  // degrees
    if (north <= 90 + kTiny && south >= -90 - kTiny) return {};
    return refusal(name, fmt::format("it has posts beyond a pole (latitudes {:.6f} to {:.6f})", south, north),
                   "Check --crs and --bounds");
}

}  // namespace

Result<ChosenFrame> choose_frame(const std::string& name, std::vector<PostGrid> grids,
                                 const TargetRequest& request) {
    for (const PostGrid& grid : grids)
        for (const SourceMap& part : grid.parts)
            if (grid.crs->geographic() &&
                std::abs(grid.posts.x_column) * (part.columns() - 1 - kSamePost) > grid.crs->full_turn())
                return refusal(name, "it goes more than once round the earth",
                               "Take a part of it with `gdal_translate -projwin` first");
    const auto covered = coverage_of(grids, request);
    if (!covered) return refusal(name, "none of its posts has a place on earth", "Check the CRS (--crs)");
    Bounds degrees = covered->bounds;
    if (auto sound = check(name, degrees.south, degrees.north); !sound) return sound.error();
    std::optional<Bounds> crop;
    if (request.crop) {
        const auto part = cropped(name, *covered, *request.crop);
        if (!part) return part.error();
        crop = degrees = *part;
    }
    const auto kind = kind_of(name, *covered, degrees, request);
    if (!kind) return kind.error();
    const FramePlane plane{*kind};
    const auto bounds = bounds_in(plane, grids, degrees, crop.has_value());
    const auto all = candidates(grids, plane, crop);
    const auto finest = finest_density(grids, all);
    if (!bounds || !finest)
        return refusal(name, "it has no place on earth there", "Check --crs, --bounds and --crop");

    const PostGrid* lattice = lattice_for(grids, all, *finest, request);
    auto frame = lattice != nullptr
                     ? aligned_frame(name, *lattice, plane, *bounds, crop.has_value(), covered->all_round)
                     : fitted_frame(name, *finest, plane, *bounds, covered->all_round, request);
    if (!frame) return frame.error();

    ChosenFrame chosen{*frame, {}, {}};
    double moved = 0;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        ChosenFrame::Use use;
        if (all[i].distance) use.own = own_posts(grids[i], *frame);
        if (use.own) moved = std::max(moved, *all[i].distance);
        if (!use.own && all[i].density)
            use.downsamples =
                frame->step_x * all[i].density->x > 1.01 || frame->step_y * all[i].density->y > 1.01;
        chosen.uses.push_back(use);
    }
    if (moved > kSamePost)
        chosen.notes.push_back(
            fmt::format("its posts are kept as WGS 84, which moves them by {:.2g} of a step", moved));
    return chosen;
}

}  // namespace relevo::ingest
