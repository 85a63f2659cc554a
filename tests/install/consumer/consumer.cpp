// A program of somebody else's that uses the installed libraries.
#include <cstdio>

#include <geo/geodesic.hpp>
#include <lod/scene/scene.hpp>

int main() {
    using relevo::geo::Degrees;
    const auto line = relevo::geo::geodesic({Degrees{0}, Degrees{0}}, {Degrees{0}, Degrees{1}});
    std::printf("%.3f m\n", line.length_m);  // of the equator: 6378137 pi / 180
    const auto scene = relevo::lod::Scene::open("/no/such/scene");
    return !scene && line.length_m > 111319.490 && line.length_m < 111319.491 ? 0 : 1;
}
