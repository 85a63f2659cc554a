// Geoclipmap (lod/ocean/geoclipmap.hpp). Four vectors a ring: spacing, origin, the next ring's spacing; the next ring's
// origin, what its vertices are off whole numbers, its spacing over this one's; distances between which vertices move
// to the next ring's; distances between which the spacing that counts grows, and from what to what.
layout(std140, binding = 2) uniform Mesh { vec4 rings[256]; } mesh;

layout(location = 0) in ivec2 corner;
layout(location = 1) in vec4 copy;  // first column and row in the ring's lattice, ring

vec3 place() {
    int ring = 4 * int(copy.z);
    vec4 own = mesh.rings[ring];
    vec4 next = mesh.rings[ring + 1];
    vec4 move = mesh.rings[ring + 2];
    vec4 grow = mesh.rings[ring + 3];
    vec2 post = copy.xy + vec2(corner);
    vec2 fine = own.x * post + own.yz;
    vec2 coarse = own.w * (floor(post / next.w + next.z + 0.5) - next.z) + next.xy;
    float away = max(abs(fine.x), abs(fine.y));
    float moved = clamp((away - move.x) / (move.y - move.x), 0.0, 1.0);
    // Where it has arrived it is the same number as the next ring's own vertex.
    vec2 at = moved < 1.0 ? mix(fine, coarse, moved) : coarse;
    return vec3(at, mix(grow.z, grow.w, clamp((away - grow.x) / (grow.y - grow.x), 0.0, 1.0)));
}
