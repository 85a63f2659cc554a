// Radial grid (lod/ocean/radial_grid.hpp).
layout(std140, binding = 2) uniform Mesh {
    vec4 shape;        // M, k, a0
    vec4 blocks[255];  // of their first rings the radius, the spacing; how radii grow: RadialRings::Growth
} mesh;

layout(location = 0) in ivec2 corner;  // ring (-1: the nadir), sector
layout(location = 1) in vec4 copy;     // block of rings, first sector

const float kRings = 16.0;  // of a block

float radius_between(float inner, float outer, float growth, float part) {
    if (growth > 1.5) return mix(inner, outer, part);
    if (growth > 0.5) return inner * exp(log(outer / inner) * part);
    float k = mesh.shape.y;
    float a0 = mesh.shape.z;
    return a0 + pow(mix(pow(inner - a0, 1.0 / k), pow(outer - a0, 1.0 / k), part), k);
}

vec3 place() {
    int block = int(copy.x);
    vec3 inner = mesh.blocks[block].xyz;
    vec2 outer = mesh.blocks[block + 1].xy;
    if (corner.x < 0) return vec3(0.0, 0.0, inner.y);
    float sector = copy.y + float(corner.y);
    if (sector >= mesh.shape.x) sector -= mesh.shape.x;  // the seam
    // The first and the last ring are neighbouring blocks' too: the same to the last bit.
    float part = float(corner.x) / kRings;
    float radius = part <= 0.0 ? inner.x : part >= 1.0 ? outer.x : radius_between(inner.x, outer.x, inner.z, part);
    float angle = 6.28318530718 * sector / mesh.shape.x;
    return vec3(radius * vec2(cos(angle), sin(angle)), part <= 0.0 ? inner.y : part >= 1.0 ? outer.y : mix(inner.y, outer.y, part));
}
