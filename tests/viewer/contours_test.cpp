// Contour lines on the ground, against GDAL's of the same data: those that gdal_contour writes.

#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include "lod/measure/height_sampler.hpp"
#include "lod/soar/pick.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/read_dem.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/ground/height_code.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;
using viewer::Overlay;

/// GDAL's contours of a grid, as segments in posts.
class TrueContours {
  public:
    TrueContours(const lod::Raster<float>& heights, double interval_m) {
        GDALAllRegister();
        const int columns = heights.columns();
        const int rows = heights.rows();
        auto* driver = GetGDALDriverManager()->GetDriverByName("MEM");
        const GDALDatasetUniquePtr grid(driver->Create("", columns, rows, 1, GDT_Float32, nullptr));
        std::array<double, 6> posts{-0.5, 1, 0, -0.5, 0, 1};
        grid->SetGeoTransform(posts.data());
        auto* band = grid->GetRasterBand(1);
        band->SetNoDataValue(-32768);
        lod::Raster<float> data = heights;
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (std::isnan(data.at(c, r))) data.at(c, r) = -32768;
            }
        }
        EXPECT_EQ(band->RasterIO(GF_Write, 0, 0, columns, rows, data.row(0), columns, rows, GDT_Float32, 0, 0,
                                 nullptr),
                  CE_None);
        const GDALDatasetUniquePtr lines(
            GetGDALDriverManager()->GetDriverByName("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
        OGRLayer* layer = lines->CreateLayer("contours", nullptr, wkbLineString, nullptr);
        OGRFieldDefn field("height", OFTReal);
        layer->CreateField(&field);
        char** options = CSLSetNameValue(nullptr, "LEVEL_INTERVAL", std::to_string(interval_m).c_str());
        options = CSLSetNameValue(options, "ELEV_FIELD", "0");
        options = CSLSetNameValue(options, "NODATA", "-32768");
        EXPECT_EQ(GDALContourGenerateEx(band, layer, options, nullptr, nullptr), CE_None);
        CSLDestroy(options);
        for (const auto& feature : *layer) {
            const auto* line = feature->GetGeometryRef()->toLineString();
            for (int i = 0; i + 1 < line->getNumPoints(); ++i)
                add({line->getX(i), line->getY(i), line->getX(i + 1), line->getY(i + 1)});
        }
    }

    struct Segment {
        double x0, y0, x1, y1;
        double distance(double x, double y) const {
            const double dx = x1 - x0;
            const double dy = y1 - y0;
            const double square = dx * dx + dy * dy;
            const double t = square > 0 ? std::clamp(((x - x0) * dx + (y - y0) * dy) / square, 0.0, 1.0) : 0;
            return std::hypot(x0 + t * dx - x, y0 + t * dy - y);
        }
    };
    const std::vector<Segment>& segments() const { return all_; }

    /// In posts; 3 where none is nearer.
    double distance(double x, double y) const {
        double nearest = 3;
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        for (int r = row - 3; r <= row + 3; ++r) {
            for (int c = column - 3; c <= column + 3; ++c) {
                const auto found = by_cell_.find({c, r});
                if (found == by_cell_.end()) continue;
                for (const std::size_t i : found->second) nearest = std::min(nearest, all_[i].distance(x, y));
            }
        }
        return nearest;
    }

  private:
    void add(const Segment& segment) {
        const int column = static_cast<int>(std::floor(0.5 * (segment.x0 + segment.x1)));
        const int row = static_cast<int>(std::floor(0.5 * (segment.y0 + segment.y1)));
        by_cell_[{column, row}].push_back(all_.size());
        all_.push_back(segment);
    }
    std::vector<Segment> all_;
    std::map<std::pair<int, int>, std::vector<std::size_t>> by_cell_;
};

/// How much of each pixel is a line, from pictures with and without.
std::vector<double> line_shares(const viewer::Picture& with, const viewer::Picture& without) {
    std::vector<double> shares;
    for (int y = 0; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) {
            const auto a = without.at(x, y);
            const auto b = with.at(x, y);
            const std::array<double, 3> dark{0.30 * 255, 0.17 * 255, 0.06 * 255};
            double moved = 0;
            double whole = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                moved += std::abs(b[i] - a[i]);
                whole += std::abs(dark[i] - a[i]);
            }
            shares.push_back(moved / std::max(whole, 1.0));
        }
    }
    return shares;
}

struct Distances {
    std::vector<double> posts;
    double part(double p) {
        std::sort(posts.begin(), posts.end());
        return posts.empty() ? 0 : posts[static_cast<std::size_t>(p * static_cast<double>(posts.size() - 1))];
    }
    double mean() const {
        return std::accumulate(posts.begin(), posts.end(), 0.0) /
               static_cast<double>(std::max<std::size_t>(posts.size(), 1));
    }
};

/// Everything in view is light: lines are dark.
const viewer::DrawSettings kBright{
    .layer = Layer::hillshade, .sun = *viewer::parse_sun("0,90"), .background = kMagenta};

viewer::DrawSettings with_contours(viewer::DrawSettings settings, double interval_m) {
    settings.overlays = {{.kind = Overlay::Kind::contours, .interval_m = interval_m}};
    return settings;
}

struct Trial {
    const char* file;
    int column, row;
    double interval_m;
    double posts_a_pixel;
};

class ContoursAgainstGdal : public testing::TestWithParam<Trial> {};

TEST_P(ContoursAgainstGdal, LieWhereItsLinesAre) {
    const Trial trial = GetParam();
    RELEVO_NEEDS_DATA(trial.file);
    const Dem dem = read_dem(shared_data(trial.file), trial.column, trial.row, 385);
    const TrueContours truth(dem.heights, trial.interval_m);
    Studio studio(make_terrain(dem.frame, dem.heights));
    const double post_m = dem.frame.spacing({192, 192}).row_m;
    constexpr int kHeight = 300;
    auto camera = above_looking_down(studio.terrain(), 192, 192, 0, 400, kHeight);
    camera.fov.value = 8;
    camera.eye.h.m += trial.posts_a_pixel * post_m * kHeight / (2 * std::tan(camera.fov.radians() / 2));
    viewer::ViewState how;
    how.method = viewer::Method::full;
    const auto without = studio.draw(camera, kBright, how);
    const auto with = studio.draw(camera, with_contours(kBright, trial.interval_m), how);
    const auto shares = line_shares(with, without);

    const lod::View view(camera);
    Distances drawn;
    std::map<std::pair<int, int>, bool> has_line;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const double share = shares[static_cast<std::size_t>(y * camera.width + x)];
            if (share < 0.3) continue;
            has_line[{x, y}] = true;
            if ((x + y) % 3 != 0) continue;
            const auto hit = lod::pick_exactly(studio.terrain(), view.eye(), view.ray({x + 0.5, y + 0.5}));
            if (hit) drawn.posts.push_back(truth.distance(hit->place.column, hit->place.row));
        }
    }
    ASSERT_GT(drawn.posts.size(), 500U);

    // And the other way: places of GDAL's lines that no line was drawn at.
    int missed = 0;
    int asked = 0;
    lod::TruePosts::Reader reader(studio.terrain().posts());
    for (const auto& segment : truth.segments()) {
        const geo::GridPosition at{0.5 * (segment.x0 + segment.x1), 0.5 * (segment.y0 + segment.y1)};
        const int c = std::clamp(static_cast<int>(at.column), 0, dem.frame.columns - 2);
        const int r = std::clamp(static_cast<int>(at.row), 0, dem.frame.rows - 2);
        if (!reader.is_valid_cell(c, r)) continue;
        const lod::BilinearCell cell{c,
                                     r,
                                     static_cast<double>(reader.H(c, r)),
                                     static_cast<double>(reader.H(c + 1, r)),
                                     static_cast<double>(reader.H(c, r + 1)),
                                     static_cast<double>(reader.H(c + 1, r + 1))};
        const auto slope = cell.slope(at);
        const double apart_px = trial.interval_m /
                                std::max(std::hypot(slope.per_column, slope.per_row), 1e-9) /
                                trial.posts_a_pixel;
        if (apart_px < 8) continue;  // there they may have faded
        const glm::dvec3 offset =
            dem.frame.ecef(at, geo::EllipsoidalHeight{cell.height(at)}).m - view.eye().m;
        if (!view.sees(offset)) continue;
        const auto pixel = view.pixel(offset);
        bool near = false;
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx)
                near = near ||
                       has_line.count({static_cast<int>(pixel.x) + dx, static_cast<int>(pixel.y) + dy}) != 0;
        }
        ++asked;
        if (!near) ++missed;
    }
    fmt::print(
        "[ contours ] {} every {} m, {} posts a pixel: {} pixels, distance to gdal_contour's lines mean "
        "{:.3f} p99 {:.3f} max {:.3f} posts; {} of {} places without a line\n",
        trial.file, trial.interval_m, trial.posts_a_pixel, drawn.posts.size(), drawn.mean(), drawn.part(0.99),
        drawn.part(1), missed, asked);
    // A line is 1.2 or 2.3 pixels wide, and pixels with a third of it count.
    const double pixel = trial.posts_a_pixel;
    EXPECT_LT(drawn.mean(), 0.7 * pixel + 0.02);
    EXPECT_LT(drawn.part(0.99), 1.7 * pixel + 0.15);
    EXPECT_LT(missed, 0.01 * asked + 1);
}

INSTANTIATE_TEST_SUITE_P(Dems, ContoursAgainstGdal,
                         testing::Values(Trial{"mountains/mt_everest_90m.tif", 400, 300, 100, 0.1},
                                         Trial{"mountains/mt_everest_90m.tif", 400, 300, 200, 0.7},
                                         Trial{"mountains/mt_rainier_90m.tif", 500, 400, 50, 0.1},
                                         Trial{"mountains/mt_rainier_90m.tif", 100, 100, 20, 0.4},
                                         Trial{"coast/N48W125.hgt.zip", 1200, 2600, 20, 0.1}));

TEST(HeightCode, KeepsWholeMetresToTheLastBit) {
    for (const auto& [low, high] :
         {std::pair(-430.0, 8848.0), {0.0, 1.0}, {-11000.0, 8848.0}, {100.0, 4471.0}}) {
        const auto code = viewer::height_code({.lowest_m = low, .highest_m = high});
        for (double H = low; H <= high; H += 1) ASSERT_EQ(code.middle_m + code.step_m * code.of(H), H) << low;
        EXPECT_LE(code.step_m, std::max((high - low) / 32000, 4e-8));
    }
}

int count_lines(const viewer::Picture& with, const viewer::Picture& without) {
    int lines = 0;
    for (int y = 0; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) lines += with.at(x, y) != without.at(x, y) ? 1 : 0;
    }
    return lines;
}

// Terraces of 100 m: every plain is exactly at a line's height.
TEST(Contours, DoNotFillAPlainAtTheirHeight) {
    const auto frame = geographic_frame(257, 257);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int) {
                                   return 100.0 * (column / 32) + 12 * std::max(column % 32 - 24, 0) +
                                          (column % 32 == 31 ? 12 : 0);
                               })));
    const auto camera = above_looking_down(studio.terrain(), 128, 128, 8000);
    const auto without = studio.draw(camera, kBright);
    const auto with = studio.draw(camera, with_contours(kBright, 100));
    const int lines = count_lines(with, without);
    EXPECT_GT(lines, camera.height);          // there are some
    EXPECT_LT(lines, 8 * 4 * camera.height);  // each of a few pixels
}

TEST(Contours, FadeWhereTheyWouldCrowd) {
    const auto frame = geographic_frame(257, 257);
    const auto heights = make_heights(frame, [](int column, int) { return 100.0 * column; });
    Studio studio(make_terrain(frame, heights));
    const auto camera = above_looking_down(studio.terrain(), 128, 128, 30000);
    const auto without = studio.draw(camera, kBright);
    EXPECT_EQ(count_lines(studio.draw(camera, with_contours(kBright, 1)), without), 0);
    EXPECT_GT(count_lines(studio.draw(camera, with_contours(kBright, 1000)), without), camera.height);
}

TEST(Contours, AreNotOnWaterNorWithOpacityZero) {
    const auto frame = geographic_frame(129, 129);
    lod::Raster<std::uint8_t> sea(129, 129);
    for (int row = 0; row < 129; ++row) {
        for (int column = 0; column < 64; ++column) sea.at(column, row) = 255;
    }
    const auto heights = make_heights(frame, [](int column, int) { return 20.0 * (column - 63.5); });
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea));
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 4000);
    for (const Layer layer : {Layer::hypsometric, Layer::hillshade, Layer::terrain}) {
        viewer::DrawSettings settings{
            .layer = layer, .sun = *viewer::parse_sun("0,60"), .background = kMagenta};
        const auto without = studio.draw(camera, settings);
        const auto with = studio.draw(camera, with_contours(settings, 100));
        int west = 0;
        int east = 0;
        for (int y = 0; y < with.height; ++y) {
            for (int x = 0; x < with.width; ++x) {
                if (with.at(x, y) != without.at(x, y)) ++(x < with.width / 2 - 3 ? west : east);
            }
        }
        EXPECT_EQ(west, 0) << to_string(layer);
        EXPECT_GT(east, camera.height) << to_string(layer);
        settings = with_contours(settings, 100);
        settings.overlays[0].opacity = 0;
        EXPECT_EQ(studio.draw(camera, settings).rgb, without.rgb);
    }
}

TEST(Contours, ChooseAnIntervalThatSuitsTheView) {
    EXPECT_EQ(viewer::contour_interval(1), 10);
    EXPECT_EQ(viewer::contour_interval(5), 50);
    EXPECT_EQ(viewer::contour_interval(0.1), 1);
    EXPECT_DOUBLE_EQ(viewer::contour_interval(0.05), 0.5);
    const auto frame = geographic_frame(257, 257);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    double last = 0;
    for (const double metres : {100.0, 1000.0, 10e3, 100e3}) {
        studio.draw(above_looking_down(studio.terrain(), 128, 128, metres), with_contours(kBright, 0));
        ASSERT_TRUE(studio.renderer().contour_interval_m());
        EXPECT_GT(*studio.renderer().contour_interval_m(), last);
        last = *studio.renderer().contour_interval_m();
    }
    EXPECT_NEAR(std::log10(last), std::log10(6 * 100e3 / 206), 0.4);
}

TEST(Aspect, IsWhereTheGroundFalls) {
    const auto frame = geographic_frame(129, 129, 0.02);  // where columns are as wide as rows
    const double step = frame.spacing({64, 64}).row_m;
    const auto ramp = viewer::colour_ramp(Layer::aspect);
    for (int degrees = 0; degrees < 360; degrees += 15) {
        const double a = degrees * 3.14159265358979 / 180;
        Studio studio(make_terrain(frame, make_heights(frame, [&](int column, int row) {
                                       return 5000 - 0.3 * step * (column * std::sin(a) - row * std::cos(a));
                                   })));
        const auto picture = studio.draw(above_looking_down(studio.terrain(), 64, 64, 1000),
                                         {.layer = Layer::aspect, .background = kMagenta});
        const auto expected =
            ramp[static_cast<std::size_t>(degrees / 360.0 * static_cast<double>(ramp.size() - 1))];
        const auto pixel = picture.at(picture.width / 2, picture.height / 2);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(pixel[i], expected[i], 3) << degrees << " channel " << i;
    }
    Studio flat(make_terrain(frame, make_heights(frame, [](int, int) { return 5.0; })));
    const auto grey = flat.draw(above_looking_down(flat.terrain(), 64, 64, 1000),
                                {.layer = Layer::aspect, .background = kMagenta});
    EXPECT_EQ(grey.at(100, 75), (std::array<int, 3>{204, 204, 204}));
}

}  // namespace
}  // namespace relevo::test
