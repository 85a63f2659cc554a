// The natural ground: what it is made of, and how that looks.
layout(binding = 8) uniform sampler2DArray materials;  // grass, rock, gravel, snow; grain (viewer/ground/ground_materials.hpp)
#ifdef GROUND_MAP
layout(binding = 9) uniform sampler2D ground_map;  // the user's parts of grass, rock, gravel and snow (ground_map.hpp)

// `apart`: posts a pixel.
vec4 mapped_weights(vec2 grid, float apart) {
    vec2 posts_across = frame.grid.xy + 1.0;
    float texels = apart * float(textureSize(ground_map, 0).x) / posts_across.x;
    return textureLod(ground_map, (grid + 0.5) / posts_across, rough_log2(texels));
}
#endif

// Parts of grass, rock, gravel and snow. They are 1 together. Degrees; metres; the part of sea in the ground around.
vec4 cover_weights(float slope, float H, float sea, float snow_line) {
    float snow = smoothstep(-250.0, 250.0, H - snow_line) * (1.0 - smoothstep(42.0, 58.0, slope));
    float rock = smoothstep(26.0, 38.0, slope);
    float scree = smoothstep(0.62, 0.90, H / max(snow_line, 1.0));
    float beach = smoothstep(0.0, 0.15, sea) * (1.0 - smoothstep(4.0, 12.0, H));
    float bare = max(scree, beach);
    return vec4(vec3((1.0 - rock) * (1.0 - bare), rock, (1.0 - rock) * bare) * (1.0 - snow), snow);
}

float largest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

vec2 in_tile(vec4 tile, vec2 at) { return tile.xy + mat2(tile.z, -tile.w, tile.w, tile.z) * at; }

// Slopes of a tile, -1 to 1, along the row and up the column.
vec2 slopes_of(vec4 texel, vec4 tile, float tile_m) {
    return ((texel.zw * 2.0 - 1.0) * mat2(tile.z, -tile.w, tile.w, tile.z)) * tile_m;
}

// There are no stones of ten metres in gravel: in large tiles it is as uneven as any ground.
vec2 layers_of(vec2 layers, int rung) {
    return rung > 1 ? mix(layers, vec2(4.0), equal(layers, vec2(2.0))) : layers;
}

struct CoverLook {
    vec3 colour;
    vec2 slope;  // of what the data does not tell
    float snow;  // part of it
};

// Metres from the anchor; how many of them a pixel is; all that cover_weights asks for; weights that the user gives, of
// which less than 1 leaves the rest to those.
CoverLook cover_at(vec2 at, float pixel, float slope, float H, float sea, float snow_line, vec4 given) {
    // A landscape varies over hundreds of metres, in two ways that have nothing to do with each other.
    float macro_lod = rough_log2(pixel * (256.0 * length(cover.macro.zw)));
    vec2 macro = textureLod(materials, vec3(in_tile(cover.macro, at), 4.0), macro_lod).rg - 0.5;
    vec4 weights = cover_weights(slope + 14.0 * macro.x, H + 500.0 * macro.y, sea, snow_line);
#ifdef GROUND_MAP
    weights = given + max(1.0 - dot(given, vec4(1.0)), 0.0) * weights;
#endif

    // The two materials that there is most of are shown with their texture. Less what there is of the third: so none of
    // them appears at once.
    weights += vec4(0.0, 1e-5, 2e-5, 3e-5);  // no two are equal
    float most = largest(weights);
    vec4 first = vec4(equal(weights, vec4(most)));
    vec4 others = weights * (1.0 - first);
    float next = largest(others);
    vec4 second = vec4(equal(others, vec4(next)));
    float third = largest(others * (1.0 - second));
    float of_both = most + next - 2.0 * third;
    float part = (next - third) / of_both;
    vec2 layers = vec2(dot(first.yzw, vec3(1.0, 2.0, 3.0)), dot(second.yzw, vec3(1.0, 2.0, 3.0)));

    // The two rungs whose texels are about a pixel. Their variances add, for they have nothing to do with each other.
    float height = clamp(rough_log2(pixel * (220.0 / kFinestTile)) / 2.585, 0.0, float(kRungs) - 1.001);
    int rung = int(height);
    float coarser = smoothstep(0.0, 0.85, height - float(rung));
    vec2 shares = vec2(1.0 - coarser, coarser) * inversesqrt(1.0 - 2.0 * coarser * (1.0 - coarser));
    vec4 fine_tile = cover.rungs[rung];
    vec4 coarse_tile = cover.rungs[rung + 1];
    float fine_lod = rough_log2(pixel * 256.0 / cover.bumps[rung].y);
    float coarse_lod = fine_lod - 2.585;
    vec2 fine_at = in_tile(fine_tile, at);
    vec2 coarse_at = in_tile(coarse_tile, at);
    vec2 fine_layers = layers_of(layers, rung);
    vec2 coarse_layers = layers_of(layers, rung + 1);
    vec4 a_fine = textureLod(materials, vec3(fine_at, fine_layers.x), fine_lod);
    vec4 a_coarse = textureLod(materials, vec3(coarse_at, coarse_layers.x), coarse_lod);
    vec4 b_fine = textureLod(materials, vec3(fine_at, fine_layers.y), fine_lod);
    vec4 b_coarse = textureLod(materials, vec3(coarse_at, coarse_layers.y), coarse_lod);
    vec2 a = (a_fine.xy - 0.5) * shares.x + (a_coarse.xy - 0.5) * shares.y;
    vec2 b = (b_fine.xy - 0.5) * shares.x + (b_coarse.xy - 0.5) * shares.y;
    // Where two materials meet, what is light, for it lies on top, is seen more of. All of them count for the colour:
    // where there is as much of three, the choice of two turns around a point.
    float moved = clamp(part + 6.0 * part * (1.0 - part) * (b.x - a.x), 0.0, 1.0) - part;
    part += moved;
    vec4 seen = weights + (second - first) * (moved * of_both);

    // Each material's two colours. Grass dries with height and, here and there, for other reasons; shores are of sand.
    float dry = clamp(1.1 * H / max(snow_line, 1.0) - 0.05 + 0.9 * macro.x, 0.0, 1.0);
    float sandy = smoothstep(0.0, 0.1, sea) * (1.0 - smoothstep(4.0, 40.0, H));
    mat4x3 darker = mat4x3(mix(vec3(0.175, 0.225, 0.105), vec3(0.390, 0.350, 0.205), dry),
                           vec3(0.330, 0.305, 0.280),
                           mix(vec3(0.375, 0.350, 0.315), vec3(0.690, 0.610, 0.460), sandy),
                           vec3(0.760, 0.810, 0.880));
    mat4x3 lighter = mat4x3(mix(vec3(0.335, 0.370, 0.175), vec3(0.560, 0.500, 0.310), dry),
                            vec3(0.500, 0.465, 0.425),
                            mix(vec3(0.530, 0.500, 0.455), vec3(0.800, 0.730, 0.580), sandy),
                            vec3(0.900, 0.920, 0.950));
    const vec4 contrasts = vec4(1.10, 0.95, 0.85, 0.18);
    const vec4 steepness = vec4(0.45, 0.75, 0.60, 0.22);
    float mixed = clamp(0.5 + 1.5 * mix(a.y, b.y, part) + 0.7 * macro.y, 0.0, 1.0);
    vec3 colour = mix(darker * seen, lighter * seen, mixed);
    colour *= 1.0 + mix(dot(contrasts, first) * a.x, dot(contrasts, second) * b.x, part);

    vec2 bumps = vec2(cover.bumps[rung].x, cover.bumps[rung + 1].x) * shares;
    vec2 steep = vec2(dot(steepness, first) * (1.0 - part), dot(steepness, second) * part);
    vec2 slopes = slopes_of(a_fine * steep.x + b_fine * steep.y + 0.5 * (1.0 - steep.x - steep.y), fine_tile, cover.bumps[rung].y) * bumps.x +
                  slopes_of(a_coarse * steep.x + b_coarse * steep.y + 0.5 * (1.0 - steep.x - steep.y), coarse_tile, cover.bumps[rung + 1].y) * bumps.y;

    // The detail, where a pixel is smaller than what the lowest rung shows.
    float near = 1.0 - smoothstep(0.003, 0.016, pixel);
    vec4 grain = textureLod(materials, vec3(in_tile(cover.grain, at), 4.0), rough_log2(pixel * (256.0 / kGrainTile)));
    float roughness = near * (1.0 - 0.7 * seen.w);
    colour *= 1.0 + 0.9 * roughness * (grain.x - 0.5);
    slopes += slopes_of(grain, cover.grain, kGrainTile) * (0.55 * roughness);
    return CoverLook(colour, slopes, seen.w);
}

// What is lighter than a picture can be still shows its shape.
vec3 softened(vec3 colour) {
    const float knee = 0.6;
    vec3 above = max(colour - knee, 0.0) / (1.0 - knee);
    return min(colour, vec3(knee)) + (1.0 - knee) * (1.0 - exp(-above));
}

// Water where no sea is drawn: what comes out of it, and some of the sky on it.
vec3 water_colour(float H, float s) {
    vec3 body = mix(vec3(0.115, 0.265, 0.290), vec3(0.035, 0.115, 0.185), 1.0 - exp(min(H, 0.0) / 25.0));
    vec3 light = sunlight(s) * max(s, 0.0) + skylight(s) + 0.5 * moonlight(s);
    return body * light + 0.22 * mix(air_colour(s, 0.5), zenith_colour(s), 0.6);
}
