// --imagery and --vectors as people use them: files, pictures, and where things are in them.

#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <ogr_spatialref.h>

#include "lod/view.hpp"
#include "tests/app/run_program.hpp"
#include "tests/viewer/scene_for_pictures.hpp"

namespace relevo::test {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kEyeM = 3000;

class ImageryCommand : public testing::Test {
  protected:
    ImageryCommand() : scene_((folder_ / "flat.relevo").string()), image_((folder_ / "spots.tif").string()) {
        GDALAllRegister();
        write_flat();
    }

    /// At H = 0, above the ellipsoid.
    void write_flat() const {
        SceneParts parts;
        const auto frame = geographic_frame(129, 129);
        parts.heights = make_heights(frame, [](int, int) { return 0.0; });
        parts.metrics = lod::build_metrics(frame, {}, parts.heights);
        parts.info.frame = frame;
        parts.info.vertical = {lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
        parts.info.valid_posts = parts.heights.samples().size();
        parts.info.resampling_method = "none";
        const auto written = write_scene(parts, scene_);
        ASSERT_TRUE(written) << written.error().message;
    }

    /// Where the eye is: over a place that is no post.
    geo::LatLon middle() const { return lod::Scene::open(scene_)->info().frame.lat_lon({63.3, 64.8}); }

    lod::View view() const {
        return lod::View({.eye = {middle().lat, middle().lon, {kEyeM}},
                          .heading = geo::Degrees{0},
                          .pitch = geo::Degrees{-90},
                          .roll = geo::Degrees{0},
                          .fov = geo::Degrees{40},
                          .width = kWidth,
                          .height = kHeight});
    }

    auto render(const std::string& flags) const {
        return relevo(
            fmt::format("render {} -o {} --size {}x{} --samples 1 --layer lod --background 0,0,0 --eye "
                        "{:.12f},{:.12f},{} --pitch -90 --fov 40 --json {}",
                        scene_, (folder_ / "a.png").string(), kWidth, kHeight, middle().lat.value,
                        middle().lon.value, kEyeM, flags));
    }

    /// A band of the picture.
    std::vector<int> band(int number) const {
        const GDALDatasetUniquePtr file(GDALDataset::Open((folder_ / "a.png").c_str()));
        std::vector<int> pixels(kWidth * kHeight);
        EXPECT_EQ(file->GetRasterBand(number)->RasterIO(GF_Read, 0, 0, kWidth, kHeight, pixels.data(), kWidth,
                                                        kHeight, GDT_Int32, 0, 0, nullptr),
                  CE_None);
        return pixels;
    }

    struct Spot {
        double x, y;  // in pixels of the image
        geo::LatLon place;
    };

    /// A picture of a CRS around the middle, pixels of `metres` on the ground: bright spots on black. Their
    /// places by PROJ.
    std::vector<Spot> write_spots(const char* crs, double metres, double scale, bool palette = false) const {
        OGRSpatialReference degrees;
        degrees.importFromEPSG(4326);
        degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        OGRSpatialReference to;
        to.SetFromUserInput(crs);
        to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        const std::unique_ptr<OGRCoordinateTransformation> forward(
            OGRCreateCoordinateTransformation(&degrees, &to));
        const std::unique_ptr<OGRCoordinateTransformation> back(
            OGRCreateCoordinateTransformation(&to, &degrees));
        double x = middle().lon.value;
        double y = middle().lat.value;
        EXPECT_TRUE(forward->Transform(1, &x, &y));
        constexpr int kSide = 300;
        const double step = metres * scale;
        std::array<double, 6> place{
            x - 0.5 * kSide * step + 0.3 * step, step, 0, y + 0.5 * kSide * step, 0, -step};
        std::vector<Spot> spots;
        std::vector<std::uint8_t> pixels(std::size_t{kSide} * kSide);
        for (int i = 0; i < 4; ++i) {
            for (int k = 0; k < 4; ++k) {
                Spot spot{90.0 + 40 * i + 0.37 * k, 95.0 + 37 * k + 0.21 * i, {}};
                double lon = place[0] + spot.x * place[1];
                double lat = place[3] + spot.y * place[5];
                EXPECT_TRUE(back->Transform(1, &lon, &lat));
                spot.place = {geo::Degrees{lat}, geo::Degrees{lon}};
                spots.push_back(spot);
                for (int r = -8; r <= 8; ++r) {
                    for (int c = -8; c <= 8; ++c) {
                        const double dx = std::floor(spot.x) + c + 0.5 - spot.x;
                        const double dy = std::floor(spot.y) + r + 0.5 - spot.y;
                        const auto at = static_cast<std::size_t>((std::floor(spot.y) + r) * kSide +
                                                                 std::floor(spot.x) + c);
                        pixels[at] =
                            static_cast<std::uint8_t>(std::lround(250 * std::exp(-(dx * dx + dy * dy) / 8)));
                    }
                }
            }
        }
        auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        const GDALDatasetUniquePtr made(driver->Create(image_.c_str(), kSide, kSide, 1, GDT_Byte, nullptr));
        made->SetGeoTransform(place.data());
        made->SetSpatialRef(&to);
        if (palette) {
            GDALColorTable colours;
            for (int i = 0; i < 256; ++i) {
                const GDALColorEntry entry{static_cast<short>(i), static_cast<short>(i), 0, 255};
                colours.SetColorEntry(i, &entry);
            }
            made->GetRasterBand(1)->SetColorTable(&colours);
        }
        EXPECT_EQ(made->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, kSide, kSide, pixels.data(), kSide, kSide,
                                                   GDT_Byte, 0, 0, nullptr),
                  CE_None);
        return spots;
    }

    SceneFolder folder_;
    std::string scene_, image_;
};

TEST_F(ImageryCommand, LiesWhereItsPlacesAre) {
    struct Trial {
        const char* crs;
        double metres, scale;
    };
    // In web Mercator a metre of the ground is 1 / cos(latitude).
    for (const Trial& trial : {Trial{"EPSG:32654", 5, 1}, Trial{"EPSG:3857", 5, 1 / std::cos(0.6277)},
                               Trial{"EPSG:4326", 5, 1 / 111000.0}, Trial{"EPSG:32654", 2, 1}}) {
        const auto spots = write_spots(trial.crs, trial.metres, trial.scale);
        const auto run = render("--imagery " + image_);
        ASSERT_EQ(run.status, 0) << run.err;
        const auto grey = band(1);
        const lod::View camera = view();
        const double image_px = trial.metres / (kEyeM / camera.focal_px());
        double worst = 0;
        int found = 0;
        for (const Spot& spot : spots) {
            const geo::GridFrame frame = lod::Scene::open(scene_)->info().frame;
            const auto wanted = camera.pixel(
                frame.ecef(frame.grid_position(spot.place), geo::EllipsoidalHeight{0}).m - camera.eye().m);
            const int reach = static_cast<int>(std::ceil(7 * image_px));
            if (wanted.x < reach + 1 || wanted.y < reach + 1 || wanted.x > kWidth - reach - 1 ||
                wanted.y > kHeight - reach - 1)
                continue;
            double sum = 0;
            double x = 0;
            double y = 0;
            for (int r = -reach; r <= reach; ++r) {
                for (int c = -reach; c <= reach; ++c) {
                    const int px = static_cast<int>(wanted.x) + c;
                    const int py = static_cast<int>(wanted.y) + r;
                    const double bright = grey[static_cast<std::size_t>(py * kWidth + px)];
                    sum += bright;
                    x += bright * (px + 0.5);
                    y += bright * (py + 0.5);
                }
            }
            ASSERT_GT(sum, 500) << trial.crs;
            worst = std::max(worst, std::hypot(x / sum - wanted.x, y / sum - wanted.y));
            ++found;
        }
        fmt::print(
            "[ imagery ] {} pixels of {} m: {} control points, at most {:.3f} pixels of the image off\n",
            trial.crs, trial.metres, found, worst / image_px);
        EXPECT_GE(found, 9);
        EXPECT_LT(worst / image_px, 0.5);
    }
}

TEST_F(ImageryCommand, IsTransparentWhereThereIsNoneAndByOpacity) {
    write_spots("EPSG:32654", 2, 1, true);
    ASSERT_EQ(render("").status, 0);
    const auto without = band(3);
    const auto red_without = band(1);
    auto run = render("--imagery " + image_);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    ASSERT_EQ(json["overlays"].size(), 1U);
    EXPECT_EQ(json["overlays"][0]["overlay"], "imagery:0:1");
    EXPECT_GT(json["overlays"][0]["tiles"], 0);
    EXPECT_GT(json["overlays"][0]["gl_objects"], 0);
    EXPECT_GT(json["overlays"][0]["bytes"], 0);
    const auto blue = band(3);
    EXPECT_EQ(blue[0], without[0]);  // beyond its edge
    EXPECT_EQ(blue[kWidth * kHeight / 2 + kWidth / 2], 0);
    run = render("--imagery " + image_ + ",0.5");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto half = band(3);
    const std::size_t at = kWidth * (kHeight / 2) + kWidth / 2;
    EXPECT_NEAR(half[at], 0.5 * without[at], 2);
    // Off: nothing was made of it.
    run = render("");
    EXPECT_TRUE(nlohmann::json::parse(run.out)["overlays"].empty());
    run = render("--imagery " + image_ + ",0");
    EXPECT_EQ(band(1), red_without);
}

TEST_F(ImageryCommand, SaysWhatIsWrongWithAFile) {
    const auto wrong = [&](const std::string& flags, const std::string& text) {
        const auto run = render(flags);
        EXPECT_EQ(run.status, 3) << run.err;
        EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
    };
    auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    { const GDALDatasetUniquePtr bare(driver->Create(image_.c_str(), 8, 8, 3, GDT_Byte, nullptr)); }
    wrong("--imagery " + image_, "--imagery: spots.tif: it has no georeference");
    {
        const GDALDatasetUniquePtr far(driver->Create(image_.c_str(), 8, 8, 3, GDT_Byte, nullptr));
        std::array<double, 6> place{10, 0.1, 0, 50, 0, -0.1};
        far->SetGeoTransform(place.data());
        OGRSpatialReference crs;
        crs.importFromEPSG(4326);
        far->SetSpatialRef(&crs);
    }
    wrong("--imagery " + image_, "nothing of it is in the scene");
    { const GDALDatasetUniquePtr deep(driver->Create(image_.c_str(), 8, 8, 1, GDT_UInt16, nullptr)); }
    wrong("--imagery " + image_, "its band 1 is UInt16");
    wrong("--imagery /no/such.tif", "--imagery");
    wrong("--vectors /no/such.gpx", "--vectors");
    EXPECT_EQ(render("--imagery " + image_ + ",2").status, 2);
}

TEST_F(ImageryCommand, DrawsTracksAndWaypointsWhereTheyAre) {
    const geo::GridFrame frame = lod::Scene::open(scene_)->info().frame;
    const auto a = frame.lat_lon({30.2, 40.7});
    const auto b = frame.lat_lon({95.6, 80.1});
    const auto point = frame.lat_lon({70.5, 40.25});
    const std::string gpx = (folder_ / "walk.gpx").string();
    std::ofstream(gpx) << fmt::format(
        "<?xml version=\"1.0\"?><gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\"><wpt "
        "lat=\"{}\" "
        "lon=\"{}\"/><trk><trkseg><trkpt lat=\"{}\" lon=\"{}\"/><trkpt lat=\"{}\" "
        "lon=\"{}\"/></trkseg></trk></gpx>",
        point.lat.value, point.lon.value, a.lat.value, a.lon.value, b.lat.value, b.lon.value);
    const auto run = render("--vectors " + gpx);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto red = band(1);
    const auto green = band(2);
    const lod::View camera = view();
    const auto pixel = [&](geo::LatLon place) {
        return camera.pixel(frame.ecef(frame.grid_position(place), geo::EllipsoidalHeight{0}).m -
                            camera.eye().m);
    };
    const glm::dvec2 from = pixel(a);
    const glm::dvec2 to = pixel(b);
    const glm::dvec2 spot = pixel(point);
    const glm::dvec2 along = glm::normalize(to - from);
    const auto is_drawn = [&](std::size_t i) { return red[i] > 150 && green[i] < 120; };
    int drawn = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
            if (!is_drawn(i)) continue;
            ++drawn;
            const glm::dvec2 p(x + 0.5, y + 0.5);
            const double t = glm::clamp(glm::dot(p - from, along), 0.0, glm::distance(from, to));
            const double off = std::min(glm::distance(p, from + t * along), glm::distance(p, spot) - 7);
            EXPECT_LT(off, 3.5) << x << " " << y;
        }
    }
    EXPECT_GT(drawn, glm::distance(from, to));
    // All along it, and in the middle of the disc.
    const auto is_drawn_near = [&](const glm::dvec2& p) {
        for (int k = 0; k < 9; ++k) {
            const int x = std::clamp(static_cast<int>(p.x) + k % 3 - 1, 0, kWidth - 1);
            const int y = std::clamp(static_cast<int>(p.y) + k / 3 - 1, 0, kHeight - 1);
            if (is_drawn(static_cast<std::size_t>(y * kWidth + x))) return true;
        }
        return false;
    };
    for (double t = 5; t < glm::distance(from, to) - 5; t += 3) {
        const glm::dvec2 p = from + t * along;
        if (p.x < 0 || p.y < 0 || p.x >= kWidth || p.y >= kHeight) continue;
        EXPECT_TRUE(is_drawn_near(p)) << t;
    }
    EXPECT_TRUE(is_drawn_near(spot));
}

}  // namespace
}  // namespace relevo::test
