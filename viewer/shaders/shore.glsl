// Where there is water instead of ground, as the data says, and not as meshes happen to cross: both the ground's and the
// water's shader ask here, about the same texels.

// Height of the ground, metres.
float ground_height(PagePlace at) {
    vec4 here = at_place(posts, at);
    return here.z / max(here.a, 1e-3) * SCENE_HALF + SCENE_MIDDLE;
}

// Above 0 in water, below 0 on land; some 0.1 at either side of the waterline. Where the land around is above the sea
// the waterline is where the ground rises above it. Land that is not, a polder, is dry to half way to the next post of
// sea.
float water_at(PagePlace at) {
    vec2 sea_and_low = at_place(shore, at).rg;
    float reach = sea_and_low.r - (sea_and_low.g > 0.0 ? 0.5 : 0.02);
    return min(reach, 0.3 - ground_height(at));
}
