// Radial grid (lod/ocean/radial_grid.hpp).
layout(std140, binding = 2) uniform Mesh { vec4 shape; } mesh;  // a0, a1, k, sectors

layout(location = 0) in ivec2 corner;  // ring (-1: the nadir), sector
layout(location = 1) in vec4 copy;     // first ring, first sector

float radius_of(float ring) { return mesh.shape.x + mesh.shape.y * pow(ring, mesh.shape.z); }

vec3 place() {
    const float turn = 6.28318530718;
    float ring = copy.x + float(corner.x);
    if (corner.x < 0) return vec3(0.0, 0.0, mesh.shape.x);
    float sector = copy.y + float(corner.y);
    if (sector >= mesh.shape.w) sector -= mesh.shape.w;  // the seam
    float radius = radius_of(ring);
    float beyond = radius_of(ring + 1.0);
    float angle = turn * sector / mesh.shape.w;
    return vec3(radius * vec2(cos(angle), sin(angle)), max(beyond - radius, turn * beyond / mesh.shape.w));
}
