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

// The pages, the level of the one that is the coarsest, how many times finer their grid is, and whether they hold lines,
// which are never blended with coarser ones.
vec4 drape_at(sampler2DArray pages, usamplerBuffer table, vec4 drawn, vec2 grid, float apart) {
    int top = int(drawn.y);
    vec2 place = grid * drawn.z;
    ivec2 cell = clamp(ivec2(place), ivec2(0), max(ivec2(frame.grid.xy * drawn.z) - 1, ivec2(0)));
    float wanted = rough_log2(apart * drawn.z) + kSharper;
    int whole = int(clamp(wanted, 0.0, float(top)));
    int below_top = top - whole;
    ivec2 page = cell >> (whole + 8);
    int first = (1 << 2 * below_top) - 1 & 0x55555555;
    uint entry = texelFetch(table, first + (page.y << below_top) + page.x).r;
    uint level = entry >> 24;
    vec2 at = place * uintBitsToFloat((127u - level) << 23) - vec2((cell >> level) & ~255);
    vec4 fine = textureLod(pages, vec3((at + 0.5) / 257.0, float(entry & 4095u)), 0.0);
    if (drawn.w > 0.0) return fine;
    vec2 in_parent = 0.5 * at + vec2(((cell >> level) & 256) / 2);
    vec4 coarse = textureLod(pages, vec3((in_parent + 0.5) / 257.0, float(entry >> 12 & 4095u)), 0.0);
    return mix(fine, coarse, clamp(min(wanted, float(top)) - float(level), 0.0, 1.0));
}

vec3 with_drape(vec3 ground, vec4 drawn, vec4 drape) { return ground * (1.0 - drawn.x * drape.a) + drawn.x * drape.rgb; }
