layout(binding = 2) uniform sampler2D ramp;  // the layer's colours; in a second row those of the sea

#ifdef WIREFRAME
in WiredSurface {
#else
in Surface {
#endif
    vec2 grid;
    float haze;
    flat float level;
#ifdef SUN_FIXED
    vec3 sun;
#endif
#ifdef GRATICULE
    vec2 from_anchor;
#endif
#ifdef COVER
    vec4 cover;
#endif
#ifdef WIREFRAME
    vec3 barycentric;
#endif
}
surface;

out vec4 colour;

// The ramp's first and last texels are its ends.
vec3 ramp_colour(float at, float row) {
    float texels = float(textureSize(ramp, 0).x);
    return texture(ramp, vec2((clamp(at, 0.0, 1.0) * (texels - 1.0) + 0.5) / texels, 0.25 + 0.5 * row)).rgb;
}

// From the data's lowest to its highest, 0 to 1.
float height_of(vec4 post) { return (post.z * SCENE_HALF + (SCENE_MIDDLE - SCENE_LOWEST)) / SCENE_RANGE; }

// Coarse to fine: a polynomial fit of the Turbo colour map (A. Mikhailov, Google, 2019). Most of what is seen is fine:
// the power gives its levels more of the colours.
vec3 level_colour(float level) {
    float x = pow(clamp(level / (2.0 * frame.surface.y), 0.0, 1.0), 2.5);
    vec4 v4 = vec4(1.0, x, x * x, x * x * x);
    vec2 v2 = v4.zw * v4.z;
    vec3 mapped = vec3(dot(v4, vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234)) +
                           dot(v2, vec2(-152.94239396, 59.28637943)),
                       dot(v4, vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333)) +
                           dot(v2, vec2(4.27729857, 2.82956604)),
                       dot(v4, vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771)) +
                           dot(v2, vec2(-89.90310912, 27.34824973)));
    return clamp(mapped, 0.0, 1.0);
}

#ifdef WIREFRAME
// 1 on an edge of the triangle, 0 half a line's width beside it.
float on_edge(vec3 barycentric) {
    vec3 across = dFdx(barycentric);
    vec3 along = dFdy(barycentric);
    vec3 pixels = barycentric / max(sqrt(across * across + along * along), vec3(1e-6));
    return 1.0 - smoothstep(0.35, 1.05, min(pixels.x, min(pixels.y, pixels.z)));
}
#endif

// How light makes the shape seen (viewer/shading.hpp): 0 to 1.
#ifdef FOUR_LIGHTS
float lit_by(vec3 normal, vec3 sun) {
    vec2 ahead = sun.xy;  // of the lights: the sun's own, that 90 degrees to its left, those half a turn of it beside the sun
    vec2 left = vec2(-sun.y, sun.x);
    mat4x2 lights = mat4x2(ahead, left, (ahead - left) * 0.70710678, (ahead + left) * 0.70710678);
    // cos^2 or sin^2 of the angle between the fall of the ground and each light: of all four 2 together, but for flat ground.
#ifdef OBLIQUE
    vec2 fall = vec2(-normal.y, normal.x);
#else
    vec2 fall = normal.xy;
#endif
    vec4 along = fall * lights;
    vec4 weights = along * along / max(dot(fall, fall) * dot(ahead, ahead), 1e-12);
    weights += 0.5 * max(1.0 - 0.5 * dot(weights, vec4(1.0)), 0.0);
    return 0.5 * dot(weights, max(normal.xy * lights + normal.z * sun.z, 0.0));
}
#elif defined(COMBINED)
float lit_by(vec3 normal, vec3 sun) {
    float slope = acos(clamp(normal.z, 0.0, 1.0));
    return max(1.0 - acos(clamp(dot(normal, sun), -1.0, 1.0)) * slope / 2.4674011, 0.0);
}
#else
float lit_by(vec3 normal, vec3 sun) { return max(dot(normal, sun), 0.0); }
#endif

#define OVERLAY_GRID surface.grid
#define OVERLAY_SHARE 1.0

void main() {
    // All that needs the neighbours' values comes before the discard.
    vec2 x = abs(dFdx(surface.grid));
    vec2 y = abs(dFdy(surface.grid));
    ivec2 cell = cell_at(surface.grid);
    float apart = max(max(x.x, y.x), max(x.y, y.y));
    PagePlace place = page_place(surface.grid, cell, apart);
#if defined(TINTED_SEA) || defined(SHORE) || defined(DRY_LINES)
    float share = at_place(shore, place).r;
#endif
#if defined(TINTED_SEA) || defined(DRY_LINES)
    // The waterline is half way between a post of land and one of sea, and a pixel wide.
    float water = smoothstep(-0.7, 0.7, (share - 0.5) / max(fwidth(share), 1e-4));
#endif
    vec4 here = at_place(posts, place);
#ifdef CONTOURS
    // Of texels and not metres: a float has no more than 24 bits, and heights of mountains leave few for centimetres.
    float height = here.z / max(here.a, 1e-3);
    float height_slope = slope_of(height);
#endif
#ifdef DRAPES
    vec4 grid_steps = vec4(dFdx(surface.grid), dFdy(surface.grid));
#endif
#ifdef GRATICULE
    GraticulePlace graticule = graticule_at(surface.from_anchor);
#ifdef POLE
    if (GRATICULE.y > 0.0)
        graticule.value = polar_graticule_at(frame.place.xy + surface.grid.yx * frame.place.zw, GRATICULE.yz);
#endif
    graticule.slopes = graticule_slopes(graticule.value);
#endif
#ifdef VOIDS
    if (!is_whole(cell, min(max(x.x, x.y), max(y.x, y.y)))) discard;
    here /= max(here.a, 1e-3);
#endif
#ifdef OCEAN
    if (water_at(place) > 0.1) discard;
#endif
    vec3 true_normal = vec3(here.xy, sqrt(max(1.0 - dot(here.xy, here.xy), 1e-6)));
    vec3 normal = normalize(vec3(true_normal.xy * frame.surface.x, true_normal.z));
#ifdef SUN_FIXED
    vec3 sun = normalize(surface.sun);
    float day = dimmed(smoothstep(-0.10, 0.15, sun.z));
#else
    vec3 sun = frame.sun.xyz;
    float day = dimmed(frame.sun.w);
#endif
    float lit = lit_by(normal, sun);
#ifdef COMBINED
    lit *= day;
    float relief = 0.28 * day + 0.69 * lit;  // flat ground is as light as under one light
#else
    float relief = (0.32 + 0.12 * normal.z) * day + 0.75 * lit;
#endif

#if LAYER == 0  // hypsometric
#ifdef TINTED_SEA
    vec3 tint = mix(ramp_colour(height_of(here), 0.0), ramp_colour(height_of(here), 1.0), water);
#else
    vec3 tint = ramp_colour(height_of(here), 0.0);
#endif
    vec3 shown = tint * relief;
    float hazed = surface.haze;
#elif LAYER == 1  // hillshade
    vec3 shown = vec3(0.06 * day + 0.94 * lit);
    float hazed = surface.haze;
#elif LAYER == 2  // slope: of the true ground, whatever the exaggeration; its colours are values and take no haze
    float slope = degrees(acos(clamp(true_normal.z, 0.0, 1.0)));
    vec3 shown = ramp_colour(slope / 60.0, 0.0);
    float hazed = 0.0;
#elif LAYER == 3  // lod
    vec3 shown = mix(vec3(0.5), level_colour(surface.level), 0.75) * (0.35 + 0.65 * relief);
    float hazed = 0.0;
#elif LAYER == 6  // aspect: of the true ground, from north over east; flat ground has none
    float azimuth = atan(true_normal.x, true_normal.y);
#ifdef POLE
    vec2 in_plane = frame.place.xy + surface.grid.yx * frame.place.zw;
    azimuth += POLE * atan(in_plane.y, in_plane.x);
#endif
    float flatness = 1.0 - smoothstep(0.5, 2.0, degrees(acos(clamp(true_normal.z, 0.0, 1.0))));
    vec3 shown = mix(ramp_colour(fract(azimuth / 6.2831853), 0.0), vec3(0.80), flatness);
    float hazed = 0.0;
#elif defined(COVER)
    // Along the ground pixels are long. By their length all would be blurred, by their width it would flicker. Nor may
    // one on a sliver that is edge-on count as narrow.
    vec2 along = dFdx(surface.cover.xy);
    vec2 across = dFdy(surface.cover.xy);
    vec2 pixel = vec2(dot(along, along), dot(across, across));
    float longest = max(max(pixel.x, pixel.y), 1e-12);
    float size = exp2(0.29 * rough_log2(longest) + 0.21 * rough_log2(max(min(pixel.x, pixel.y), longest / 300.0)));
    float H = here.z * SCENE_HALF + SCENE_MIDDLE;
#ifdef SHORE
    float sea = share;
#else
    const float sea = 0.0;
#endif
    float slope = degrees(acos(clamp(true_normal.z, 0.0, 1.0)));
#ifdef GROUND_MAP
    vec4 given = mapped_weights(surface.grid, apart);
#else
    const vec4 given = vec4(0.0);
#endif
    CoverLook ground = cover_at(surface.cover.xy, size, slope, H, sea, surface.cover.z, given);
    vec3 bumpy = normalize(vec3(normal.xy - ground.slope * normal.z, normal.z));
    // Bumps face the sun on slopes that turn away from it, too, but lie in their shadow.
    float sunny = max(dot(bumpy, sun), 0.0) * smoothstep(-0.02, 0.15, lit);
    vec3 moon = normalize(vec3(-sun.xy, 0.9));
    vec3 light = sunlight(sun.z) * sunny + skylight(sun.z) * (0.62 + 0.38 * bumpy.z) +
                 moonlight(sun.z) * max(dot(bumpy, moon), 0.0);
    vec3 shown = softened(ground.colour * light);
#ifdef TINTED_SEA
    shown = mix(shown, water_colour(H, sun.z), water);
#endif
    float hazed = surface.haze;
#endif
#ifdef OVERLAYS
#ifdef DRY_LINES
    float dry = 1.0 - water;
#else
    const float dry = 1.0;
#endif
#ifdef COVER
    float bright = 0.2 + 0.6 * ground.snow * day;
#else
    float bright = brightness(shown);
#endif
    OVERLAYS
#endif
    // The ground from below. Only where the eye can be there: seen from above, a sliver on a ridge may turn its back by
    // rounding.
    if (!gl_FrontFacing && frame.surface.w > 0.5) shown = vec3(0.20, 0.17, 0.15) * (0.5 + 0.5 * relief);
#ifdef WIREFRAME
    vec3 line = level_colour(surface.level);
    shown = mix(shown, line, 0.85 * on_edge(surface.barycentric));
    hazed *= 0.5;
#endif
#ifdef SKY
#ifdef COVER
    shown = mix(shown, air_colour(sun.z, surface.cover.w), hazed);
#else
    shown = mix(shown, kHazeColour * day, hazed);
#endif
#endif
#ifdef PROBE
    colour = vec4(0.0, 0.0, 0.0, 1.0);
#else
    colour = vec4(min(shown, vec3(1.0)), 1.0);
#endif
}
