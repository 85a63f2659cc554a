// What is drawn over the ground's layer. A program has only what its picture asks for, in the order in which OVERLAYS, a
// definition, names it.

// How far a change of value from pixel to pixel takes it.
float slope_of(float value) { return length(vec2(dFdx(value), dFdy(value))); }

// Lines at whole values, so many pixels wide whatever the scale: their part of a pixel. In pictures that are larger than
// a window (viewer/marks/marks.hpp) all of them are as many times wider. Where they come nearer than twice `room` pixels
// together they fade, and where they have less than that there is none. Where the value does not change there is no
// line, be it at a whole one: a plain has lines at its edge alone.
float lines_at(float value, float slope, float width, float room) {
    float off = abs(fract(value + 0.5) - 0.5);
    float pixels = off / max(slope, 1e-12);
    float apart = 1.0 / max(slope, 1e-12);
    float reach = 0.5 * width * overlays.shape.x;
    room *= overlays.shape.x;
    return (1.0 - smoothstep(reach - 0.5, reach + 0.5, pixels)) * smoothstep(room, 2.0 * room, apart);
}

float brightness(vec3 colour) { return dot(colour, vec3(0.2126, 0.7152, 0.0722)); }

// Dark on light ground and light on dark. `bright` is that of what lies below all lines, or they would change where they
// cross. Natural ground is mottled: there it is the part of snow that counts, not each pixel's own light.
vec3 ink(float bright, vec3 dark, vec3 light) {
#ifdef COVER
    return mix(light, dark, smoothstep(0.42, 0.52, bright));
#else
    return mix(light, dark, smoothstep(0.26, 0.36, bright));
#endif
}

#ifdef CONTOURS
// Every fifth line is an index line: heavier, and there for longer where lines are close together; where there would be
// more line than ground between them they are gone, too.
vec3 with_contours(vec3 ground, float bright, vec4 drawn, float height, float height_slope, float dry) {
    float value = height * drawn.y + drawn.z;
    float slope = height_slope * drawn.y;
    float share = max(0.8 * lines_at(value, slope, 1.2, 2.5), lines_at(0.2 * value, 0.2 * slope, 2.3, 3.0));
    return mix(ground, ink(bright, vec3(0.30, 0.17, 0.06), vec3(0.93, 0.80, 0.62)), share * dry * drawn.x);
}
#endif

#ifdef GRATICULE
// The lines of both kinds that a place is between, as an area's polynomials have them.
vec2 lines_in(int area, vec2 uv) {
    vec2 sum = vec2(0.0);
    for (int k = 4; k >= 0; --k) {
        vec2 row = vec2(0.0);
        for (int i = 4; i >= 0; --i) row = row * uv.x + overlays.terms[25 * area + i + 5 * k].xy;
        sum = sum * uv.y + row;
    }
    return sum;
}

struct GraticulePlace {
    vec2 value;
    vec2 slopes;
    float border;  // part of a pixel that is a border of zones
};

// AREAS, a definition, is 1 where one set of lines goes on for ever.
GraticulePlace graticule_at(vec2 from_anchor) {
    GraticulePlace place = GraticulePlace(vec2(0.5), vec2(0.0), 0.0);
#if AREAS == 1
    place.value = lines_in(0, (from_anchor - overlays.local[0].xy) * overlays.local[0].zw);
#else
    vec4 slopes = vec2(slope_of(from_anchor.x), slope_of(from_anchor.y)).xyxy;
    for (int k = 0; k < AREAS; ++k) {
        vec4 bounds = overlays.bounds[k];
        bool inside = all(greaterThanEqual(from_anchor, bounds.xy)) && all(lessThan(from_anchor, bounds.zw));
        vec2 value = lines_in(k, (from_anchor - overlays.local[k].xy) * overlays.local[k].zw);
        vec4 pixels = abs(from_anchor.xyxy - bounds) / max(slopes, vec4(1e-12));
        float reach = 1.2 * overlays.shape.x;
        vec4 near = (1.0 - smoothstep(vec4(reach - 0.5), vec4(reach + 0.5), pixels)) * overlays.borders[k];
        place.value = inside ? value : place.value;
        place.border = inside ? max(max(near.x, near.y), max(near.z, near.w)) : place.border;
    }
#endif
    return place;
}

#ifdef POLE
// Longitude and latitude of a place in the plane on which the conformal sphere is projected from the other pole. The
// geodetic latitude is a series of the conformal one (Snyder 1987, "Map projections", 3-5); both are counted from the
// pole, where a float knows angles to a millimetre.
vec2 polar_graticule_at(vec2 plane, vec2 lines) {
    float c = 2.0 * atan(length(plane));
    float from_pole = c - 3.3565514e-3 * sin(2.0 * c) + 6.5718731e-6 * sin(4.0 * c) - 1.7646e-8 * sin(6.0 * c);
    return vec2(atan(plane.y, plane.x), 1.5707963 - from_pole) * lines;
}
#endif

// Across the antimeridian longitudes jump by a whole number of lines; their fraction jumps between two lines alone.
vec2 graticule_slopes(vec2 value) {
    return vec2(min(slope_of(value.x), slope_of(fract(value.x + 0.5))), slope_of(value.y));
}

vec3 with_graticule(vec3 ground, float bright, vec4 drawn, GraticulePlace at) {
    float share = max(lines_at(at.value.x, at.slopes.x, 1.4, 12.0), lines_at(at.value.y, at.slopes.y, 1.4, 12.0));
    vec3 lined = mix(ground, ink(bright, vec3(0.05, 0.10, 0.33), vec3(0.84, 0.92, 1.00)), 0.9 * share * drawn.x);
    return mix(lined, ink(bright, vec3(0.62, 0.05, 0.10), vec3(1.00, 0.66, 0.55)), 0.9 * at.border * drawn.x);
}
#endif
