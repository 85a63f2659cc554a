// What all shaders of the sea know of a picture. Places on the sea are metres from the eye's nadir in the chart
// (lod/ocean/sea_chart.hpp), offsets are from the eye in ECEF axes.
const int kMostWaves = 32;
const int kRippleLayers = 10;
layout(std140, binding = 1) uniform Ocean {
    vec4 anchor_east;   // the chart's axes in ECEF; w: the nadir's x over the radius
    vec4 anchor_north;  // w: the nadir's y over the radius
    vec4 anchor_up;     // w: 1 / radius
    vec4 nadir_up;      // the ellipsoid's normal at the nadir; w: height of the eye above sea level
    vec4 nadir_east;    // along the chart's axes there
    vec4 nadir_north;
    vec4 level;         // of the sea above the ellipsoid at the nadir; how far the sea is seen; largest texel of `undulation`
                        // from its middle, 0 to 0.5; waves
    vec4 grid;          // column and row of the nadir; posts a radian (geographic) or a unit of the plane (POLE)
    vec4 depth;         // metres a post; 1: the sea has no bed of its own
    vec4 sun;           // ECEF; w: daylight
    vec4 slopes;        // variance of the sea's slope
    vec4 ripples[kRippleLayers];   // of each layer: where the nadir is in a tile; the tile's east, tiles a metre long
    vec4 steepest[kRippleLayers];  // its largest slope
    vec4 waves[2 * kMostWaves];  // k (rad/m, chart), amplitude, phase at the nadir and now; length
}
ocean;

const vec3 kAbsorption = vec3(0.40, 0.065, 0.045);  // a metre of clear coastal water
const vec3 kDeep = vec3(0.010, 0.075, 0.130);       // what comes back out of deep water
const vec3 kSand = vec3(0.74, 0.69, 0.55);

// Colour of a bed through so much water, seen from above at a sine of so much.
vec3 water_over(vec3 bed, float depth, float sine) {
    vec3 left_over = exp(-kAbsorption * max(depth, 0.0) * (1.0 + 0.75 / max(0.66 + 0.34 * sine, 0.3)));
    return mix(kDeep, bed * 0.75, left_over);
}

float power_5(float x) { return x * x * x * x * x; }

// The same place, on the turn of longitudes that the data is on.
vec2 turned(vec2 grid) {
#ifndef POLE
    float turn = 6.28318530718 * ocean.grid.z;
    grid.x -= turn * round((grid.x - 0.5 * frame.grid.x) / turn);
#endif
    return grid;
}
// Beyond the data the sea goes on as it is on the data's border.
vec2 in_data(vec2 grid) { return clamp(turned(grid), vec2(0.0), frame.grid.xy); }

// Depth of the water, metres, from posts so far apart (metres). Where the data has no bed under its sea: a metre for every
// twenty from the shore, as far as coarser and coarser posts tell how far that is; farther out waves feel no bed.
float depth_at(vec2 inside, float metres) {
    ivec2 cell = cell_at(inside);
    float apart = max(metres / ocean.depth.x, 1e-3);
    if (ocean.depth.y < 0.5) return -ground_height(page_place(inside, cell, apart));
    float shore = 0.0;
    float reach = 1.0;
    float open_sea = 0.0;
    for (int level = 0; level < 4; ++level, reach *= 2.0) {
        if (reach < 0.5 * apart && level < 3) continue;  // the first counts for those before
        open_sea = at_place(sea, page_place(inside, cell, reach)).r;
        shore += (shore > 0.0 ? 0.5 : 1.0) * reach * clamp(2.0 * open_sea - 1.0, 0.0, 1.0);
    }
    return 0.05 * ocean.depth.x * shore + 1000.0 * smoothstep(0.9, 1.0, open_sea);
}
