#include "geo/antimeridian.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/geodesic.hpp"

namespace relevo::geo {
namespace {

/// A vertex with its longitude run on without jumps, beside the one that is written.
struct Vertex {
    double x = 0;    // continuous along the line
    double lat = 0;  // degrees
    double lon = 0;  // in [-180, 180], to the last bit
};

using Ring = std::vector<Vertex>;

double in_half_turns(double lon) {
    return std::remainder(lon, 360.0);  // exact
}

/// The vertices, each by the shorter way from the one before.
Ring unrolled(std::span<const LatLon> places) {
    Ring ring;
    for (const LatLon& place : places) {
        const double lon = in_half_turns(place.lon.value);
        const double x = ring.empty() ? lon : ring.back().x + in_half_turns(lon - ring.back().lon);
        ring.push_back({x, place.lat.value, lon});
    }
    return ring;
}

/// The latitude at which the side from a to b is at longitude x between theirs.
double latitude_at(const Vertex& a, const Vertex& b, double x) {
    if (a.x == x) return a.lat;
    if (b.x == x) return b.lat;
    if (a.lat == b.lat && std::abs(a.lat) == 90) return a.lat;
    const GeodesicPath path({Degrees{a.lat}, Degrees{a.x}}, {Degrees{b.lat}, Degrees{b.x}});
    double low = 0;
    double high = path.length_m();
    for (int i = 0; i < 100; ++i) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) break;
        ((path.at(middle).lon.value < x) == (a.x < x) ? low : high) = middle;
    }
    return path.at(low).lat.value;
}

/// Which turn's half-turns, [-180, 180] + 360 k, a longitude is in.
double strip_of(double x) {
    return std::floor((x + 180) / 360);
}

LatLon written(const Vertex& v, double strip) {
    const double lon = std::abs(v.lon) == 180 ? std::copysign(180.0, v.x - 360 * strip) : v.lon;
    return {Degrees{v.lat}, Degrees{lon}};
}

Vertex on_meridian(const Vertex& a, const Vertex& b, double x) {
    return {x, latitude_at(a, b, x), 180};
}

/// Both sides of the meridian x = cut. The sides that cross it do so in places which, sorted by latitude,
/// bound the polygon's parts of the meridian two by two: a piece that ends at one goes on at its partner.
void split_at(const Ring& ring, double cut, std::vector<Ring>& pieces) {
    struct Crossing {
        std::size_t after;  // the vertex before it
        Vertex at;
        std::size_t partner = 0;
    };
    const std::size_t count = ring.size();
    const auto beyond = [&](std::size_t i) { return ring[i].x > cut; };
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        if (beyond(i) != beyond(next)) crossings.push_back({i, on_meridian(ring[i], ring[next], cut)});
    }
    if (crossings.empty()) {
        pieces.push_back(ring);
        return;
    }
    std::vector<std::size_t> by_lat(crossings.size());
    std::iota(by_lat.begin(), by_lat.end(), std::size_t{0});
    std::sort(by_lat.begin(), by_lat.end(),
              [&](std::size_t a, std::size_t b) { return crossings[a].at.lat < crossings[b].at.lat; });
    for (std::size_t i = 0; i < by_lat.size(); ++i) crossings[by_lat[i]].partner = by_lat[i ^ 1];

    std::vector<bool> done(crossings.size());
    for (std::size_t first = 0; first < crossings.size(); ++first) {
        if (done[first]) continue;
        Ring piece;
        const auto add = [&](const Vertex& v) {
            if (piece.empty() || piece.back().x != v.x || piece.back().lat != v.lat) piece.push_back(v);
        };
        for (std::size_t c = first; !done[c];) {
            done[c] = true;
            const std::size_t end = (c + 1) % crossings.size();  // the crossing after it along the ring
            add(crossings[c].at);
            for (std::size_t i = crossings[c].after; i != crossings[end].after;) {
                i = (i + 1) % count;
                add(ring[i]);
            }
            add(crossings[end].at);
            c = crossings[end].partner;
        }
        if (piece.size() > 1 && piece.front().x == piece.back().x && piece.front().lat == piece.back().lat)
            piece.pop_back();
        if (piece.size() > 2) pieces.push_back(std::move(piece));
    }
}

/// A ring around a pole, made one of the plane: from the antimeridian once round, to the pole and back.
Ring around_pole(const Ring& ring, double turn, double pole) {
    const std::size_t count = ring.size();
    const auto next_x = [&](std::size_t i) { return i + 1 < count ? ring[i + 1].x : ring[0].x + turn; };
    const double sign = turn < 0 ? -1 : 1;
    for (std::size_t i = 0; i < count; ++i) {
        // Is there a cut in (x, next x]?
        const double cut = sign * (360 * std::floor((sign * next_x(i) - 180) / 360) + 180);
        if (!(sign * cut > sign * ring[i].x)) continue;
        Vertex after = ring[(i + 1) % count];
        after.x = next_x(i);
        const Vertex start = on_meridian(ring[i], after, cut);
        Ring opened{start};
        for (std::size_t k = 1; k <= count; ++k) {
            Vertex v = ring[(i + k) % count];
            if (i + k >= count) v.x += turn;
            if (v.x != start.x) opened.push_back(v);
        }
        Vertex end = start;
        end.x += turn;
        if (opened.back().x != end.x) opened.push_back(end);
        opened.push_back({end.x, pole, 180});
        opened.push_back({start.x, pole, 180});
        return opened;
    }
    return ring;
}

}  // namespace

std::vector<std::vector<LatLon>> split_path(std::span<const LatLon> path) {
    const Ring line = unrolled(path);
    if (line.empty()) return {};
    std::vector<std::vector<LatLon>> parts;
    double strip = strip_of(line[0].x);
    const auto go_to = [&](const Vertex& from, const Vertex& to) {
        const double middle = 0.5 * (from.x + to.x);
        const bool along_cut = from.x == to.x && std::abs(from.x - 360 * strip) == 180;
        if (parts.empty() || (!along_cut && strip_of(middle) != strip)) {
            if (!along_cut) strip = strip_of(middle);
            parts.push_back({written(from, strip)});
        }
        parts.back().push_back(written(to, strip));
    };
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vertex& a = line[i - 1];
        const Vertex& b = line[i];
        const double cut = 360 * std::floor((std::max(a.x, b.x) + 180) / 360) - 180;
        if (cut > std::min(a.x, b.x) && cut < std::max(a.x, b.x)) {
            const Vertex between = on_meridian(a, b, cut);
            go_to(a, between);
            go_to(between, b);
        } else {
            go_to(a, b);
        }
    }
    if (parts.empty()) parts.push_back({written(line[0], strip)});
    return parts;
}

std::vector<std::vector<LatLon>> split_polygon(std::span<const LatLon> polygon) {
    Ring ring = unrolled(polygon);
    const bool counter_clockwise = geodesic_area(polygon).counter_clockwise;
    const double turn = ring.back().x + in_half_turns(ring.front().lon - ring.back().lon) - ring.front().x;
    if (std::abs(turn) > 180) {
        // Eastwards the north is on the left.
        const double pole = (turn > 0) == counter_clockwise ? 90 : -90;
        ring = around_pole(ring, std::copysign(360.0, turn), pole);
    }
    if (!counter_clockwise) std::reverse(ring.begin() + (std::abs(turn) > 180 ? 0 : 1), ring.end());

    std::vector<Ring> pieces{ring};
    const auto [west, east] = std::minmax_element(ring.begin(), ring.end(),
                                                  [](const Vertex& a, const Vertex& b) { return a.x < b.x; });
    for (double cut = 360 * strip_of(west->x) + 180; cut < east->x; cut += 360) {
        std::vector<Ring> finer;
        for (const Ring& piece : pieces) split_at(piece, cut, finer);
        pieces = std::move(finer);
    }
    std::vector<std::vector<LatLon>> parts;
    for (const Ring& piece : pieces) {
        double least = piece.front().x;
        double most = least;
        for (const Vertex& v : piece) {
            least = std::min(least, v.x);
            most = std::max(most, v.x);
        }
        const double strip = strip_of(0.5 * (least + most));
        parts.emplace_back();
        for (const Vertex& v : piece) parts.back().push_back(written(v, strip));
    }
    return parts;
}

}  // namespace relevo::geo
