#include "viewer/terrain_textures.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "viewer/gl_check.hpp"

namespace relevo::viewer {

namespace {

using Heights = lod::Raster<float>;
using Texel = std::array<std::int16_t, 4>;

std::int16_t snorm(double value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

/// Rise of the surface from `before` to `after` through `here`, metres a metre; a void on one side leaves the
/// other.
double slope(float before, float here, float after, double spacing) {
    if (!(spacing > 1e-6)) return 0;  // a pole's row is one point
    const bool has_before = !std::isnan(before);
    const bool has_after = !std::isnan(after);
    if (has_before && has_after) return (after - before) / (2 * spacing);
    if (has_after) return (after - here) / spacing;
    return has_before ? (here - before) / spacing : 0;
}

struct HeightRange {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
    double lowest_land = std::numeric_limits<double>::infinity();
    bool has_voids = false;
};

HeightRange height_range(const Heights& heights, const lod::Raster<std::uint8_t>& sea) {
    HeightRange range;
    for (std::size_t i = 0; i < heights.samples().size(); ++i) {
        const float H = heights.samples()[i];
        if (std::isnan(H)) {
            range.has_voids = true;
            continue;
        }
        range.lowest = std::min(range.lowest, static_cast<double>(H));
        range.highest = std::max(range.highest, static_cast<double>(H));
        const bool is_sea = !sea.samples().empty() && sea.samples()[i] != 0;
        if (!is_sea) range.lowest_land = std::min(range.lowest_land, static_cast<double>(H));
    }
    range.lowest_land = std::min(range.lowest_land, range.highest);
    return range;
}

void fill_row(const lod::Terrain& terrain, const Heights& heights, const HeightRange& range, int row,
              Texel* out) {
    const geo::PolarPositions* polar = terrain.positions().polar();
    geo::GridFrame::Spacing spacing = terrain.frame().spacing({0, static_cast<double>(row)});
    const bool round = terrain.frame().closes();  // beyond the last column is the second
    const int last = heights.columns() - 1;
    const float none = std::numeric_limits<float>::quiet_NaN();
    const float* here = heights.row(row);
    const float* north = row > 0 ? heights.row(row - 1) : nullptr;
    const float* south = row + 1 < heights.rows() ? heights.row(row + 1) : nullptr;
    const double middle = 0.5 * (range.lowest + range.highest);
    const double half_range = std::max(0.5 * (range.highest - range.lowest), 1e-6);
    for (int column = 0; column < heights.columns(); ++column) {
        const float H = here[column];
        if (std::isnan(H)) {
            out[column] = {0, 0, 0, 0};
            continue;
        }
        if (polar != nullptr) spacing = polar->spacing(column, row);
        const double along = slope(column > 0 ? here[column - 1]
                                   : round    ? here[last - 1]
                                              : none,
                                   H,
                                   column < last ? here[column + 1]
                                   : round       ? here[1]
                                                 : none,
                                   spacing.column_m);
        const double up = slope(south != nullptr ? south[column] : none, H,
                                north != nullptr ? north[column] : none, spacing.row_m);
        const double length = std::sqrt(1 + along * along + up * up);
        out[column] = {snorm(-along / length), snorm(-up / length), snorm((H - middle) / half_range), 32767};
    }
}

/// A texture's rows are made and handed over in strips of this many, so that the copy beside the texture
/// stays small.
constexpr int kStrip = 256;

void fill_posts(const lod::Terrain& terrain, const Heights& heights, const HeightRange& range,
                GlName texture) {
    const int columns = heights.columns();
    const int rows = heights.rows();
    std::vector<Texel> strip(static_cast<std::size_t>(columns) * kStrip);
    for (int top = 0; top < rows; top += kStrip) {
        const int count = std::min(kStrip, rows - top);
        tbb::parallel_for(0, count, [&](int i) {
            fill_row(terrain, heights, range, top + i,
                     strip.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(columns));
        });
        glTextureSubImage2D(texture, 0, 0, top, columns, count, GL_RGBA, GL_SHORT, strip.data());
    }
}

void fill_cells(const Heights& heights, GlName texture) {
    const int columns = std::max(heights.columns() - 1, 1);
    const int rows = std::max(heights.rows() - 1, 1);
    std::vector<std::uint8_t> strip(static_cast<std::size_t>(columns) * kStrip);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int top = 0; top < rows; top += kStrip) {
        const int count = std::min(kStrip, rows - top);
        for (int i = 0; i < count; ++i) {
            const float* north = heights.row(top + i);
            const float* south = heights.row(std::min(top + i + 1, heights.rows() - 1));
            for (int column = 0; column < columns; ++column) {
                const int next = std::min(column + 1, heights.columns() - 1);
                const bool whole = !std::isnan(north[column]) && !std::isnan(north[next]) &&
                                   !std::isnan(south[column]) && !std::isnan(south[next]);
                strip[static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)] = whole ? 255 : 0;
            }
        }
        glTextureSubImage2D(texture, 0, 0, top, columns, count, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                            strip.data());
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace

Result<TerrainTextures> build_terrain_textures(const lod::Terrain& terrain) {
    const int columns = terrain.frame().columns;
    const int rows = terrain.frame().rows;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (columns > most || rows > most) {
        return Error{
            ErrorKind::input,
            fmt::format(
                "{} x {} posts are more than this machine's OpenGL can hold in one texture ({} a side); "
                "import a smaller part with --crop",
                columns, rows, most)};
    }
    Heights heights(columns, rows);
    lod::Raster<std::uint8_t> sea_posts(columns, rows);
    for (int r = 0; r < rows; r += 256)
        for (int c = 0; c < columns; c += 256) {
            const auto ground = terrain.pyramid()->read_ground({0, c / 256, r / 256});
            if (!ground) return ground.error();
            for (int y = 0; y < std::min(256, rows - r); ++y)
                for (int x = 0; x < std::min(256, columns - c); ++x) {
                    heights.at(c + x, r + y) = ground->heights.at(x, y);
                    sea_posts.at(c + x, r + y) = ground->is_sea.at(x, y);
                }
        }
    if (std::all_of(sea_posts.samples().begin(), sea_posts.samples().end(), [](auto v) { return v == 0; }))
        sea_posts = {};
    const HeightRange range = height_range(heights, sea_posts);
    const auto larger = static_cast<unsigned>(std::max(columns, rows));

    TerrainTextures textures;
    if (range.lowest <= range.highest) {
        textures.lowest_m = range.lowest;
        textures.highest_m = range.highest;
        textures.lowest_land_m = range.lowest_land;
    }
    textures.posts = GlTexture(create_gl_texture(GL_TEXTURE_2D));
    const GlName posts = textures.posts.name();
    glTextureStorage2D(posts, std::bit_width(larger), GL_RGBA16_SNORM, columns, rows);
    if (auto done = gl_check("making room for the terrain's normals"); !done) return done.error();
    fill_posts(terrain, heights, range, posts);
    glGenerateTextureMipmap(posts);
    glTextureParameteri(posts, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(posts, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(posts, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(posts, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

    if (!sea_posts.samples().empty()) {
        textures.sea = GlTexture(create_gl_texture(GL_TEXTURE_2D));
        const GlName sea = textures.sea.name();
        glTextureStorage2D(sea, std::bit_width(larger), GL_R8, columns, rows);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(sea, 0, 0, 0, columns, rows, GL_RED, GL_UNSIGNED_BYTE,
                            sea_posts.samples().data());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glGenerateTextureMipmap(sea);
        glTextureParameteri(sea, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTextureParameteri(sea, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTextureParameteri(sea, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(sea, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }

    if (range.has_voids) {
        textures.cells = GlTexture(create_gl_texture(GL_TEXTURE_2D));
        const GlName cells = textures.cells.name();
        glTextureStorage2D(cells, 1, GL_R8UI, std::max(columns - 1, 1), std::max(rows - 1, 1));
        glTextureParameteri(cells, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(cells, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        fill_cells(heights, cells);
    }
    if (auto done = gl_check("loading the terrain's normals"); !done) return done.error();
    return textures;
}

}  // namespace relevo::viewer
