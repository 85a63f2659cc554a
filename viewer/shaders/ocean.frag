// Water: the bed through it, the sky and the sun on it, foam where it ends.
layout(binding = 6) uniform sampler2DArray ripples;  // slopes to the east and north over the layer's largest

in Water {
    vec3 offset;
    vec3 up;
    vec2 grid;
    vec2 at;
    vec4 wave;
    vec4 body;
    float spacing;
#ifdef GRATICULE
    vec2 from_anchor;
#endif
}
water;

out vec4 colour;

const vec3 kFoam = vec3(0.86, 0.90, 0.92);

#ifdef LOW_SUN
vec3 air_in(vec3 direction) { return air_colour(frame.sun_at_eye.w, toward_sun(direction)); }
vec3 zenith() { return zenith_colour(frame.sun_at_eye.w); }
#else
vec3 air_in(vec3 direction) { return kHazeColour * dimmed(ocean.sun.w); }
vec3 zenith() { return kZenithColour * dimmed(ocean.sun.w); }
#endif

vec3 sky_in(vec3 direction, float rise) { return mix(air_in(direction), zenith(), 1.0 - exp(-3.5 * max(rise, 0.0))); }

// Slope of a layer of ripples, where the mesh does not carry their waves itself.
vec2 ripple_slope(int layer) {
    vec4 here = ocean.ripples[layer];
    float wavelength = 0.0625 * exp2(float(layer));
    float left = ocean.steepest[layer].x * (1.0 - smoothstep(2.85, 4.5, wavelength / water.spacing));
    mat2 turn = mat2(here.z, -here.w, here.w, here.z);
    vec2 slope = texture(ripples, vec3(here.xy + turn * water.at, float(layer))).rg * 2.0 - 1.0;
    return slope * turn * (exp2(float(layer)) * left);
}

void main() {
#if defined(SHORE) || defined(DRAPES)
    vec2 grid = in_data(water.grid);
    vec2 steps = max(abs(dFdx(water.grid)), abs(dFdy(water.grid)));
    float apart = max(steps.x, steps.y);
#endif
#ifdef SHORE
    ivec2 cell = cell_at(grid);
    PagePlace place = page_place(grid, cell, apart);
#endif
#ifdef PROBE
#ifdef FILL
    const float what = 3.0;
#else
    const float what = 2.0;
#endif
    colour = vec4(water.at, water.wave.z, what);
#else
    // A texel is a 128th of a tile of 2^layer metres.
    vec2 wide = max(abs(dFdx(water.at)), abs(dFdy(water.at)));
    float layer = clamp(rough_log2(max(wide.x, wide.y)) + 6.5, 0.0, float(kRippleLayers) - 1.001);
    float finer = 1.0 - fract(layer);
    vec2 seen = ripple_slope(int(layer)) * finer + ripple_slope(int(layer) + 1) * (1.0 - finer);
    // Waves of different layers have nothing to do with each other: their variances add. Along the horizon a pixel is
    // long, and what tiles repeat in would be seen.
    vec3 to_eye = -normalize(water.offset);
    float flat_facing = dot(water.up, to_eye);
    seen *= inversesqrt(finer * finer + (1.0 - finer) * (1.0 - finer)) * (0.2 + 0.8 * smoothstep(0.0, 0.3, flat_facing));
    vec2 slope = water.wave.xy + seen;
    float rough = max(ocean.slopes.x - dot(seen, seen), 0.25 * ocean.slopes.x) + 1e-5;
    vec3 normal = normalize(water.up - slope.x * ocean.nadir_east.xyz - slope.y * ocean.nadir_north.xyz);

    float day = dimmed(ocean.sun.w);
    float facing = dot(normal, to_eye);
    // Waves that turn away are hidden by those that do not: at grazing angles a rough sea is steeper than its mean.
    float steepness = max(max(facing, flat_facing * 0.5), 0.0) + 0.45 * sqrt(rough);
    float mirrored = 0.02 + 0.98 * power_5(1.0 - min(steepness, 1.0));

    vec3 body = water.body.rgb;
#ifdef SHORE
    vec3 bed = kSand;
    float depth = depth_at(grid, cell, apart, place);
#ifdef BED
    vec4 ground = at_place(posts, place);
    ground /= max(ground.a, 1e-3);
    bed *= clamp(0.75 + 0.75 * (ground.y - ground.x), 0.3, 1.3);  // light from the north-west, as on the land
#endif
    depth += water.wave.z;
    body = water_over(bed, depth, flat_facing);
#endif
    vec3 mirror = reflect(-to_eye, normal);
    vec3 shown = mix(body * day, sky_in(mirror, abs(dot(mirror, water.up))), mirrored);

    // The sun: the share of facets that throw it here (Cox and Munk).
    vec3 sun = ocean.sun.xyz;
    vec3 facet = normalize(sun + to_eye);
    float steep2 = max(dot(facet, normal), 0.03);
    steep2 *= steep2;
    float glitter = exp((1.0 - 1.0 / steep2) / rough) / (rough * 4.0 * steep2 * steep2);
    float shine = 0.02 + 0.98 * power_5(1.0 - max(dot(facet, to_eye), 0.0));
    shown += vec3(1.0, 0.95, 0.85) * (0.32 * glitter * shine / max(steepness, 0.1) * ocean.sun.w);

#ifdef SHORE
    // Foam at the waterline, more of it the rougher the sea.
    float band = 0.1 + 8.0 * ocean.slopes.x;
    float foam = min(12.0 * ocean.slopes.x, 0.6) * (1.0 - smoothstep(0.0, band, max(depth, 0.0))) * smoothstep(-0.05, 0.10, slope.x + slope.y);
    shown = mix(shown, kFoam * day, foam);
#endif
    // From below: a window of sky above the eye, around it the deep.
    if (flat_facing < 0.0 && ocean.nadir_up.w < water.wave.z)
        shown = mix(kDeep * 1.6, kZenithColour, -flat_facing * flat_facing * flat_facing) * day;
#ifdef OVERLAYS
    float bright = brightness(body) * day;  // without what glitters on it
#ifdef GRATICULE
    GraticulePlace graticule = graticule_at(water.from_anchor);
#ifdef POLE
    if (GRATICULE.y > 0.0)
        graticule.value = polar_graticule_at(frame.place.xy + water.grid.yx * frame.place.zw, GRATICULE.yz);
#endif
    graticule.slopes = graticule_slopes(graticule.value);
#endif
#ifdef DRAPES
    vec4 grid_steps = vec4(dFdx(water.grid), dFdy(water.grid));
    // What is draped ends with the data.
    vec2 beyond = abs(turned(water.grid) - grid);
    float inside_data = max(beyond.x, beyond.y) > 0.0 ? 0.0 : 1.0;
#define OVERLAY_GRID grid
#define OVERLAY_SHARE inside_data
#endif
    OVERLAYS
#endif
#ifdef SKY
    shown = mix(shown, air_in(water.offset), water.body.a);
#endif
    colour = vec4(min(shown, vec3(1.0)), 1.0);
#endif
#ifdef SHORE
    // A little more than the ground leaves.
    bool is_land = water_at(place) < -0.1;
#ifdef FILL
    // What neither has drawn. But beyond the data there is no ground, and voids stay empty.
    vec2 away = abs(turned(water.grid) - grid);
    is_land = is_land && max(away.x, away.y) > 0.0;
#ifdef VOIDS
    if (!is_whole(cell, apart)) discard;
#endif
#endif
    if (is_land) discard;
#endif
}
