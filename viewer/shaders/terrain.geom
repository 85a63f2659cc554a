// Only for the wireframe: hands each corner its barycentric coordinates, from which the fragment shader finds how many
// pixels it is away from each edge. Lines drawn so lie in the surface: nothing has to be pulled forward.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[2];
}
gl_in[];
out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[2];
};

in Surface {
    vec2 grid;
    float haze;
    flat float level;
#ifdef SUN_FIXED
    vec3 sun;
#endif
#ifdef GRATICULE
    vec2 from_anchor;
#endif
#ifdef COVER
    vec4 cover;
#endif
}
corner[];

out WiredSurface {
    vec2 grid;
    float haze;
    flat float level;
#ifdef SUN_FIXED
    vec3 sun;
#endif
#ifdef GRATICULE
    vec2 from_anchor;
#endif
#ifdef COVER
    vec4 cover;
#endif
    vec3 barycentric;
}
surface;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_ClipDistance[0] = gl_in[i].gl_ClipDistance[0];
        gl_ClipDistance[1] = gl_in[i].gl_ClipDistance[1];
        surface.grid = corner[i].grid;
        surface.haze = corner[i].haze;
        surface.level = corner[2].level;
#ifdef SUN_FIXED
        surface.sun = corner[i].sun;
#endif
#ifdef GRATICULE
        surface.from_anchor = corner[i].from_anchor;
#endif
#ifdef COVER
        surface.cover = corner[i].cover;
#endif
        surface.barycentric = vec3(i == 0, i == 1, i == 2);
        EmitVertex();
    }
    EndPrimitive();
}
