// A vertex of the sea: each mesh says where in the chart it lies (`place`), and how far apart its vertices are there.
layout(binding = 5) uniform sampler2D undulation;  // of the geoid, less that at the nadir; finer near it

const float kSemiMajor = 6378137.0;
const float kEccentricity2 = 6.69437999014e-3;
const vec3 kAxes = vec3(1.0, 1.0, 1.0 - kEccentricity2);  // semi-axes' squares over the largest

out Water {
    vec3 offset;
    vec3 up;       // the ellipsoid's normal
    vec2 grid;     // column and row
    vec2 at;       // in the chart, from the nadir
    vec4 wave;     // slope along the chart's axes, height, depth
    vec4 body;     // colour of what comes out of the water, without a bed; haze
    float spacing;
#ifdef GRATICULE
    vec2 from_anchor;  // in units of the graticule's reach
#endif
}
water;

struct Sea {
    vec3 turn;    // of the ellipsoid's normal from the nadir to here: their difference
    vec3 offset;  // of the sea's level
};

// All is the difference to the nadir, worked out without its cancelling: a float is then as good near the eye as a
// double. Sine and cosine of the angle from the anchor are series in its square u; of each power the difference is
// (u - u_nadir) times a sum of products.
Sea sea_at(vec2 at) {
    vec2 nadir = vec2(ocean.anchor_east.w, ocean.anchor_north.w);
    vec2 way = at * ocean.anchor_up.w;
    float u_nadir = dot(nadir, nadir);
    float difference = dot(2.0 * nadir + way, way);
    float u = u_nadir + difference;
    float product = 1.0;  // (u^k - u_nadir^k) / (u - u_nadir)
    float power = 1.0;    // u_nadir^k
    float term = 1.0;     // of sin x / x
    float coefficient = 1.0;  // (-1)^k / (2k + 1)!
    float sinc = 1.0;
    float sinc_turn = 0.0;
    float cosine_turn = 0.0;
    for (int k = 1; k < 10; ++k) {
        float even = float(2 * k);
        cosine_turn -= coefficient / even * product;
        coefficient /= -even * (even + 1.0);
        sinc_turn += coefficient * product;
        term *= -u / (even * (even + 1.0));
        sinc += term;
        power *= u_nadir;
        product = u * product + power;
    }
    vec3 east = ocean.anchor_east.xyz;
    vec3 north = ocean.anchor_north.xyz;
    Sea sea;
    sea.turn = difference * (cosine_turn * ocean.anchor_up.xyz + sinc_turn * (east * nadir.x + north * nadir.y)) +
               sinc * (east * way.x + north * way.y);

    // The point of the ellipsoid with normal n is a A n / sqrt(1 - e^2 n_z^2), A the squares of the axes.
    vec3 nadir_up = ocean.nadir_up.xyz;
    vec3 up = nadir_up + sea.turn;
    float root = sqrt(1.0 - kEccentricity2 * up.z * up.z);
    float nadir_root = sqrt(1.0 - kEccentricity2 * nadir_up.z * nadir_up.z);
    float growth = kEccentricity2 * sea.turn.z * (up.z + nadir_up.z) / (root * nadir_root * (root + nadir_root));
    vec3 along = kSemiMajor * kAxes * (sea.turn / root + nadir_up * growth);

    vec2 part = at / ocean.level.y;
    vec2 texel = part * inversesqrt(max(length(part), 1e-12)) * ocean.level.z + 0.5;
    float rise = textureLod(undulation, texel, 0.0).r;
    sea.offset = along + sea.turn * (ocean.level.x + rise) + nadir_up * (rise - ocean.nadir_up.w);
    return sea;
}

// Columns and rows from the nadir.
vec2 grid_from_nadir(vec3 turn) {
    vec3 from = ocean.nadir_up.xyz;
    vec3 to = from + turn;
#ifdef POLE
    // The plane of PolarPositions: m(z) (x, y) with m = ((1 + e z) / (1 - e z))^(e/2) / (1 + z) of the polar normal.
    float e = sqrt(kEccentricity2);
    float z = POLE * to.z;
    float middle = POLE * (from.z + 0.5 * turn.z);
    float conformal = pow((1.0 + e * z) / (1.0 - e * z), 0.5 * e) / (1.0 + z);
    float at_middle = pow((1.0 + e * middle) / (1.0 - e * middle), 0.5 * e) / (1.0 + middle);
    float slope = at_middle * (kEccentricity2 / (1.0 - kEccentricity2 * middle * middle) - 1.0 / (1.0 + middle));
    vec2 moved = conformal * turn.xy + slope * POLE * turn.z * from.xy;
    return moved.yx / ocean.grid.zw;
#else
    float lon = atan(from.x * turn.y - from.y * turn.x, dot(from.xy, to.xy));
    float cos_from = length(from.xy);
    float cos_to = length(to.xy);
    float sine = turn.z * (cos_from + from.z * (from.z + to.z) / max(cos_from + cos_to, 1e-6));
    return vec2(lon, -asin(clamp(sine, -1.0, 1.0))) * ocean.grid.zw;
#endif
}

#ifndef WAVE_MAP  // wave_map.glsl has its own
// Slope along the chart's axes and height, of the waves that vertices so far apart carry in water so deep
// (lod/ocean/wave_error.hpp, waves.hpp).
vec3 waves_at(vec2 at, float spacing, float depth) {
    vec3 sum = vec3(0.0);
    int count = int(ocean.level.w);
    for (int i = 0; i < count; ++i) {
        vec4 wave = ocean.waves[2 * i];
        float wavelength = ocean.waves[2 * i + 1].x;
        if (wavelength <= 2.85 * spacing) break;  // the longest come first
        float carried = smoothstep(2.85, 4.5, wavelength / spacing) * smoothstep(0.0, 0.5, depth / wavelength);
        float angle = dot(wave.xy, at) + wave.w;
        float amplitude = wave.z * carried;
        sum += vec3(wave.xy * (-amplitude * sin(angle)), amplitude * cos(angle));
    }
    return sum;
}

// Spacing of a mesh whose waves are all that this one has: what is shorter are ripples.
float carried_spacing(float spacing) { return spacing; }
#endif

void main() {
    vec3 here = place();
    Sea sea = sea_at(here.xy);
    water.at = here.xy;
    water.spacing = carried_spacing(here.z);
    water.up = ocean.nadir_up.xyz + sea.turn;
    vec2 from_nadir = grid_from_nadir(sea.turn);
    water.grid = ocean.grid.xy + from_nadir;
#ifdef GRATICULE
    water.from_anchor = (overlays.shape.zw + from_nadir) * overlays.anchor.zw;
#endif
    vec2 grid = in_data(water.grid);
    ivec2 cell = cell_at(grid);
    float apart = max(here.z / ocean.slopes.y, 1e-3);
    float depth = depth_at(grid, cell, apart, page_place(grid, cell, apart));
    vec3 wave = waves_at(here.xy, here.z, max(depth, 0.0));
    water.wave = vec4(wave, depth);
    water.offset = sea.offset + water.up * wave.z;
    float way = length(water.offset);
    float sine = dot(water.up, water.offset) / -way;
    water.body = vec4(water_over(kSand, depth + wave.z, sine), haze(way, frame.eye_up.w, 0.0));
    gl_Position = frame.clip_from_offset * vec4(water.offset, 1.0);
}
