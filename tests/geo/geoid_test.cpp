#include "geo/geoid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <proj.h>

#include "tests/geo/outside_program.hpp"

namespace relevo::geo {
namespace {

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

/// The nodes of EGM96 15', read by the test itself: row by row from the south pole, columns from longitude 0.
class Nodes {
  public:
    static constexpr int kColumns = 1440;
    static constexpr int kRows = 721;

    static std::optional<Nodes> read() {
        std::ifstream in(proj_grid_info("egm96_15.gtx").filename, std::ios::binary);
        const std::vector<char> bytes(std::istreambuf_iterator<char>(in), {});
        if (bytes.size() != 40 + 4 * static_cast<std::size_t>(kColumns) * kRows) return {};
        Nodes nodes;
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                // The file begins at longitude -180.
                const int stored = row * kColumns + (column + kColumns / 2) % kColumns;
                std::uint32_t bits = 0;
                for (int i = 0; i < 4; ++i)
                    bits = bits << 8 |
                           static_cast<unsigned char>(bytes[static_cast<std::size_t>(40 + 4 * stored + i)]);
                nodes.values_.push_back(static_cast<double>(std::bit_cast<float>(bits)));
            }
        }
        return nodes;
    }

    /// A node, also beyond the poles, where the opposite meridian goes on.
    double operator()(int row, int column) const {
        row = ((row % 1440) + 1440) % 1440;
        if (row >= kRows) {
            row = 1440 - row;
            column += kColumns / 2;
        }
        column = ((column % kColumns) + kColumns) % kColumns;
        return values_[static_cast<std::size_t>(row * kColumns + column)];
    }

    /// The truth between nodes: EGM96 ends at degree 360, and on the circles of latitude and of longitude
    /// (both 1440 nodes long) that is half of what the nodes can carry, so that the trigonometric polynomial
    /// through the nodes *is* the model. x, y in steps from longitude 0 and from the south pole.
    double trigonometric(double x, double y) const {
        const auto along = kernel(x);
        const auto up = kernel(y);
        double sum = 0;
        for (int row = 0; row < 1440; ++row) {
            double line = 0;
            for (int column = 0; column < kColumns; ++column)
                line += along[static_cast<std::size_t>(column)] * (*this)(row, column);
            sum += up[static_cast<std::size_t>(row)] * line;
        }
        return sum;
    }

    double linear(double x, double y) const {
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        const double u = x - column;
        const double v = y - row;
        const auto line = [&](int r) { return (1 - u) * (*this)(r, column) + u * (*this)(r, column + 1); };
        return (1 - v) * line(row) + v * line(row + 1);
    }

  private:
    static std::vector<double> kernel(double place) {
        std::vector<double> weights;
        for (int j = 0; j < 1440; ++j) {
            const double d = std::remainder(place - j, 1440);
            weights.push_back(
                d == 0 ? 1 : std::sin(std::numbers::pi * d) / (1440 * std::tan(std::numbers::pi * d / 1440)));
        }
        return weights;
    }

    std::vector<double> values_;
};

class Egm96 : public testing::Test {
  protected:
    void SetUp() override {
        nodes = Nodes::read();
        if (!nodes) GTEST_SKIP() << "PROJ's egm96_15.gtx is not installed (package proj-data)";
        auto read = Geoid::egm96();
        ASSERT_TRUE(read) << read.error().message;
        geoid = *std::move(read);
    }
    double N(double lat, double lon) const { return geoid->undulation(at(lat, lon)).m; }

    std::optional<Nodes> nodes;
    std::optional<Geoid> geoid;
};

TEST_F(Egm96, IsTheNodeAtEveryNode) {
    double worst = 0;
    for (int row = 0; row < Nodes::kRows; ++row)
        for (int column = 0; column < Nodes::kColumns; column += 3)
            worst = std::max(worst, std::abs(N(-90 + 0.25 * row, 0.25 * column) - (*nodes)(row, column)));
    EXPECT_LT(worst, 1e-12);
}

TEST_F(Egm96, EqualsCs2csAtNodes) {
    std::vector<std::array<double, 2>> places{{90, 0},   {-90, 0},      {0, 180},
                                              {0, -180}, {27.25, 92.5}, {-16.5, 179.75}};
    std::mt19937_64 random(2);
    for (int i = 0; i < 200; ++i)
        places.push_back({-90 + 0.25 * static_cast<double>(random() % 721),
                          -180 + 0.25 * static_cast<double>(random() % 1440)});
    std::vector<std::string> input;
    for (const auto& p : places) input.push_back(fmt::format("{} {} 0", p[0], p[1]));
    const auto answers = test::ask("cs2cs -f %.6f EPSG:4326+5773 EPSG:4979", input);
    if (answers.size() != input.size()) GTEST_SKIP() << "cs2cs is not installed (package proj-bin)";
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto answer = test::numbers(answers[i]);
        ASSERT_EQ(answer.size(), 3U) << answers[i];
        EXPECT_NEAR(N(places[i][0], places[i][1]), answer[2], 1e-6) << input[i];
    }
}

TEST_F(Egm96, IsWithin3CentimetresOfTheModelBetweenNodes) {
    // The largest error of the whole earth's cell middles is 0.0265 m, here; then anywhere, the poles too.
    // GeographicLib measures 1.152 m for bilinear interpolation and 0.169 m for its cubic one.
    std::vector<std::array<double, 2>> places{{27.375, 92.625}, {28.375, 343.3125}, {4.75, 285.375},
                                              {89.9, 33},       {-89.9, 300},       {89.999, 180.1}};
    std::mt19937_64 random(96);
    std::uniform_real_distribution<double> sine(-1, 1);
    std::uniform_real_distribution<double> lon(0, 360);
    for (int i = 0; i < 150; ++i)
        places.push_back({std::asin(sine(random)) * 180 / std::numbers::pi, lon(random)});
    double spline_max = 0;
    double spline_sum = 0;
    double linear_sum = 0;
    for (const auto& [lat, east] : places) {
        const double x = east * 4;
        const double y = (lat + 90) * 4;
        const double truth = nodes->trigonometric(x, y);
        const double spline_error = N(lat, east) - truth;
        const double linear_error = nodes->linear(x, y) - truth;
        spline_max = std::max(spline_max, std::abs(spline_error));
        spline_sum += spline_error * spline_error;
        linear_sum += linear_error * linear_error;
    }
    EXPECT_LT(spline_max, 0.03);
    const auto count = static_cast<double>(places.size());
    EXPECT_LT(std::sqrt(spline_sum / count), 0.004);
    EXPECT_GT(std::sqrt(linear_sum / spline_sum), 10);  // so much better than linear
    RecordProperty("spline_rms_m", std::to_string(std::sqrt(spline_sum / count)));
    RecordProperty("linear_rms_m", std::to_string(std::sqrt(linear_sum / count)));
}

TEST_F(Egm96, OracleFindsThePublishedErrorOfLinearInterpolation) {
    // GeographicLib's documentation: at most 1.152 m for EGM96 15'. Found at Hawaii, so the oracle is the
    // model.
    EXPECT_NEAR(std::abs(nodes->linear(817.5, 438.5) - nodes->trigonometric(817.5, 438.5)), 1.152, 0.001);
}

TEST_F(Egm96, IsSmoothAcrossGreenwichAndTheAntimeridian) {
    constexpr double kStep = 1e-4;
    for (const double lat : {-89.9, -45.1, 0.0, 33.33, 89.9}) {
        for (const double seam : {0.0, 180.0, 360.0, -180.0, 7.25}) {
            EXPECT_NEAR(N(lat, seam - 1e-12), N(lat, seam + 1e-12), 1e-10);
            // One-sided slopes agree as well as second derivatives (under 10 m per square degree) let them.
            const double before = (N(lat, seam) - N(lat, seam - kStep)) / kStep;
            const double after = (N(lat, seam + kStep) - N(lat, seam)) / kStep;
            EXPECT_NEAR(before, after, 100 * kStep);
        }
        EXPECT_EQ(N(lat, 10), N(lat, 370));
        EXPECT_EQ(N(lat, -180), N(lat, 180));
    }
    EXPECT_TRUE(std::isfinite(N(10, -1e-300)));
    EXPECT_TRUE(std::isfinite(N(10, std::nextafter(360, 0))));
    EXPECT_TRUE(std::isfinite(N(10, std::nextafter(180, 0))));
}

TEST_F(Egm96, IsSmoothOverThePoles) {
    constexpr double kStep = 1e-4;
    for (const double pole : {-90.0, 90.0}) {
        const double inward = pole > 0 ? -1 : 1;
        const double there = N(pole, 0);
        for (double lon = 0; lon < 360; lon += 17.3) {
            EXPECT_NEAR(N(pole, lon), there, 1e-12);
            EXPECT_NEAR(N(pole + inward * 1e-9, lon), there, 2e-9);
            // Over the pole: the slope on this meridian is the opposite of the slope on the other side.
            const double here = (N(pole + inward * kStep, lon) - there) / kStep;
            const double opposite = (N(pole + inward * kStep, lon + 180) - there) / kStep;
            EXPECT_NEAR(here, -opposite, 100 * kStep);
        }
    }
}

// --- Files

struct Gtx {
    double south = -90, west = -180, step_lat = 30, step_lon = 30;
    std::int32_t rows = 7, columns = 12;
    float value(int row, int column) const {
        if (row == 0 || row == rows - 1) return 5;
        return static_cast<float>(10 + row + column % 12);
    }

    std::vector<char> bytes() const {
        std::vector<char> out;
        const auto put = [&](auto bits) {
            for (std::size_t i = sizeof(bits); i-- > 0;) out.push_back(static_cast<char>(bits >> (8 * i)));
        };
        for (const double number : {south, west, step_lat, step_lon})
            put(std::bit_cast<std::uint64_t>(number));
        put(static_cast<std::uint32_t>(rows));
        put(static_cast<std::uint32_t>(columns));
        for (int row = 0; row < std::min(rows, 1000); ++row)
            for (int column = 0; column < std::min(columns, 1000); ++column)
                put(std::bit_cast<std::uint32_t>(value(row, column)));
        return out;
    }
};

class GtxFile : public testing::Test {
  protected:
    Result<Geoid> read(const std::vector<char>& bytes) {
        const auto file = scratch / "grid.gtx";
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return Geoid::from_gtx(file);
    }
    test::ScratchFolder scratch{"gtx"};
};

TEST_F(GtxFile, WithAndWithoutClosingColumnIsTheSame) {
    Gtx closed;
    closed.columns = 13;
    const auto a = read(Gtx{}.bytes());
    const auto b = read(closed.bytes());
    ASSERT_TRUE(a) << a.error().message;
    ASSERT_TRUE(b) << b.error().message;
    for (double lat = -90; lat <= 90; lat += 7.5)
        for (double lon = -180; lon <= 360; lon += 11)
            EXPECT_EQ(a->undulation(at(lat, lon)), b->undulation(at(lat, lon)));
    EXPECT_NEAR(a->undulation(at(0, -180)).m, 13, 1e-12);
    EXPECT_NEAR(a->undulation(at(30, -150)).m, 15, 1e-12);
}

TEST_F(GtxFile, EveryTruncationIsRefused) {
    const std::vector<char> whole = Gtx{}.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto geoid = read({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
        ASSERT_FALSE(geoid) << size;
        EXPECT_EQ(geoid.error().kind, ErrorKind::input);
        EXPECT_NE(geoid.error().message.find("grid.gtx"), std::string::npos);
    }
    std::vector<char> longer = whole;
    longer.push_back(0);
    EXPECT_FALSE(read(longer));
}

TEST_F(GtxFile, OddHeadersAreRefused) {
    const auto refused = [&](auto change) {
        Gtx gtx;
        change(gtx);
        return !read(gtx.bytes());
    };
    EXPECT_TRUE(refused([](Gtx& g) { g.rows = -7; }));
    EXPECT_TRUE(refused([](Gtx& g) { g.columns = 0; }));
    EXPECT_TRUE(refused([](Gtx& g) { g.rows = 0x7fffffff; }));
    EXPECT_TRUE(refused([](Gtx& g) {
        g.columns = 0x7ffffffe;
        g.rows = 0x7ffffffe;
    }));
    EXPECT_TRUE(refused([](Gtx& g) { g.south = -60; }));  // up to 120 degrees north
    EXPECT_TRUE(refused([](Gtx& g) { g.step_lon = -30; }));
    EXPECT_TRUE(refused([](Gtx& g) { g.step_lat = std::nan(""); }));
    EXPECT_TRUE(refused([](Gtx& g) { g.west = std::numeric_limits<double>::infinity(); }));
    EXPECT_TRUE(refused([](Gtx& g) {
        g.columns = 9;
        g.step_lon = 40;
    }));  // no opposite meridians
    EXPECT_FALSE(refused([](Gtx&) {}));
}

TEST_F(GtxFile, BadValuesAreRefused) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -88.8888F, -32768.0F, 1e30F}) {
        std::vector<char> bytes = Gtx{}.bytes();
        const auto bits = std::bit_cast<std::uint32_t>(bad);
        for (std::size_t i = 0; i < 4; ++i) bytes[40 + 4 * 30 + i] = static_cast<char>(bits >> (8 * (3 - i)));
        EXPECT_FALSE(read(bytes)) << bad;
    }
    std::vector<char> two_poles = Gtx{}.bytes();
    two_poles[40 + 4 * 3 + 1] = 0;
    EXPECT_FALSE(read(two_poles));
}

TEST_F(GtxFile, MissingFileIsAnError) {
    const auto geoid = Geoid::from_gtx(scratch / "nothing.gtx");
    ASSERT_FALSE(geoid);
    EXPECT_NE(geoid.error().message.find("nothing.gtx"), std::string::npos);
    EXPECT_FALSE(Geoid::from_gtx(scratch / ""));  // a folder
}

TEST_F(GtxFile, ARegionIsRead) {
    Gtx region;
    region.south = 40;
    region.west = 350;
    region.step_lat = region.step_lon = 0.5;
    region.rows = 9;
    region.columns = 41;
    const auto geoid = read(region.bytes());
    ASSERT_TRUE(geoid) << geoid.error().message;
    EXPECT_NEAR(geoid->undulation(at(41.5, -7)).m, region.value(3, 6), 1e-12);
    EXPECT_NEAR(geoid->undulation(at(41.5, 353)).m, region.value(3, 6), 1e-12);
    EXPECT_NEAR(geoid->undulation(at(44, 10)).m, region.value(8, 40), 1e-12);
    EXPECT_TRUE(geoid->covers(at(40, -10)));
    EXPECT_TRUE(geoid->covers(at(44, 10)));
    EXPECT_TRUE(geoid->covers(at(42, 0)));
    EXPECT_FALSE(geoid->covers(at(39.99, 0)));
    EXPECT_FALSE(geoid->covers(at(44.01, 0)));
    EXPECT_FALSE(geoid->covers(at(42, 10.01)));
    EXPECT_FALSE(geoid->covers(at(42, -10.01)));
    EXPECT_FALSE(geoid->covers(at(42, 180)));
    // Beyond its border it goes on without a step.
    EXPECT_EQ(geoid->undulation(at(42, 10.3)), geoid->undulation(at(42, 10)));
    EXPECT_EQ(geoid->undulation(at(60, -12)), geoid->undulation(at(44, -10)));
}

// --- Regions

GeoidNodes region(double south, double west, double step, int rows, int columns, auto value) {
    GeoidNodes nodes{south, west, step, step, rows, columns, {}};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            nodes.undulations.push_back(value(south + row * step, west + column * step));
    return nodes;
}

TEST(RegionalGeoid, GivesACubicPolynomialBackUpToItsBorder) {
    const auto f = [](double lat, double lon) {
        const double u = lat - 47;
        const double v = lon - 11;
        return 40 + u - 2 * v + u * v - 0.3 * u * u * v + 0.2 * v * v * v - 0.1 * u * u * u * v * v;
    };
    for (const int count : {4, 5, 6, 7, 20}) {
        const double step = 2.0 / (count - 1);
        const auto geoid = Geoid::from_nodes(region(46, 10, step, count, count, f), "polynomial");
        ASSERT_TRUE(geoid) << geoid.error().message;
        for (double lat = 46; lat <= 48; lat += 0.0625)
            for (double lon = 10; lon <= 12; lon += 0.0625)
                ASSERT_NEAR(geoid->undulation(at(lat, lon)).m, f(lat, lon), 1e-12) << count;
    }
}

TEST_F(Egm96, ACutOfItIsTheSame) {
    // Far from the border the spline of a cut is the whole earth's; one cell from it the border is felt.
    const auto node = [&](double lat, double lon) {
        return (*nodes)(static_cast<int>(std::lround((lat + 90) * 4)),
                        static_cast<int>(std::lround(lon * 4)));
    };
    const auto cut = Geoid::from_nodes(region(20, 80, 0.25, 81, 121, node), "cut");
    ASSERT_TRUE(cut);
    double inside = 0;
    double near = 0;
    for (double lat = 20; lat <= 40; lat += 0.0625)
        for (double lon = 80; lon <= 110; lon += 0.0625) {
            const double off = std::abs(cut->undulation(at(lat, lon)).m - N(lat, lon));
            near = std::max(near, off);
            if (std::min({lat - 20, 40 - lat, lon - 80, 110 - lon}) >= 3) inside = std::max(inside, off);
        }
    EXPECT_LT(inside, 1e-6);
    EXPECT_LT(near, 0.1);  // in the outermost cells
}

TEST_F(Egm96, ABandRoundTheEarthHasNoSeam) {
    const auto node = [&](double lat, double lon) {
        return (*nodes)(static_cast<int>(std::lround((lat + 90) * 4)),
                        static_cast<int>(std::lround(lon * 4)));
    };
    for (const int columns : {1440, 1441}) {
        const auto band = Geoid::from_nodes(region(-20, -180, 0.25, 161, columns, node), "band");
        ASSERT_TRUE(band);
        for (const double lon : {-180.0, 180.0, 179.9, -179.9, 0.1, 359.99, -33.3}) {
            EXPECT_NEAR(band->undulation(at(3.3, lon)).m, N(3.3, lon), 1e-6) << lon;
            EXPECT_TRUE(band->covers(at(3.3, lon)));
        }
        EXPECT_FALSE(band->covers(at(20.1, 0)));
    }
}

// What a scene keeps of a geoid.
TEST_F(Egm96, ItsNodesAroundAnAreaMakeTheSameGeoidThere) {
    const std::vector<GridFrame::Extent> areas{
        {86, 27, 88, 29},     {179.5, -17, 181.5, -15}, {-180.2, 60, -179.8, 60.3},
        {10, 84.9, 40, 85.1}, {-180, -90, 180, 90},     {-180, 75, 180, 90},
        {100, -90, 130, -80}, {0.01, 0.01, 0.02, 0.02}, {-180, -30, 180.5, -20},
        {-180, 40, 145, 41},
    };
    std::mt19937 random(3);
    for (const auto& area : areas) {
        const GeoidNodes around = geoid->nodes_around(area);
        SCOPED_TRACE(testing::Message()
                     << area.west << ' ' << area.south << ": " << around.columns << " x " << around.rows);
        const auto cut = Geoid::from_nodes(around, "cut");
        ASSERT_TRUE(cut) << cut.error().message;
        std::uniform_real_distribution<double> lat(area.south, area.north);
        std::uniform_real_distribution<double> lon(area.west, area.east);
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const LatLon place = at(lat(random), lon(random));
            ASSERT_TRUE(cut->covers(place));
            worst = std::max(worst, std::abs(cut->undulation(place).m - geoid->undulation(place).m));
        }
        EXPECT_LE(worst, 1e-9);
    }
    const auto small = geoid->nodes_around({86, 27, 87, 28});
    EXPECT_LE(small.rows, 50);
    EXPECT_LE(small.columns, 50);
}

TEST(RegionalGeoid, NodesAroundAnAreaKeepHolesAndBorders) {
    GeoidNodes nodes{-45, 170, 0.1, 0.2, 60, 50, {}};
    for (int row = 0; row < nodes.rows; ++row)
        for (int column = 0; column < nodes.columns; ++column)
            nodes.undulations.push_back(
                row == 30 && column == 25
                    ? std::nan("")
                    : static_cast<double>(static_cast<float>(10 * std::sin(row / 4.0) + column * 0.3)));
    const auto whole = Geoid::from_nodes(nodes, "whole");
    ASSERT_TRUE(whole);
    const std::vector<GridFrame::Extent> areas{
        {174, -43, 176, -41}, {169, -46, 170.5, -44.5}, {-181, -40, -180.3, -38}, {100, 0, 101, 1}};
    for (const auto& area : areas) {
        const auto cut = Geoid::from_nodes(whole->nodes_around(area), "cut");
        ASSERT_TRUE(cut) << cut.error().message;
        for (double lat = area.south; lat <= area.north; lat += 0.03) {
            for (double lon = area.west; lon <= area.east; lon += 0.03) {
                EXPECT_EQ(cut->covers(at(lat, lon)), whole->covers(at(lat, lon))) << lat << ' ' << lon;
                if (whole->covers(at(lat, lon))) {
                    EXPECT_NEAR(cut->undulation(at(lat, lon)).m, whole->undulation(at(lat, lon)).m, 1e-9);
                }
            }
        }
    }
}

TEST(RegionalGeoid, HolesAreNotCovered) {
    const auto smooth = [](double lat, double lon) { return 40 + std::sin(lat) + std::cos(lon); };
    auto nodes = region(46, 10, 0.1, 41, 41, smooth);
    const auto whole = Geoid::from_nodes(nodes, "whole");
    for (int row = 18; row < 24; ++row)
        for (int column = 18; column < 41; ++column)
            nodes.undulations[static_cast<std::size_t>(row * 41 + column)] = std::nan("");
    const auto holed = Geoid::from_nodes(nodes, "holed");
    ASSERT_TRUE(whole && holed);
    EXPECT_FALSE(holed->covers(at(48, 13)));
    EXPECT_FALSE(holed->covers(at(47.75, 12.55)));
    EXPECT_TRUE(std::isfinite(holed->undulation(at(48, 13)).m));
    int covered = 0;
    for (double lat = 46; lat <= 50; lat += 0.025)
        for (double lon = 10; lon <= 14; lon += 0.025) {
            if (!holed->covers(at(lat, lon))) continue;
            ++covered;
            ASSERT_NEAR(holed->undulation(at(lat, lon)).m, whole->undulation(at(lat, lon)).m, 0.02);
        }
    EXPECT_GT(covered, 20000);
    std::fill(nodes.undulations.begin(), nodes.undulations.end(), std::nan(""));
    EXPECT_FALSE(Geoid::from_nodes(nodes, "empty"));
}

TEST(MissingGeoid, NamesTheFileAndThePackage) {
    // In a process of its own: PROJ reads its search path once.
    const auto without_grids = [] {
        proj_context_set_search_paths(nullptr, 0, nullptr);
        setenv("PROJ_LIB", "/nonexistent", 1);
        setenv("PROJ_DATA", "/nonexistent", 1);
        const char* const nowhere = "/nonexistent";
        proj_context_set_search_paths(nullptr, 1, &nowhere);
        const auto geoid = Geoid::egm96();
        if (!geoid) fmt::print(stderr, "{}", geoid.error().message);
        std::_Exit(geoid ? 0 : 1);
    };
    EXPECT_EXIT(without_grids(), testing::ExitedWithCode(1), "egm96_15.gtx.*proj-data");
}

}  // namespace
}  // namespace relevo::geo
