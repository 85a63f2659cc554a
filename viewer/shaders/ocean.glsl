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
    vec4 sun;           // ECEF; w: daylight
    vec4 slopes;        // variance of the sea's slope; metres a post
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

// Depth of the water, metres. Where the data has no bed under its sea: a metre for every twenty from the shore, as far as
// these posts and coarser ones tell how far that is; farther out waves feel no bed.
// apart: of the places that are asked for, in posts; here: the place among such.
float depth_at(vec2 grid, ivec2 cell, float apart, PagePlace here) {
#ifdef BED
    return -ground_height(here);
#else
    const float kFar = 8.0;
    float reach = clamp(apart, 1.0, kFar);
    float near_sea = clamp(2.0 * at_place(shore, here).r - 1.0, 0.0, 1.0);
    float far_sea = clamp(2.0 * at_place(shore, page_place(grid, cell, max(apart, kFar))).r - 1.0, 0.0, 1.0);
    float open_sea = far_sea * far_sea * far_sea * far_sea;
    return 0.05 * ocean.slopes.y * (reach * near_sea + (kFar - reach) * far_sea) + 1000.0 * open_sea * open_sea;
#endif
}
