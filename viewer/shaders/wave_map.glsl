// Waves of a map that repeats, as two copies of it (lod/ocean/wave_map.hpp): in the place of the wind's.
layout(binding = 7) uniform sampler2D wave_map;  // coefficients of cubic B-splines, of each level
layout(std140, binding = 3) uniform WaveMap {
    vec4 origins[2];  // of each copy: where the nadir is in its tile, the tile to 1; posts of the level that a mesh of a
                      // spacing of 1 m carries, in posts of level 0; length of its waves
    vec4 turns[2];    // cosine and sine, clockwise, over the tile's side
}
map;

// Weights of four coefficients for the spline between the middle two, and for its slope, a post to 1.
vec4 spline_weights(float t) {
    float s = 1.0 - t;
    return vec4(s * s * s / 6.0, 2.0 / 3.0 - 0.5 * t * t * (2.0 - t), 2.0 / 3.0 - 0.5 * s * s * (2.0 - s),
                t * t * t / 6.0);
}
vec4 spline_slopes(float t) {
    float s = 1.0 - t;
    return vec4(-0.5 * s * s, t * (1.5 * t - 2.0), s * (2.0 - 1.5 * s), 0.5 * t * t);
}

// Slope, a tile to 1, and height of a level. Bilinear texels would be fewer, but their weights have 8 bits.
vec3 level_at(vec2 place, int level) {
    int side = textureSize(wave_map, 0).x >> level;  // (of `level` llvmpipe would ask for one vertex of eight)
    vec2 post = place * float(side) - 0.5;
    ivec2 first = ivec2(floor(post)) - 1;
    vec2 t = fract(post);
    vec4 across = spline_weights(t.x);
    vec4 slope_across = spline_slopes(t.x);
    vec4 up = spline_weights(t.y);
    vec4 slope_up = spline_slopes(t.y);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 4; ++j) {
        vec4 row;
        for (int i = 0; i < 4; ++i) row[i] = texelFetch(wave_map, (first + ivec2(i, j)) & (side - 1), level).r;
        float line = dot(row, across);
        sum += vec3(up[j] * dot(row, slope_across), slope_up[j] * line, up[j] * line);
    }
    return sum * vec3(vec2(float(side)), 1.0);
}

vec3 copy_at(vec4 origin, vec2 turn, vec2 at, float spacing, float depth) {
    int last = textureQueryLevels(wave_map) - 1;  // is 0
    float octave = log2(max(origin.z * spacing, 1.0));
    int level = int(octave);
    if (level >= last) return vec3(0.0);
    float part = octave - float(level);
    vec2 place = fract(origin.xy + vec2(dot(turn, at), turn.x * at.y - turn.y * at.x));
    vec3 wave = level_at(place, level);
    if (part > 0.0) wave = mix(wave, level + 1 < last ? level_at(place, level + 1) : vec3(0.0), part);
    wave.xy = vec2(turn.x * wave.x - turn.y * wave.y, dot(turn, wave.yx));
    return wave * smoothstep(0.0, 0.5, depth / origin.w);
}

// Slope along the chart's axes and height, of what vertices so far apart carry of the map in water so deep.
vec3 waves_at(vec2 at, float spacing, float depth) {
    return inversesqrt(2.0) * (copy_at(map.origins[0], map.turns[0].xy, at, spacing, depth) +
                               copy_at(map.origins[1], map.turns[1].xy, at, spacing, depth));
}

// Spacing of a mesh whose waves are all that this one has: a map has none of less than 4 of its posts, 4.5 times this.
float carried_spacing(float spacing) { return max(spacing, 1.8 / map.origins[0].z); }
