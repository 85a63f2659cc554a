#include "viewer/ocean/ocean_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"
#include "lod/soar/pick.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/renderer.hpp"

namespace relevo::viewer {

namespace {

using What = ProbePicture::What;

/// A place on the sea as an eye sees it.
struct Seen {
    glm::dvec3 level;  // offset from the eye, ECEF axes
    glm::dvec3 up;

    Seen(const lod::View& view, const TrueSea& sea, geo::LatLon place)
        : level(geo::to_ecef({place.lat, place.lon, {sea.level_m(place)}}) - view.eye()),
          up(geo::EnuFrame({place.lat, place.lon, {0}}).up()) {}

    /// Nothing behind the eye.
    std::optional<glm::dvec2> pixel(const lod::View& view, double wave_m) const {
        const glm::dvec3 at = level + up * wave_m;
        if (view.depth(at) < lod::View::kNearM) return std::nullopt;
        return view.pixel(at);
    }
};

glm::dvec2 middle_of_pixel(int x, int y) {
    return {x + 0.5, y + 0.5};
}

}  // namespace

Result<OceanProbe> OceanProbe::create(int width, int height) {
    OceanProbe made;
    made.width_ = width;
    made.height_ = height;
    made.colour_ = GlRenderbuffer::create();
    made.depth_ = GlRenderbuffer::create();
    made.framebuffer_ = GlFramebuffer::create();
    const GlName name = made.framebuffer_.name();
    glNamedRenderbufferStorage(made.colour_.name(), GL_RGBA32F, width, height);
    glNamedRenderbufferStorage(made.depth_.name(), GL_DEPTH_COMPONENT32F, width, height);
    glNamedFramebufferRenderbuffer(name, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made.colour_.name());
    glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, made.depth_.name());
    if (auto done = gl_check("making the sea's probe"); !done) return done.error();
    if (glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return Error{ErrorKind::internal, "OpenGL cannot draw into floats"};
    return made;
}

Result<ProbePicture> OceanProbe::draw(Renderer& renderer, const lod::View& view,
                                      const DrawSettings& settings) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, height_);
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    const std::array<GLfloat, 4> nothing{};
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, nothing.data());
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, nothing.data());
    const auto drawn = renderer.probe(view, settings);
    if (!drawn) return drawn.error();

    const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    std::vector<std::array<float, 4>> read(count);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, read.data());
    if (auto done = gl_check("reading the sea's probe"); !done) return done.error();

    ProbePicture picture{view, settings.ocean.time_s, {}, drawn->ocean, {}};
    if (drawn->ocean.draw_calls > 0) picture.chart = renderer.ocean().chart();
    const geo::Geodetic& eye = view.camera().eye;
    const glm::dvec2 nadir = picture.chart ? picture.chart->at({eye.lat, eye.lon}) : glm::dvec2(0);
    picture.pixels.reserve(count);
    for (int y = height_ - 1; y >= 0; --y) {  // OpenGL's rows run upwards
        for (int x = 0; x < width_; ++x) {
            const auto& [east, north, wave, what] =
                read[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)];
            picture.pixels.push_back({static_cast<What>(std::lround(what)), nadir + glm::dvec2(east, north),
                                      static_cast<double>(wave)});
        }
    }
    return picture;
}

double TrueSea::wave_m(const glm::dvec2& at, double time_s, double water_m) const {
    return map ? map->height(at, time_s, 0, water_m) : waves->height(at, time_s, water_m);
}

double TrueSea::level_m(geo::LatLon place) const {
    return heights ? heights->undulation(place).m : 0;
}

SeaError measure_sea_error(const ProbePicture& picture, const TrueSea& sea) {
    SeaError error;
    std::vector<double> all;
    double squares = 0;
    double position_squares = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const ProbePicture::Pixel& pixel = picture.at(x, y);
            if (pixel.what != What::sea) continue;
            const geo::LatLon place = picture.chart->place(pixel.place);
            const double depth_m = sea.depth_m(place);
            if (std::isnan(depth_m)) continue;
            const double wave_m = sea.wave_m(pixel.place, picture.time_s, depth_m);
            const Seen seen(picture.view, sea, place);
            const auto is = seen.pixel(picture.view, wave_m);
            const auto drawn = seen.pixel(picture.view, pixel.wave_m);
            if (!is || !drawn) {
                ++error.behind;
                continue;
            }
            const double off = glm::distance(*is, *drawn);
            const double position_off = glm::distance(*is, middle_of_pixel(x, y));
            if (off > error.max_px) error.worst = {x, y};
            error.max_px = std::max(error.max_px, off);
            error.position_max_px = std::max(error.position_max_px, position_off);
            error.over += off > 1;
            squares += off * off;
            position_squares += position_off * position_off;
            all.push_back(off);
        }
    }
    error.pixels = all.size();
    if (all.empty()) return error;
    const auto count = static_cast<double>(all.size());
    error.rms_px = std::sqrt(squares / count);
    error.position_rms_px = std::sqrt(position_squares / count);
    const auto at_99 = all.begin() + static_cast<std::ptrdiff_t>(0.99 * (count - 1));
    std::nth_element(all.begin(), at_99, all.end());
    error.p99_px = *at_99;
    return error;
}

namespace {

/// The height that a picture draws at a place, from between four pixels, and how far it may be off; nothing
/// where they do not surround the place or there is not sea all around. \param guess  a pixel coordinate
struct Between {
    double wave_m;
    double uncertain_m;
};
std::optional<Between> between_pixels(const ProbePicture& picture, const glm::dvec2& place,
                                      const glm::dvec2& guess) {
    constexpr int kMoves = 4;
    int x = static_cast<int>(std::floor(guess.x - 0.5));
    int y = static_cast<int>(std::floor(guess.y - 0.5));
    for (int move = 0; move < kMoves; ++move) {
        if (x < 1 || y < 1 || x + 2 >= picture.width() || y + 2 >= picture.height()) return std::nullopt;
        for (int row = y - 1; row <= y + 2; ++row) {
            for (int column = x - 1; column <= x + 2; ++column) {
                if (picture.at(column, row).what != What::sea) return std::nullopt;
            }
        }
        const glm::dvec2 origin = picture.at(x, y).place;
        const glm::dvec2 right = picture.at(x + 1, y).place - origin;
        const glm::dvec2 down = picture.at(x, y + 1).place - origin;
        const glm::dvec2 twist = picture.at(x + 1, y + 1).place - origin - right - down;
        // Newton's steps for origin + s right + t down + s t twist = place.
        double s = 0.5;
        double t = 0.5;
        for (int step = 0; step < 6; ++step) {
            const glm::dvec2 along_s = right + t * twist;
            const glm::dvec2 along_t = down + s * twist;
            const glm::dvec2 missing = place - (origin + s * right + t * down + s * t * twist);
            const double area = along_s.x * along_t.y - along_s.y * along_t.x;
            if (area == 0) return std::nullopt;
            s += (missing.x * along_t.y - missing.y * along_t.x) / area;
            t += (along_s.x * missing.y - along_s.y * missing.x) / area;
        }
        if (!(std::abs(s) < 8 && std::abs(t) < 8)) return std::nullopt;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            const auto wave = [&](int column, int row) { return picture.at(x + column, y + row).wave_m; };
            double bend = 0;
            for (int i = 0; i <= 1; ++i) {
                for (int k = 0; k <= 1; ++k) {
                    bend = std::max(bend, std::abs(wave(i - 1, k) - 2 * wave(i, k) + wave(i + 1, k)) +
                                              std::abs(wave(i, k - 1) - 2 * wave(i, k) + wave(i, k + 1)));
                }
            }
            return Between{(1 - t) * ((1 - s) * wave(0, 0) + s * wave(1, 0)) +
                               t * ((1 - s) * wave(0, 1) + s * wave(1, 1)),
                           bend / 8};
        }
        x += static_cast<int>(std::floor(s));
        y += static_cast<int>(std::floor(t));
    }
    return std::nullopt;
}

}  // namespace

Swimming measure_swimming(const ProbePicture& first, const ProbePicture& second, const TrueSea& sea) {
    constexpr double kCertainPx = 0.02;
    Swimming swimming;
    double squares = 0;
    for (const ProbePicture::Pixel& pixel : second.pixels) {
        if (pixel.what != What::sea) continue;
        ++swimming.sea_pixels;
        if (!first.chart) continue;
        const geo::LatLon place = second.chart->place(pixel.place);
        const Seen before(first.view, sea, place);
        const auto guess = before.pixel(first.view, pixel.wave_m);
        if (!guess) continue;
        const auto drawn = between_pixels(first, first.chart->at(place), *guess);
        if (!drawn) continue;
        const Seen seen(second.view, sea, place);
        const auto now = seen.pixel(second.view, pixel.wave_m);
        const auto was = seen.pixel(second.view, drawn->wave_m);
        const auto maybe = seen.pixel(second.view, drawn->wave_m + drawn->uncertain_m);
        if (!now || !was || !maybe || glm::distance(*was, *maybe) > kCertainPx) continue;
        const double moved = glm::distance(*now, *was);
        swimming.max_px = std::max(swimming.max_px, moved);
        squares += moved * moved;
        ++swimming.pixels;
    }
    if (swimming.pixels > 0) swimming.rms_px = std::sqrt(squares / static_cast<double>(swimming.pixels));
    return swimming;
}

std::optional<geo::LatLon> HoleFinder::on_sea_level(const lod::View& view, const glm::dvec3& ray) const {
    const geo::Geodetic& eye = view.camera().eye;
    geo::LatLon place{eye.lat, eye.lon};
    const bool under = eye.h.m < sea_.level_m(place);
    // From below, only what is above the eye: else the far side of the earth would count.
    if (under && glm::dot(ray, geo::EnuFrame(eye).up()) <= 0) return std::nullopt;
    // The ellipsoid whose axes are longer by the level, first at the nadir, then where that is hit.
    for (int turn = 0; turn < 3; ++turn) {
        const double level_m = sea_.level_m(place);
        const glm::dvec3 axes(geo::wgs84::kSemiMajor + level_m, geo::wgs84::kSemiMajor + level_m,
                              geo::wgs84::kSemiMinor + level_m);
        const glm::dvec3 from = view.eye().m / axes;
        const glm::dvec3 way = ray / axes;
        const double a = glm::dot(way, way);
        const double b = glm::dot(from, way);
        const double c = glm::dot(from, from) - 1;
        const double discriminant = b * b - a * c;
        if (discriminant < 0) return std::nullopt;
        // The near one of two, from inside the far one; without cancelling.
        const double root = std::sqrt(discriminant);
        const double along = b >= 0 ? -c / (b + root) : c > 0 ? c / (root - b) : (root - b) / a;
        if (!(along > 0)) return std::nullopt;
        const geo::Geodetic hit = geo::to_geodetic(view.eye() + ray * along);
        place = {hit.lat, hit.lon};
    }
    return place;
}

bool HoleFinder::is_sea(int column, int row) {
    constexpr int kCells = lod::Pyramid::kBlockCells;
    const lod::PyramidBlock block{0, column / kCells, row / kCells};
    const auto [found, made] = classes_.try_emplace({block.column, block.row});
    if (made) {
        if (auto posts = terrain_.pyramid()->read_ground(block)) found->second = std::move(posts->is_sea);
    }
    return found->second && found->second->at(column % kCells, row % kCells) != 0;
}

bool HoleFinder::expects(const lod::View& view, const glm::dvec2& pixel) {
    const glm::dvec3 ray = view.ray(pixel);
    const auto place = on_sea_level(view, ray);
    if (!place) return false;
    const geo::GridFrame& grid = terrain_.frame();
    const geo::GridPosition at = grid.grid_position(*place);
    const int last_column = grid.columns - 1;
    const int last_row = grid.rows - 1;
    if (!grid.contains(at)) {
        const double column = std::clamp(at.column, 0.0, static_cast<double>(last_column));
        const double row = std::clamp(at.row, 0.0, static_cast<double>(last_row));
        return is_sea(static_cast<int>(std::lround(column)), static_cast<int>(std::lround(row)));
    }
    const int west = std::clamp(static_cast<int>(at.column), 0, std::max(last_column - 1, 0));
    const int north = std::clamp(static_cast<int>(at.row), 0, std::max(last_row - 1, 0));
    if (!lod::TruePosts::Reader(terrain_.posts()).is_valid_cell(west, north)) return false;
    if (is_sea(west, north) && is_sea(west + 1, north) && is_sea(west, north + 1) &&
        is_sea(west + 1, north + 1))
        return true;
    // Land, which may have been passed under where the data ends.
    return lod::pick_exactly(terrain_, view.eye(), ray).has_value();
}

std::vector<glm::ivec2> HoleFinder::holes(const ProbePicture& picture) {
    std::vector<glm::ivec2> found;
    const geo::Geodetic& eye = picture.view.camera().eye;
    const geo::LatLon nadir{eye.lat, eye.lon};
    const double eye_m = eye.h.m - sea_.level_m(nadir);
    constexpr double kDeep = std::numeric_limits<double>::infinity();
    const double crest_m = picture.chart ? sea_.wave_m(picture.chart->at(nadir), picture.time_s, kDeep) : 0;
    if (std::abs(eye_m) < std::abs(crest_m) && (eye_m > 0) == (crest_m > 0)) return found;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (picture.at(x, y).what != What::nothing) continue;
            const glm::dvec2 middle = middle_of_pixel(x, y);
            bool expected = expects(picture.view, middle);
            for (int k = 0; expected && k < 8; ++k) {
                const double angle = geo::Degrees{45.0 * k}.radians();
                expected = expects(picture.view, middle + 1.5 * glm::dvec2(std::cos(angle), std::sin(angle)));
            }
            if (expected) found.emplace_back(x, y);
        }
    }
    return found;
}

}  // namespace relevo::viewer
