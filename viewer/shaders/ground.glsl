// The ground's pages: of each level of detail squares of 256 cells, as far as the picture wants them. Level k has every
// 2^k-th post; pages share the posts on their borders, so that bilinear filters stay inside one.
layout(binding = 0) uniform sampler2DArray posts;   // normal along row and up column, H (viewer/ground/height_code.hpp), validity; all times it
layout(binding = 1) uniform usampler2DArray cells;  // 0 where a cell has a void corner
layout(binding = 3) uniform sampler2DArray shore;   // 1 at posts that are sea; 1 at land no higher than that
// For each page of each level, from the one of the coarsest, the finest one that is there: its layer in 12 bits, its
// parent's in 12, its level.
layout(binding = 4) uniform usamplerBuffer page_table;

// Ground is seen at an angle: its level is that of its steepest direction, and blurs the other. (Anisotropic filters cost
// sixty times as much in software.)
const float kSharper = -0.8;

// A place in the pages of two levels that are blended.
struct PagePlace {
    vec3 fine;  // as textures take it
    vec3 coarse;
    float blend;
};

// To 0.09, never above: the mantissa stands for its own logarithm.
float rough_log2(float x) { return float(floatBitsToInt(x)) * exp2(-23.0) - 127.0; }

uint page_entry(ivec2 cell, float level) {
    int whole = int(clamp(level, 0.0, float(TOP_LEVEL)));
    ivec2 page = cell >> (whole + 8);
    int below_top = TOP_LEVEL - whole;
    int first = (1 << 2 * below_top) - 1 & 0x55555555;  // 1 + 4 + 16 + ...
    return texelFetch(page_table, first + (page.y << below_top) + page.x).r;
}

ivec2 cell_at(vec2 grid) { return clamp(ivec2(grid), ivec2(0), ivec2(frame.grid.zw)); }

// `apart`: how far the places are from each other, in posts, that are asked for.
PagePlace page_place(vec2 grid, ivec2 cell, float apart) {
    float wanted = rough_log2(apart) + kSharper;
    uint entry = page_entry(cell, wanted);
    uint level = entry >> 24;
    vec2 at = grid * uintBitsToFloat((127u - level) << 23) - vec2((cell >> level) & ~255);
    vec2 in_parent = 0.5 * at + vec2(((cell >> level) & 256) / 2);
    PagePlace place;
    place.fine = vec3((at + 0.5) / 257.0, float(entry & 4095u));
    place.coarse = vec3((in_parent + 0.5) / 257.0, float(entry >> 12 & 4095u));
    place.blend = clamp(min(wanted, float(TOP_LEVEL)) - float(level), 0.0, 1.0);
    return place;
}

vec4 at_place(sampler2DArray pages, PagePlace place) {
    return mix(textureLod(pages, place.fine, 0.0), textureLod(pages, place.coarse, 0.0), place.blend);
}

// May the cell be drawn? Edges of voids are to the pixel in both directions: the level is that of the gentlest.
bool is_whole(ivec2 cell, float apart) {
    uint entry = page_entry(cell, rough_log2(apart) + kSharper);
    return texelFetch(cells, ivec3((cell >> (entry >> 24)) & 255, entry & 4095u), 0).r != 0u;
}
