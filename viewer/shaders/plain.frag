// The layer plain: a pixel costs no more than blending what its triangle's corners are lit with.
in Surface {
    vec2 grid;
    vec3 colour;
}
surface;

out vec4 colour;

void main() {
#ifdef VOIDS
    vec2 x = abs(dFdx(surface.grid));
    vec2 y = abs(dFdy(surface.grid));
    if (!is_whole(cell_at(surface.grid), min(max(x.x, x.y), max(y.x, y.y)))) discard;
#endif
    colour = vec4(min(surface.colour, vec3(1.0)), 1.0);
}
