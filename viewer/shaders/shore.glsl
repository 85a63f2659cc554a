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
    float share = at_place(sea, at).r;
    float reach = share - 0.02;
    vec4 is_land = vec4(lessThan(textureGather(sea, at.fine, 0), vec4(0.5)));
    vec4 is_low = vec4(lessThan(textureGather(posts, at.fine, 2), vec4((0.3 - SCENE_MIDDLE) / SCENE_HALF)));
    if (dot(is_land, is_low) > 0.0) reach = share - 0.5;
    return min(reach, 0.3 - ground_height(at));
}
