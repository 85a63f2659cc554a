// What is draped lies on the sea, too, and lines are as wide in the picture however the ground lies.

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "ingest/vector_file.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/ground/page.hpp"

namespace relevo::test {
namespace {

using viewer::Overlay;

class RedDrape final : public viewer::Drape {
  public:
    int finer() const override { return 0; }
    Result<viewer::DrapeTexels> read(const viewer::Page&) const override {
        return viewer::DrapeTexels(static_cast<std::size_t>(viewer::kPagePosts) * viewer::kPagePosts,
                                   {255, 0, 0, 255});
    }
};

TEST(Drape, LiesOnTheSeaAndEndsWithTheData) {
    const auto frame = geographic_frame(129, 129);
    lod::Raster<std::uint8_t> sea(129, 129);
    for (int row = 0; row < 129; ++row) {
        for (int column = 0; column < 64; ++column) sea.at(column, row) = 255;
    }
    const auto heights = make_heights(frame, [](int column, int) { return column < 64 ? 0.0 : 20.0; });
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea), nullptr,
                  {std::make_shared<RedDrape>()});
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 6000, 300, 200);
    const lod::View view(camera);
    viewer::DrawSettings settings{.background = kMagenta, .overlays = {{.kind = Overlay::Kind::imagery}}};
    settings.ocean.kind = viewer::OceanKind::radial;
    const auto picture = studio.draw(camera, settings);
    int inside = 0;
    int outside = 0;
    for (int y = 2; y < picture.height - 2; ++y) {
        for (int x = 2; x < picture.width - 2; ++x) {
            const bool red = picture.at(x, y) == std::array<int, 3>{255, 0, 0};
            const auto post = frame.grid_position([&] {
                const glm::dvec3 ray = view.ray({x + 0.5, y + 0.5});
                const double down = -glm::dot(ray, geo::EnuFrame(camera.eye).up());
                const auto at = geo::to_geodetic(view.eye() + camera.eye.h.m / down * ray);
                return geo::LatLon{at.lat, at.lon};
            }());
            const double beyond = std::max({-post.column, -post.row, post.row - 128});
            if (beyond < -2 && post.column < 126) {
                EXPECT_TRUE(red) << x << " " << y;
                ++inside;
            }
            if (beyond > 2 && post.column < 60) {
                EXPECT_FALSE(red) << x << " " << y;
                ++outside;
            }
        }
    }
    EXPECT_GT(inside, 5000);
    EXPECT_GT(outside, 1000);
}

class Lines final : public viewer::Drape {
  public:
    Lines(std::shared_ptr<const ingest::VectorFile> file, int finer)
        : file_(std::move(file)), finer_(finer) {}
    int finer() const override { return finer_; }
    std::optional<std::array<std::uint8_t, 3>> line_colour() const override {
        return std::array<std::uint8_t, 3>{0, 0, 255};
    }
    Result<viewer::DrapeTexels> read(const viewer::Page& page) const override {
        const double step = std::ldexp(1.0, page.level - finer_);
        return file_->draw({page.column * viewer::kPageCells * step, page.row * viewer::kPageCells * step,
                            step, viewer::kPagePosts});
    }

  private:
    std::shared_ptr<const ingest::VectorFile> file_;
    int finer_;
};

/// How many pixels of a row are wholly of the lines' colour, and the first of them.
int blue_in_row(const viewer::Picture& picture, int y) {
    int count = 0;
    for (int x = 0; x < picture.width; ++x) {
        const auto p = picture.at(x, y);
        count += p[2] > 180 && p[0] < 90 ? 1 : 0;
    }
    return count;
}

class VectorLines : public testing::Test {
  protected:
    Studio studio_of(const std::string& geometry) {
        const std::string file = (folder_ / "lines.geojson").string();
        std::ofstream(file) << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
                            << R"("geometry":)" << geometry << "}]}";
        auto lines = ingest::VectorFile::open(file, frame_);
        if (!lines) throw std::runtime_error(lines.error().message);
        return Studio(make_terrain(frame_, make_heights(frame_, [](int, int) { return 100.0; })), nullptr,
                      {std::make_shared<Lines>(*lines, 4)});
    }

    static constexpr double kLine = 3.2;  // shaders/drape.glsl
    geo::GridFrame frame_ = geographic_frame(513, 513);
    SceneFolder folder_;
    viewer::DrawSettings settings_{.layer = viewer::Layer::hillshade,
                                   .sun = *viewer::parse_sun("0,90"),
                                   .background = kMagenta,
                                   .overlays = {{.kind = Overlay::Kind::vectors}}};
};

// Along the view and nearly level with the ground: every row that has ground has the line, as wide as the
// others.
TEST_F(VectorLines, AreAsWideFarAsNearAndHaveNoGaps) {
    const auto at = [&](double column, double row) { return frame_.lat_lon({column, row}); };
    Studio studio = studio_of(fmt::format(R"({{"type":"LineString","coordinates":[[{},{}],[{},{}]]}})",
                                          at(256, 0).lon.value, at(256, 0).lat.value, at(256, 512).lon.value,
                                          at(256, 512).lat.value));
    for (const double metres : {20.0, 300.0}) {
        auto camera = above_looking_down(studio.terrain(), 256, 500, metres, 400, 300);
        camera.pitch.value = -12;
        const auto picture = studio.draw(camera, settings_);
        const lod::View view(camera);
        int rows = 0;
        for (int y = 0; y < picture.height; ++y) {
            // To some way before the end of the data.
            const double down = -glm::dot(view.ray({200, y + 0.5}), geo::EnuFrame(camera.eye).up());
            if (!(down > 0) || metres / down > 300 * frame_.spacing({256, 256}).row_m) continue;
            // Just below the horizon a line's picture changes its width within the two pixels of a
            // derivative.
            const double down_above = -glm::dot(view.ray({200, y - 1.5}), geo::EnuFrame(camera.eye).up());
            if (!(down_above > 0.6 * down)) continue;
            ++rows;
            EXPECT_NEAR(blue_in_row(picture, y), kLine, 1.3) << "row " << y << " at " << metres;
        }
        EXPECT_GT(rows, 120);
    }
}

// Across the view: columns have it as wide as rows did.
TEST_F(VectorLines, AreAsWideAcrossTheView) {
    const auto at = [&](double column, double row) { return frame_.lat_lon({column, row}); };
    Studio studio = studio_of(fmt::format(R"({{"type":"LineString","coordinates":[[{},{}],[{},{}]]}})",
                                          at(0, 300).lon.value, at(0, 300).lat.value, at(512, 300).lon.value,
                                          at(512, 300).lat.value));
    for (const double row : {320.0, 400.0, 480.0}) {
        auto camera = above_looking_down(studio.terrain(), 256, row, 250, 400, 300);
        camera.pitch.value = -15;
        const auto picture = studio.draw(camera, settings_);
        for (int x = 60; x < 340; x += 7) {
            int count = 0;
            for (int y = 0; y < picture.height; ++y) {
                const auto p = picture.at(x, y);
                count += p[2] > 180 && p[0] < 90 ? 1 : 0;
            }
            EXPECT_NEAR(count, kLine, 1.3) << "column " << x << " from row " << row;
        }
    }
}

TEST_F(VectorLines, PointsAreDiscs) {
    const geo::LatLon place = frame_.lat_lon({256, 256});
    Studio studio = studio_of(
        fmt::format(R"({{"type":"Point","coordinates":[{},{}]}})", place.lon.value, place.lat.value));
    for (const double metres : {50.0, 3000.0}) {
        const auto picture =
            studio.draw(above_looking_down(studio.terrain(), 256, 256, metres, 200, 150), settings_);
        double sum = 0;
        double x_sum = 0;
        double y_sum = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const auto p = picture.at(x, y);
                if (!(p[2] > 180 && p[0] < 90)) continue;
                ++sum;
                x_sum += x + 0.5;
                y_sum += y + 0.5;
            }
        }
        EXPECT_NEAR(std::sqrt(sum / 3.14159265), 4.5, 0.6) << metres;
        EXPECT_NEAR(x_sum / sum, 100, 0.5) << metres;
        EXPECT_NEAR(y_sum / sum, 75, 0.5) << metres;
    }
}

}  // namespace
}  // namespace relevo::test
