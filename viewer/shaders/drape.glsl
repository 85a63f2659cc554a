// What is draped over the ground: pages as the ground's (ground.glsl), of a grid that may be finer than it. DRAPES is the
// number of them; two units each.
layout(binding = 10) uniform sampler2DArray drape_0;
layout(binding = 11) uniform usamplerBuffer drape_table_0;
#if DRAPES > 1
layout(binding = 12) uniform sampler2DArray drape_1;
layout(binding = 13) uniform usamplerBuffer drape_table_1;
#endif
#if DRAPES > 2
layout(binding = 14) uniform sampler2DArray drape_2;
layout(binding = 15) uniform usamplerBuffer drape_table_2;
#endif
#if DRAPES > 3
layout(binding = 16) uniform sampler2DArray drape_3;
layout(binding = 17) uniform usamplerBuffer drape_table_3;
#endif

struct DrapePlace {
    vec2 texel;      // on the fine page
    vec2 in_parent;  // likewise on the coarse one
    uint entry;
    float level;     // of the fine page
    float wanted;
};

// Of `drawn` the level of the coarsest page and how many times finer than the ground's the grid is.
DrapePlace drape_place(usamplerBuffer table, vec4 drawn, vec2 grid, float apart) {
    int top = int(drawn.y);
    vec2 place = grid * drawn.z;
    ivec2 cell = clamp(ivec2(place), ivec2(0), max(ivec2(frame.grid.xy * drawn.z) - 1, ivec2(0)));
    DrapePlace found;
    found.wanted = rough_log2(apart * drawn.z) + kSharper;
    int whole = int(clamp(found.wanted, 0.0, float(top)));
    int below_top = top - whole;
    ivec2 page = cell >> (whole + 8);
    int first = (1 << 2 * below_top) - 1 & 0x55555555;
    found.entry = texelFetch(table, first + (page.y << below_top) + page.x).r;
    uint level = found.entry >> 24;
    found.level = float(level);
    found.texel = place * uintBitsToFloat((127u - level) << 23) - vec2((cell >> level) & ~255);
    found.in_parent = 0.5 * found.texel + vec2(((cell >> level) & 256) / 2);
    return found;
}

vec4 drape_at(sampler2DArray pages, usamplerBuffer table, vec4 drawn, vec2 grid, float apart) {
    DrapePlace place = drape_place(table, drawn, grid, apart);
    vec4 fine = textureLod(pages, vec3((place.texel + 0.5) / 257.0, float(place.entry & 4095u)), 0.0);
    vec4 coarse = textureLod(pages, vec3((place.in_parent + 0.5) / 257.0, float(place.entry >> 12 & 4095u)), 0.0);
    return mix(fine, coarse, clamp(min(place.wanted, drawn.y) - place.level, 0.0, 1.0));
}

// Half the width of a line, the radius of a point, and the width of their rims, pixels of a window.
const vec3 kLineShape = vec3(1.6, 4.5, 1.2);

// Lines and points as wide in the picture however the ground lies. Texels tell where they are (ingest/vector_file.hpp):
// each its own nearest line, which goes on straight as far as the texel reaches.
vec4 lines_at_place(sampler2DArray pages, usamplerBuffer table, vec4 drawn, vec2 grid, vec4 steps, float apart) {
    DrapePlace place = drape_place(table, drawn, grid, apart);
    // Where a pixel is more than a texel and a half, that of the coarser page is enough, and reaches farther.
    bool coarser = place.wanted > place.level && place.level < drawn.y;
    vec2 at = coarser ? place.in_parent : place.texel;
    int layer = int(coarser ? place.entry >> 12 & 4095u : place.entry & 4095u);
    steps *= drawn.z * exp2(-place.level - (coarser ? 1.0 : 0.0));
    float turned = steps.x * steps.w - steps.y * steps.z;
    turned = abs(turned) < 1e-9 ? 1e-9 : turned;
    vec3 shape = kLineShape * overlays.shape.x;
    vec2 base = clamp(floor(at), vec2(0.0), vec2(255.0));
    vec2 part = at - base;
    vec2 covered = vec2(0.0);  // by colour, and by it and the rim
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(float(i & 1), float(i >> 1));
        vec4 code = texelFetch(pages, ivec3(ivec2(base + corner), layer), 0) * 255.0;
        vec2 from = part - corner;
        float angle = code.x * (3.14159265 / 256.0);
        vec2 across = vec2(cos(angle), sin(angle));
        float off = abs((code.y - 128.0) / 16.0 - dot(from, across));
        float line_px = off / max(length(vec2(dot(across, steps.xy), dot(across, steps.zw))), 1e-6) - shape.x;
        vec2 to_point = (code.zw - 128.0) / 8.0 - from;
        vec2 in_pixels = vec2(steps.w * to_point.x - steps.z * to_point.y, steps.x * to_point.y - steps.y * to_point.x) / turned;
        float point_px = length(in_pixels) - shape.y;
        float edge = min(code.y > 0.5 ? line_px : 1e3, code.w > 0.5 ? point_px : 1e3);
        vec2 share = mix(1.0 - part, part, corner);
        covered += share.x * share.y * clamp(0.5 - vec2(edge, edge - shape.z), 0.0, 1.0);
    }
    vec3 colour = floor(mod(drawn.w / vec3(65536.0, 256.0, 1.0), 256.0)) / 255.0;
    float alpha = max(covered.x, 0.8 * covered.y);
    return vec4(covered.x * colour + vec3(alpha - covered.x), alpha);
}

vec3 with_drape(vec3 ground, vec4 drawn, vec4 drape) { return ground * (1.0 - drawn.x * drape.a) + drawn.x * drape.rgb; }
