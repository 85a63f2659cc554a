#include "lod/ocean/projected_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "geo/position.hpp"

namespace relevo {
namespace {

using geo::Degrees;
using lod::ProjectedGrid;
using lod::Projection;

/// A camera over the sea, with all that it refers to.
struct Shot {
    lod::SeaChart chart;
    lod::View view;
    lod::SeaView sea;

    Shot(const lod::Camera& camera, double crest_m, geo::LatLon anchor)
        : chart(anchor), view(camera), sea(view, chart, 0, crest_m) {}
    Shot(const lod::Camera& camera, double crest_m)
        : Shot(camera, crest_m, {camera.eye.lat, camera.eye.lon}) {}
    Shot(const Shot&) = delete;

    glm::dvec3 local(const glm::dvec3& v) const {
        return {glm::dot(v, sea.east), glm::dot(v, sea.north), glm::dot(v, sea.up)};
    }
    std::optional<Projection> project() const { return ProjectedGrid(256, 256).project(sea); }
};

lod::Camera camera(double height_m, double pitch, double fov = 60, double roll = 0, double heading = 30) {
    lod::Camera camera;
    camera.eye = {Degrees{38.5}, Degrees{-9.5}, {height_m}};
    camera.heading = Degrees{heading};
    camera.pitch = Degrees{pitch};
    camera.roll = Degrees{roll};
    camera.fov = Degrees{fov};
    return camera;
}

std::string text(const Shot& shot) {
    const lod::Camera& c = shot.view.camera();
    return "eye " + std::to_string(c.eye.h.m) + " m, lat " + std::to_string(c.eye.lat.value) + ", heading " +
           std::to_string(c.heading.value) + ", pitch " + std::to_string(c.pitch.value) + ", roll " +
           std::to_string(c.roll.value) + ", fov " + std::to_string(c.fov.value) + ", " +
           std::to_string(c.width) + " x " + std::to_string(c.height) + ", crest " +
           std::to_string(shot.sea.crest_m) + ", reach " + std::to_string(shot.sea.reach_m);
}

/// Cameras of every kind; every fourth is of a family of trouble.
class Cameras {
  public:
    explicit Cameras(unsigned seed) : random_(seed) {}

    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

    Shot next() {
        lod::Camera c =
            camera(pick(5) == 0 ? -log_uniform(0.01, 50) : log_uniform(0.01, 1e7), uniform(-90, 90),
                   uniform(1, 150), pick(2) == 0 ? 0 : uniform(-180, 180), uniform(0, 360));
        c.eye.lat = Degrees{uniform(-89, 89)};
        c.eye.lon = Degrees{uniform(-180, 180)};
        c.height = 1000;
        c.width = static_cast<int>(1000 * log_uniform(0.25, 4));
        const double crest = pick(4) == 0 ? 0.0 : uniform(0, 10);
        if (pick(4) == 0) {
            const double dip = c.eye.h.m > 0 ? std::acos(6.37e6 / (6.37e6 + c.eye.h.m)) : 0;
            switch (pick(8)) {
                case 0:
                    c.pitch = Degrees::from_radians(-dip);
                    break;
                case 1:
                    c.pitch = Degrees{-90};
                    break;
                case 2:
                    c.pitch = Degrees{90};
                    break;
                case 3:
                    c.roll = Degrees{90.0 * pick(4)};
                    break;
                case 4:
                    c.fov = Degrees{1};
                    break;
                case 5:
                    c.fov = Degrees{150};
                    break;
                case 6:
                    c.eye.h.m = uniform(-crest - 0.1, crest + 0.1);
                    break;
                // The horizon on the picture's lower edge.
                default:
                    c.pitch = Degrees{0.5 * c.fov.value} - Degrees::from_radians(dip);
            }
        }
        return Shot(c, crest);
    }

  private:
    std::mt19937 random_;
};

/// Metres along the sphere from the nadir to the foot of a point; x east, y north, z up from the nadir.
double arc_to(double radius_m, const glm::dvec3& p) {
    return radius_m * std::atan2(std::hypot(p.x, p.y), radius_m + p.z);
}

/// Where a ray meets the surface at a height, within the reach: by the quadratic, from the sphere's centre.
std::vector<glm::dvec3> hits(const lod::SeaView& sea, const glm::dvec3& ray, double height_m) {
    using Real = long double;
    const Real k = Real(sea.radius_m) + sea.eye_m, r = Real(sea.radius_m) + height_m;
    const Real b = k * ray.z, c = (k - r) * (k + r);
    const Real a = Real(ray.x) * ray.x + Real(ray.y) * ray.y + Real(ray.z) * ray.z;
    const Real discriminant = b * b - a * c;
    std::vector<glm::dvec3> found;
    if (discriminant < 0) return found;
    const Real q = -b - std::copysign(std::sqrt(discriminant), b);
    for (const Real t : {q / a, c / q}) {
        if (!(t > 0)) continue;
        const glm::dvec3 p = double(t) * ray + glm::dvec3(0, 0, sea.eye_m);
        if (arc_to(sea.radius_m, p) <= sea.reach_m) found.push_back(p);
    }
    return found;
}

/// The foot at sea level of a point.
glm::dvec3 foot(double radius_m, const glm::dvec3& p) {
    const double angle = arc_to(radius_m, p) / radius_m;
    const double half = std::sin(0.5 * angle);
    const double level = std::hypot(p.x, p.y);
    const double along = level > 0 ? radius_m * std::sin(angle) / level : 0;
    return {p.x * along, p.y * along, -2 * radius_m * half * half};
}

/// Grid coordinates of a point, by solving for them; not a number if it is behind the projector.
glm::dvec2 seen_by(const Projection& projection, const glm::dvec3& p) {
    const glm::dvec3 q = glm::inverse(glm::dmat3(projection.d0, projection.du, projection.dv)) *
                         (p - glm::dvec3(0, 0, projection.eye_m));
    return q.x > 0 ? glm::dvec2(q.y, q.z) / q.x : glm::dvec2(std::nan(""));
}

bool in_grid(const glm::dvec2& uv) {
    constexpr double kTolerance = 1e-9;
    return uv.x >= -kTolerance && uv.x <= 1 + kTolerance && uv.y >= -kTolerance && uv.y <= 1 + kTolerance;
}

/// The ray through a place in the picture, 0 to 1; the picture is widened by an angle at its corners.
glm::dvec3 ray(const Shot& shot, const glm::dvec2& at, double margin) {
    const lod::View& view = shot.view;
    const glm::dvec2 size(view.camera().width, view.camera().height);
    const glm::dvec2 half = 0.5 * size / view.focal_px();
    const glm::dvec2 turn =
        std::min(margin * std::sqrt(1 + glm::dot(half, half)), 0.5) / glm::sqrt(1.0 + half * half);
    const glm::dvec2 slope = (2.0 * at - 1.0) * glm::tan(glm::atan(half) + turn);
    return shot.local(view.forward() + slope.x * view.right() + slope.y * view.up());
}

/// Places in the picture: its corners, then half of them on its edges.
glm::dvec2 pixel(Cameras& random, int index) {
    if (index < 4) return {index & 1, index >> 1};
    glm::dvec2 at(random.uniform(0, 1), random.uniform(0, 1));
    if (index % 2 == 0) at[(index >> 1) & 1] = (index >> 2) & 1;
    return at;
}

/// How many places were seen, at random heights within the waves; expects all of them in the grid.
int check_all_held(const Shot& shot, Cameras& random, int pixels) {
    const std::optional<Projection> projection = shot.project();
    int places = 0;
    for (int i = 0; i < pixels; ++i) {
        const double crest = shot.sea.crest_m;
        const double heights[] = {random.uniform(-crest, crest), 0, crest, -crest};
        const glm::dvec2 at = pixel(random, i);
        // To the margin's very end: within it the test would see nothing that is wrong by less.
        const glm::dvec3 d = ray(shot, at, ProjectedGrid::margin(shot.sea));
        for (const glm::dvec3& p : hits(shot.sea, d, heights[random.pick(4)])) {
            ++places;
            if (!projection) {
                ADD_FAILURE() << "nothing drawn: " << text(shot);
                return places;
            }
            const glm::dvec2 uv = seen_by(*projection, foot(shot.sea.radius_m, p));
            if (!in_grid(uv)) {
                ADD_FAILURE() << "pixel " << at.x << ", " << at.y << " at " << uv.x << ", " << uv.y << ": "
                              << text(shot);
                return places;
            }
        }
    }
    return places;
}

constexpr int kCameras = 10000;

TEST(ProjectedGrid, HoldsAllOfTheSeaThatRandomCamerasSee) {
    Cameras cameras(20240611);
    long places = 0;
    for (int i = 0; i < kCameras && !HasFailure(); ++i) {
        SCOPED_TRACE("camera " + std::to_string(i));
        places += check_all_held(cameras.next(), cameras, 200);
    }
    RecordProperty("places", std::to_string(places));
    EXPECT_GT(places, 50 * kCameras);
}

// Fields of 170 degrees see from below the eye to the horizon, and the horizon to both sides.
TEST(ProjectedGrid, HoldsAllOfTheSeaThatOddCamerasSee) {
    Cameras random(3);
    int seeing = 0;
    for (const double height : {-2000.0, -40.0, -2.0, -0.5, 0.0, 0.5, 2.0, 1e3, 1e5, 1e7}) {
        for (const double pitch : {-90.0, -89.0, -45.0, -5.0, 0.0, 5.0, 45.0, 89.0, 90.0}) {
            for (const double roll : {0.0, 45.0, 90.0, 180.0}) {
                for (const double fov : {1.0, 60.0, 150.0, 170.0}) {
                    for (const int width : {180, 720, 2880}) {
                        lod::Camera c = camera(height, pitch, fov, roll);
                        c.width = width;
                        for (const double crest : {0.0, 1.0})
                            seeing += check_all_held({c, crest}, random, 100) > 0;
                        if (HasFailure()) return;
                    }
                }
            }
        }
    }
    EXPECT_GT(seeing, 4000) << "of 8640";
}

TEST(ProjectedGrid, IsDrawnOnlyWhereThereIsSea) {
    Cameras cameras(77);
    int drawn = 0;
    for (int i = 0; i < kCameras; ++i) {
        const Shot shot = cameras.next();
        if (!shot.project()) continue;
        ++drawn;
        const double crest = shot.sea.crest_m;
        bool seen = false;
        for (int j = 0; j < 20000 && !seen; ++j) {
            const glm::dvec3 d = ray(shot, pixel(cameras, j), ProjectedGrid::margin(shot.sea));
            for (const double h : {crest, 0.0, -crest}) seen = seen || !hits(shot.sea, d, h).empty();
        }
        EXPECT_TRUE(seen) << "camera " << i << ": " << text(shot);
    }
    EXPECT_GT(drawn, kCameras / 2);
    EXPECT_LT(drawn, kCameras);
}

// Where the sea really is: rays meet the ellipsoid, and the chart says which vertex would come to lie there.
TEST(ProjectedGrid, HoldsTheEllipsoidsSea) {
    using Real = long double;
    const Real a = 6378137.0L, b = a * (1 - 1 / 298.257223563L);
    Cameras cameras(11);
    int places = 0;
    double farthest = 0;  // as seen from the eye, radians
    for (int i = 0; i < kCameras && !HasFailure(); ++i) {
        lod::Camera c = camera(cameras.log_uniform(2, i % 2 ? 1e7 : 1e4), cameras.uniform(-90, 10),
                               cameras.uniform(1, 120), 0, cameras.uniform(0, 360));
        c.eye.lat = Degrees{cameras.uniform(-89, 89)};
        const geo::LatLon middle{Degrees{cameras.uniform(-90, 90)}, Degrees{cameras.uniform(-180, 180)}};
        const Shot shot(c, 2, lod::sea_chart_anchor(middle, {c.eye.lat, c.eye.lon}));
        const std::optional<Projection> projection = shot.project();
        for (int j = 0; j < 50; ++j) {
            const glm::dvec2 at = pixel(cameras, j);
            const glm::dvec3 d = shot.view.ray(at * glm::dvec2(c.width, c.height));
            const glm::dvec3 eye = shot.view.eye().m;
            const Real ex = eye.x / a, ey = eye.y / a, ez = eye.z / b, dx = d.x / a, dy = d.y / a,
                       dz = d.z / b;
            const Real dd = dx * dx + dy * dy + dz * dz, ed = ex * dx + ey * dy + ez * dz;
            const Real ee = ex * ex + ey * ey + ez * ez - 1;
            const Real discriminant = ed * ed - dd * ee;
            if (ed > 0 || discriminant < 0) continue;
            const Real t = ee / (-ed + std::sqrt(discriminant));
            const Real x = (ex + t * dx) / a, y = (ey + t * dy) / a,
                       z = (ez + t * dz) / b;  // along the normal
            const geo::LatLon hit{Degrees::from_radians(double(std::atan2(z, std::hypot(x, y)))),
                                  Degrees::from_radians(double(std::atan2(y, x)))};
            glm::dvec2 place = shot.chart.at(hit) - shot.sea.nadir;
            // The ellipsoid's horizon may be farther than the sphere's: a thousandth of a pixel.
            place *= std::min(1.0, shot.sea.reach_m / glm::length(place));
            const glm::dvec3 offset = shot.local(shot.sea.offset(place, 0));
            farthest = std::max(farthest, glm::length(glm::cross(glm::normalize(offset), shot.local(d))));
            ++places;
            if (!projection || !in_grid(seen_by(*projection, offset + glm::dvec3(0, 0, shot.sea.eye_m)))) {
                ADD_FAILURE() << "camera " << i << ", pixel " << at.x << ", " << at.y << ": " << text(shot);
                break;
            }
        }
    }
    RecordProperty("farthest_rad", std::to_string(farthest));
    EXPECT_GT(places, 20 * kCameras);
}

TEST(ProjectedGrid, PlaceIsWhereTheRayMeetsTheSea) {
    Cameras cameras(8);
    double worst = 0, worst_in_float = 0;
    int laid_down = 0, met = 0;
    for (int i = 0; i < kCameras; ++i) {
        const Shot shot = cameras.next();
        const std::optional<Projection> projection = shot.project();
        if (!projection) continue;
        const Projection& p = *projection;
        for (int j = 0; j < 20; ++j) {
            const glm::dvec2 uv(cameras.uniform(0, 1), cameras.uniform(0, 1));
            const glm::dvec2 at = place(p, uv.x, uv.y);
            const glm::dvec3 d = p.d0 + uv.x * p.du + uv.y * p.dv;
            const double length = glm::length(at);
            ASSERT_LE(length, p.reach_m * (1 + 1e-15)) << text(shot);
            EXPECT_NEAR(at.x * d.y - at.y * d.x, 0, 1e-9 * length * glm::length(d)) << "in the ray's azimuth";
            if (length < p.reach_m * (1 - 1e-6)) {
                const double angle = length / p.radius_m, half = std::sin(0.5 * angle);
                const glm::dvec2 along = at * (length > 0 ? p.radius_m * std::sin(angle) / length : 1);
                const glm::dvec2 back = seen_by(p, {along, -2 * p.radius_m * half * half});
                worst = std::max({worst, std::abs(back.x - uv.x), std::abs(back.y - uv.y)});
                ++met;
            } else {
                ++laid_down;
            }

            // As a shader does it.
            const glm::vec3 f =
                glm::vec3(p.d0) + float(uv.x) * glm::vec3(p.du) + float(uv.y) * glm::vec3(p.dv);
            const float s = p.eye_m < 0 ? f.z : -f.z, c2 = float(p.sin2_dip);
            const float discriminant = s * s - c2 * glm::dot(f, f);
            const float level = glm::length(glm::vec2(f));
            float arc = float(p.reach_m);
            if (s > 0 && discriminant >= 0) {
                const float tau = std::abs(c2) / (s + std::sqrt(discriminant));
                arc = std::min(arc, float(p.radius_m) * std::atan2(tau * level, 1 + tau * f.z));
            }
            const glm::vec2 in_float = level > 0 ? glm::vec2(f) * (arc / level) : glm::vec2(0);
            worst_in_float = std::max(worst_in_float, glm::distance(glm::dvec2(in_float), at) /
                                                          std::max(length, std::abs(p.eye_m)));
        }
    }
    EXPECT_LT(worst, 1e-9);
    EXPECT_LT(worst_in_float, 5e-3) << "of the distance; next to the horizon";
    EXPECT_GT(met, 100000);
    EXPECT_GT(laid_down, 1000);
    RecordProperty("float", std::to_string(worst_in_float));
    RecordProperty("double", std::to_string(worst * 1e12) + "e-12");
}

TEST(ProjectedGrid, RaysOverTheHorizonJoinThoseBelowIt) {
    for (const double height : {-20.0, 2.0, 1e4, 1e7}) {
        const double dip = height > 0 ? std::acos(6.37e6 / (6.37e6 + height)) : 0;
        const Shot shot(camera(height, -Degrees::from_radians(dip).value, 60, 40), 1);
        const std::optional<Projection> projection = shot.project();
        ASSERT_TRUE(projection);
        const Projection& p = *projection;
        const auto at = [&](const glm::dvec2& uv) { return place(p, uv.x, uv.y); };
        const auto laid_down = [&](const glm::dvec2& uv) {
            return glm::length(at(uv)) > p.reach_m * (1 - 1e-14);
        };
        glm::dvec2 low(0.5), high(0.5);
        for (const glm::dvec2 corner : {glm::dvec2(0, 0), {0, 1}, {1, 0}, {1, 1}}) {
            (laid_down(corner) ? high : low) = corner;
        }
        ASSERT_FALSE(laid_down(low)) << height;
        ASSERT_TRUE(laid_down(high)) << height;
        while (glm::distance(low, high) > 1e-15) {
            const glm::dvec2 middle = 0.5 * (low + high);
            if (middle == low || middle == high) break;
            (laid_down(middle) ? high : low) = middle;
        }
        EXPECT_LT(glm::distance(at(low), at(high)), 1e-5 * p.reach_m) << height;
    }
}

// The reference's planes are at base + N max and, its sign set right, base + N min: between them the sea is
// both ways from the eye, beyond them one way.
TEST(ProjectedGrid, KnowsTheWavesBounds) {
    const auto drawn = [](double height, double pitch) {
        return Shot(camera(height, pitch, 20), 10).project().has_value();
    };
    for (const double inside : {-9.9, -5.0, 0.0, 5.0, 9.9}) {
        EXPECT_TRUE(drawn(inside, 90)) << inside;
        EXPECT_TRUE(drawn(inside, -90)) << inside;
    }
    EXPECT_FALSE(drawn(10.1, 90));
    EXPECT_TRUE(drawn(10.1, -90));
    EXPECT_TRUE(drawn(-10.1, 90));
    EXPECT_FALSE(drawn(-10.1, -90));
}

TEST(ProjectedGrid, ProjectsFromBeyondTheWavesAndBelowTheHorizon) {
    Cameras cameras(21);
    for (int i = 0; i < kCameras; ++i) {
        const Shot shot = cameras.next();
        const std::optional<Projection> projection = shot.project();
        if (!projection) continue;
        EXPECT_GE(std::abs(projection->eye_m), std::abs(shot.sea.eye_m) + shot.sea.crest_m) << text(shot);
        EXPECT_EQ(projection->eye_m < 0, shot.sea.eye_m < 0);
        const glm::dvec3 aim = glm::normalize(glm::cross(projection->dv, projection->du));
        const double toward = projection->eye_m < 0 ? aim.z : -aim.z;
        EXPECT_GT(toward, std::sqrt(std::max(projection->sin2_dip, 0.0))) << text(shot);
        EXPECT_NEAR(glm::dot(glm::normalize(projection->du), glm::normalize(projection->dv)), 0, 1e-9);
        EXPECT_NEAR(projection->cell.x * 255, glm::length(projection->du), 1e-9 * projection->cell.x);
    }
}

TEST(ProjectedGrid, ReachesBothEndsAndTurnsCounterClockwise) {
    const lod::OceanPatch patch = ProjectedGrid(33, 17).patch();
    ASSERT_EQ(patch.vertices.size(), 33u * 17u);
    EXPECT_EQ(patch.vertices.front(), glm::i16vec2(0, 0));
    EXPECT_EQ(patch.vertices.back(), glm::i16vec2(32, 16));
    ASSERT_EQ(patch.triangles(), 2u * 32u * 16u);

    for (const double height : {100.0, -20.0}) {
        const std::optional<Projection> projection = Shot(camera(height, height > 0 ? -50 : 50), 1).project();
        ASSERT_TRUE(projection);
        double on_screen = 0;
        for (std::size_t i = 0; i < patch.indices.size(); i += 3) {
            glm::dvec2 uv[3], at[3];
            for (std::size_t j = 0; j < 3; ++j) {
                uv[j] = glm::dvec2(patch.vertices[patch.indices[i + j]]) / glm::dvec2(32, 16);
                at[j] = place(*projection, uv[j].x, uv[j].y);
            }
            const auto area = [](const glm::dvec2(&p)[3]) {
                const glm::dvec2 a = p[1] - p[0], b = p[2] - p[0];
                return 0.5 * (a.x * b.y - a.y * b.x);
            };
            on_screen += area(uv);
            EXPECT_GT(area(uv), 0);
            EXPECT_GT(area(at) * height, 0) << "under water seen from below";
        }
        EXPECT_NEAR(on_screen, 1, 1e-12) << "covers all, once";
    }
    const lod::OceanPatch largest = ProjectedGrid(256, 256).patch();
    EXPECT_EQ(*std::max_element(largest.indices.begin(), largest.indices.end()), 65535) << "16 bits do";
}

TEST(ProjectedGrid, SpendsItsVerticesInThePicture) {
    const auto median = [](double roll) {
        Cameras cameras(5);
        std::vector<double> fractions;
        for (int i = 0; i < 1000; ++i) {
            const Shot shot(camera(cameras.log_uniform(2, 50e3), cameras.uniform(-90, 10), 60,
                                   cameras.uniform(-roll, roll), cameras.uniform(0, 360)),
                            cameras.uniform(0, 5));
            const std::optional<Projection> projection = shot.project();
            if (!projection) continue;
            int inside = 0;
            for (int j = 0; j < 64 * 64; ++j) {
                const int column = j % 64, row = j / 64;
                const glm::dvec2 at = place(*projection, column / 63.0, row / 63.0);
                inside += glm::length(at) < shot.sea.reach_m && shot.view.sees(shot.sea.offset(at, 0));
            }
            fractions.push_back(inside / (64.0 * 64));
        }
        std::nth_element(fractions.begin(), fractions.begin() + 500, fractions.end());
        return fractions[500];
    };
    const double level = median(0), rolled = median(180);
    EXPECT_GT(level, 0.8);
    EXPECT_GT(rolled, 0.65);
    RecordProperty("level", std::to_string(level));
    RecordProperty("rolled", std::to_string(rolled));
}

}  // namespace
}  // namespace relevo
