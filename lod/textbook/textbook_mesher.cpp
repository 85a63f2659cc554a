#include "lod/textbook/textbook_mesher.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/mesh_heights.hpp"

namespace relevo::lod {

namespace {

std::uint64_t padded_posts(const geo::GridFrame& frame) {
    return static_cast<std::uint64_t>(frame.padded_side()) * static_cast<std::uint64_t>(frame.padded_side());
}

geo::GridFrame::Spacing middle_spacing(const geo::GridFrame& frame) {
    return frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
}

}  // namespace

Result<TextbookMesher> TextbookMesher::create(const Scene& scene, double exaggeration) {
    const geo::GridFrame& frame = scene.info().frame;
    if (padded_posts(frame) > kMostPosts) {
        return Error{ErrorKind::usage, fmt::format("its grid of {} x {} posts has to be in memory as a whole",
                                                   frame.padded_side(), frame.padded_side())};
    }
    const auto heights = scene.read_all_heights();
    if (!heights) return heights.error();
    Raster<float> exaggerated = mesh_heights(frame, *heights);
    for (float& H : exaggerated.samples()) H = static_cast<float>(exaggeration * static_cast<double>(H));
    return TextbookMesher(frame, scene.undulations(), std::move(exaggerated));
}

TextbookMesher::TextbookMesher(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights)
    : frame_(frame),
      positions_(frame),
      undulations_(std::move(undulations)),
      heights_(std::move(heights)),
      spacing_(middle_spacing(frame)),
      textbook_(heights_, spacing_.column_m, spacing_.row_m) {}

void TextbookMesher::refine(const View& view, geo::OrthometricHeight eye_H, double tau_px) {
    const geo::Geodetic& eye = view.camera().eye;
    const geo::GridPosition place = frame_.grid_position({eye.lat, eye.lon});
    const geo::EnuFrame local(eye);
    // Along the row, down the column, up: in a geographic grid east, south and up.
    const double turn = frame_.up_azimuth(eye.lon).radians();
    const glm::dvec3 up_column = std::sin(turn) * local.east() + std::cos(turn) * local.north();
    const glm::dvec3 along_row = std::cos(turn) * local.east() - std::sin(turn) * local.north();
    std::array<glm::dvec3, 4> planes;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const glm::dvec3& plane = view.side_planes()[i];
        planes[i] = {glm::dot(plane, along_row), -glm::dot(plane, up_column), glm::dot(plane, local.up())};
    }
    // The flat world is exaggerated as the ground is; the eye is where it is.
    const glm::dvec3 at(place.column * spacing_.column_m, place.row * spacing_.row_m, eye_H.m);
    strip_ = &textbook_.refine(at, planes, view.focal_px(), tau_px);
}

const Mesh& TextbookMesher::mesh(const View& view) {
    assert(strip_ != nullptr);
    mesh_.clear();
    index_of_post_.clear();
    const int side = heights_.columns();
    const auto vertex = [&](int post) {
        const auto [known, is_new] =
            index_of_post_.try_emplace(post, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) {
            const int column = post % side;
            const int row = post / side;
            const double h = undulations_.at(column, row) + static_cast<double>(heights_.at(column, row));
            const glm::vec3 offset(positions_.at(column, row, h) - view.eye().m);
            mesh_.vertices.push_back({offset.x, offset.y, offset.z, static_cast<std::uint16_t>(column),
                                      static_cast<std::uint16_t>(row)});
        }
        return known->second;
    };
    const std::vector<int>& strip = *strip_;
    for (std::size_t k = 2; k < strip.size(); ++k) {
        const int a = strip[k - 2];
        const int b = strip[k - 1];
        const int c = strip[k];
        if (a == b || b == c || a == c) continue;
        // int: a side has at most 8193 posts. Counter-clockwise seen from above, wherever the strip swapped:
        // rows run down.
        const int area =
            (b % side - a % side) * (c / side - a / side) - (b / side - a / side) * (c % side - a % side);
        if (area == 0) continue;
        const std::uint32_t first = vertex(area < 0 ? a : b);
        const std::uint32_t second = vertex(area < 0 ? b : a);
        mesh_.indices.insert(mesh_.indices.end(), {first, second, vertex(c)});
    }
    return mesh_;
}

std::uint64_t TextbookMesher::memory_bytes() const {
    return padded_posts(frame_) * 12 + (strip_ != nullptr ? strip_->size() * sizeof(int) : 0);
}

}  // namespace relevo::lod
