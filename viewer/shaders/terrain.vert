layout(location = 1) in uvec2 post;  // column and row in the padded grid
#ifdef NODES
layout(location = 0) in ivec3 place;  // in units, from the terrain's origin
layout(location = 2) in float rise;   // to the coarser level, metres
layout(location = 3) in uint part;    // what it moves with: 0 the node's inside, 1 to 4 a side, 5 all the way

layout(location = 0) uniform vec4 moved_on_side;  // parts of the way to the coarser level
layout(location = 1) uniform float moved;
layout(location = 2) uniform ivec3 base;           // the place nearest to the eye
layout(location = 3) uniform vec4 base_from_eye;   // metres; w: of a unit
layout(location = 4) uniform vec3 eye;             // ECEF

// From the eye, ECEF axes. Of a place alone: what two nodes share is in both where it is in one.
vec3 offset_from_eye() {
    precise vec3 offset = vec3(place - base) * base_from_eye.w + base_from_eye.xyz;
    float way = part == 0u ? moved : part == 5u ? 1.0 : moved_on_side[part - 1u];
    const float axes = 1.0 - 6.69437999014e-3;  // polar radius / equatorial radius, squared
    vec3 up = normalize((eye + offset) / vec3(1.0, 1.0, axes));
    return offset + way * rise * up;
}
#else
layout(location = 0) in vec3 offset_from_eye;  // ECEF axes
#endif

out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[2];
};

out Surface {
    vec2 grid;  // column and row
#ifdef PLAIN
    vec3 colour;  // lit here
#else
    float haze;
    flat float level;
#ifdef SUN_FIXED
    vec3 sun;  // along the grid's row, up its column, and up: it turns as the ground curves
#endif
#ifdef GRATICULE
    vec2 from_anchor;  // in units of the graticule's reach
#endif
#ifdef COVER
    vec4 cover;  // metres from the cover's anchor; H of the snow line; how much towards the sun
#endif
#endif
}
surface;

#ifdef COVER
// Climatic snow line, metres: 5600 to 15 degrees of latitude, 5200 at 28, 3900 at 43, 1900 at 60, 0 at the poles. Mountain
// ranges are up to 700 m off it.
float snow_line(float lat) {
    float c = cos(1.2 * max(abs(lat) - 0.2618, 0.0));
    return 5600.0 * c * c;
}
#endif

// Depth of the vertex in the bisection: 0 for the corners, 2 n for the last posts.
float bisection_level(uvec2 at) {
    uint both = at.x | at.y;
    float levels = frame.surface.y;
    if (both == 0u) return 0.0;
    int zeros = findLSB(both);
    bool middle_of_square = ((at.x & at.y) >> zeros & 1u) == 1u;
    return max(0.0, 2.0 * (levels - float(zeros)) - (middle_of_square ? 1.0 : 0.0));
}

#ifdef SUN_FIXED
// Along the grid's row, up its column, and up.
vec3 sun_over(vec2 at) {
#ifdef POLE
    // The tangents of a sphere along x and y of its stereographic projection; that latitudes are conformal here turns
    // them by 0.2 degrees at most.
    vec2 p = frame.place.xy + at.yx * frame.place.zw;
    float q = 2.0 / (1.0 + dot(p, p));
    vec3 along_x = vec3(1.0 - q * p.x * p.x, -q * p.x * p.y, -POLE * q * p.x);
    vec3 along_y = vec3(-q * p.x * p.y, 1.0 - q * p.y * p.y, -POLE * q * p.y);
    vec3 up = vec3(q * p, POLE * (q - 1.0));
    return vec3(dot(frame.sun.xyz, along_y), -POLE * dot(frame.sun.xyz, along_x), dot(frame.sun.xyz, up));
#else
    float lat = frame.place.y - at.y * frame.place.w;
    float lon = frame.place.x + at.x * frame.place.z;
    vec3 east = vec3(-sin(lon), cos(lon), 0.0);
    vec3 up = vec3(cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat));
    return vec3(dot(frame.sun.xyz, east), dot(frame.sun.xyz, cross(up, east)), dot(frame.sun.xyz, up));
#endif
}
#endif

#ifdef PLAIN
// As terrain.frag lights a pixel, with the finest normal that is there.
vec3 plain_colour(vec2 at) {
    vec4 here = textureLod(posts, page_place(at, cell_at(at), 1.0).fine, 0.0);
    here.xy /= max(here.a, 1e-3);
    vec3 normal = normalize(vec3(here.xy * frame.surface.x, sqrt(max(1.0 - dot(here.xy, here.xy), 1e-6))));
#ifdef SUN_FIXED
    vec3 sun = normalize(sun_over(at));
    float day = dimmed(smoothstep(-0.10, 0.15, sun.z));
#else
    vec3 sun = frame.sun.xyz;
    float day = dimmed(frame.sun.w);
#endif
    return vec3(0.72, 0.68, 0.60) * ((0.32 + 0.12 * normal.z) * day + 0.75 * max(dot(normal, sun), 0.0));
}
#endif

void main() {
#ifdef NODES
    precise vec3 offset = offset_from_eye();
#else
    vec3 offset = offset_from_eye;
#endif
    gl_Position = frame.clip_from_offset * vec4(offset, 1.0);
    vec2 at = vec2(post);
    // Padding lies east and south of the data.
    gl_ClipDistance[0] = frame.grid.x - at.x;
    gl_ClipDistance[1] = frame.grid.y - at.y;
    surface.grid = at;
#ifdef PLAIN
    surface.colour = plain_colour(at);
#else
    surface.level = bisection_level(post);
    float way = length(offset);
    float rise = dot(offset, frame.eye_up.xyz);
    float sinking = (way * way - rise * rise) / (2.0 * 6371000.0);
    surface.haze = haze(way, frame.eye_up.w, frame.eye_up.w + rise + sinking);
#ifdef GRATICULE
    surface.from_anchor = (at - overlays.anchor.xy) * overlays.anchor.zw;
#endif
#ifdef COVER
#ifdef POLE
    vec2 in_plane = frame.place.xy + at.yx * frame.place.zw;
    float latitude = asin(2.0 / (1.0 + dot(in_plane, in_plane)) - 1.0);
#else
    float latitude = frame.place.y - at.y * frame.place.w;
#endif
    vec2 from_anchor = (at - cover.anchor.xy) * vec2(cover.anchor.z, -cover.anchor.w);
    surface.cover = vec4(from_anchor, snow_line(latitude), toward_sun(offset));
#endif
#ifdef SUN_FIXED
    surface.sun = sun_over(at);
#endif
#endif
}
