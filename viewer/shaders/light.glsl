// Light of the sky and of the sun by the sine of the sun's elevation. From 0.22 up (13 degrees) it is day: nothing
// changes with the sun's height but how much ground it lights.
const vec3 kNightAir = vec3(0.072, 0.090, 0.138);
const vec3 kNightZenith = vec3(0.014, 0.020, 0.046);

float daylight(float s) { return smoothstep(-0.10, 0.15, s); }

// 1 around sunset; 0 by day, and 14 degrees below the horizon.
float dusk(float s) { return smoothstep(-0.24, -0.05, s) * (1.0 - smoothstep(0.02, 0.22, s)); }

// Of a direction along the ground: 1 towards the sun, 0 away from it.
float toward_sun(vec3 direction) {
    vec3 up = frame.eye_up.xyz;
    vec3 sun = frame.sun_at_eye.xyz - frame.sun_at_eye.w * up;
    vec3 level = direction - dot(direction, up) * up;
    return 0.5 + 0.5 * dot(sun, level) * inversesqrt(max(dot(sun, sun) * dot(level, level), 1e-12));
}

// The sky at the horizon, which is also what haze looks like.
vec3 air_colour(float s, float toward) {
    vec3 plain = mix(kNightAir, kHazeColour, daylight(s));
    vec3 glow = mix(vec3(0.45, 0.44, 0.57), vec3(0.98, 0.62, 0.36), toward * toward);
    glow *= mix(0.24, 1.0, smoothstep(-0.24, 0.04, s));
    return mix(plain, glow, 0.9 * dusk(s));
}

vec3 zenith_colour(float s) {
    vec3 plain = mix(kNightZenith, kZenithColour, daylight(s));
    return mix(plain, vec3(0.21, 0.29, 0.50) * smoothstep(-0.28, 0.02, s), 0.7 * dusk(s));
}

// What ground gets of the sun where it faces it, of the whole sky, and of a moon opposite to the sun by night.
vec3 sunlight(float s) {
    vec3 colour = mix(vec3(1.45, 0.78, 0.38), vec3(1.00, 0.96, 0.88), smoothstep(-0.02, 0.34, s));
    return colour * (0.95 * smoothstep(-0.03, 0.06, s));
}
vec3 skylight(float s) {
    vec3 colour = mix(vec3(0.095, 0.115, 0.175), vec3(0.35, 0.39, 0.45), daylight(s));
    return mix(colour, vec3(0.60, 0.58, 0.66) * mix(0.3, 1.0, smoothstep(-0.24, 0.08, s)), 0.8 * dusk(s));
}
vec3 moonlight(float s) { return vec3(0.25, 0.30, 0.43) * (1.0 - smoothstep(-0.18, -0.02, s)); }
