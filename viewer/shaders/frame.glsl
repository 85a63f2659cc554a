// What every shader knows of a picture. Directions are in ECEF axes, lengths in metres.
layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_offset;  // offsets from the eye to clip space
    vec4 eye_up;            // the ellipsoid's normal at the eye; w: height of the eye above the base surface
    vec4 grid;              // last column, last row; those of the cells
    vec4 place;             // west, north, step along columns, step along rows; radians. With POLE: x and y of the first
                            // post in the plane of PolarPositions, growth of x with a row, of y with a column
    vec4 sun;               // along the grid's rows, up its columns, and up (east, north, up in a geographic one) where
                            // SUN_FIXED is not set, else ECEF; w: daylight at the eye, 0 to 1
    vec4 surface;           // exaggeration, levels, haze per metre at the sea, 1 where the eye may be below the ground
    vec4 ray;               // through the middle of the picture, then its change to the right edge and to the upper edge
    vec4 ray_right;
    vec4 ray_up;
    vec4 eye_scaled;        // where the base surface is the unit sphere; w: squared length - 1, rounded from double
    vec4 base_axes;         // 1 / semi-axes of the base surface, times the semi-major one
    vec4 sun_at_eye;        // towards the sun, ECEF axes; w: sine of its elevation
}
frame;

const vec3 kHazeColour = vec3(0.80, 0.86, 0.92);
const vec3 kZenithColour = vec3(0.30, 0.53, 0.83);
const vec3 kSpaceColour = vec3(0.010, 0.012, 0.030);
const vec3 kGroundColour = vec3(0.42, 0.44, 0.42);  // where there is no data
const float kAirScale = 8000.0;                     // of the air's density with height
const float kGlowScale = 22000.0;                   // of the light that it scatters, which falls off later and then faster

float dimmed(float daylight) { return mix(0.10, 1.0, daylight); }

// Part of the light that haze took over on a straight way through air that thins with height.
float haze(float way, float from_height, float to_height) {
    float from = exp(-max(from_height, 0.0) / kAirScale);
    float to = exp(-max(to_height, 0.0) / kAirScale);
    float rise = (max(to_height, 0.0) - max(from_height, 0.0)) / kAirScale;
    float air = abs(rise) < 1e-2 ? 0.5 * (from + to) : (from - to) / rise;
    return 1.0 - exp(-way * air * frame.surface.z);
}
