// Projected grid (lod/ocean/projected_grid.hpp; `place` there says what is worked out here).
layout(std140, binding = 2) uniform Mesh {
    vec4 d0;    // w: sin^2 of the dip
    vec4 du;    // w: radius
    vec4 dv;    // w: reach
    vec4 cell;  // lengths of du and dv over a cell, height of the projector, 1 / cells
} mesh;

layout(location = 0) in ivec2 corner;

vec3 place() {
    vec2 part = vec2(corner) * mesh.cell.w;
    vec3 way = mesh.d0.xyz + part.x * mesh.du.xyz + part.y * mesh.dv.xyz;
    float radius = mesh.du.w;
    float toward = mesh.cell.z < 0.0 ? way.z : -way.z;
    float discriminant = toward * toward - mesh.d0.w * dot(way, way);
    float level = length(way.xy);
    float arc = mesh.dv.w;
    float spacing = arc;
    if (toward > 0.0 && discriminant >= 0.0) {
        float root = sqrt(discriminant);
        float tau = abs(mesh.d0.w) / (toward + root);
        arc = min(radius * atan(tau * level, 1.0 + tau * way.z), mesh.dv.w);
        // A cell across the ray and, along it, over the sine of its angle with the sea.
        spacing = (radius + mesh.cell.z) * tau * max(mesh.cell.x, mesh.cell.y * length(way) / max(root, 1e-6));
    }
    vec2 at = level > 0.0 ? way.xy * (arc / level) : vec2(0.0);
    return vec3(at, min(spacing, mesh.dv.w));
}
