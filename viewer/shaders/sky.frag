// Sky, and the bare base surface (the sea's level) where there is no data: its horizon is the true one, at any height.
in vec3 ray;
out vec4 colour;

#ifdef LOW_SUN
// The sun, half a degree wide, and the light around it; only around sunset: the sun of maps is no place in the sky.
vec3 sun_glow(vec3 direction, float s) {
    float c = max(dot(direction, frame.sun_at_eye.xyz), 0.0);
    float squared = c * c;
    float halo = 0.22 * pow(squared, 4.0) + 0.30 * pow(squared, 90.0);
    float disc = smoothstep(0.999985, 0.999991, c);
    return dusk(s) * smoothstep(-0.12, 0.04, s) * (vec3(1.0, 0.58, 0.26) * halo + vec3(1.0, 0.86, 0.62) * disc);
}

vec3 random_3(vec3 p) {
    uvec3 n = uvec3(ivec3(p)) * uvec3(1664525u, 22695477u, 1103515245u);
    uint x = n.x ^ n.y ^ n.z;
    x = (x ^ x >> 16) * 0x45d9f3bu;
    x = (x ^ x >> 15) * 0x2c1b3c6du;
    x ^= x >> 16;
    return vec3(x & 1023u, x >> 10 & 1023u, x >> 20 & 1023u) / 1023.0;
}

// At most one in each cell around the eye; about a pixel wide.
vec3 stars(vec3 direction) {
    const float cells = 48.0;
    vec3 cell = floor(direction * cells);
    vec3 chance = random_3(cell);
    vec3 place = normalize((cell + 0.25 + 0.5 * chance) / cells);
    float wide = 0.75 * max(length(dFdx(direction)), length(dFdy(direction)));
    float away = distance(direction, place) / max(wide, 1e-6);
    float bright = chance.x * chance.z;
    return mix(vec3(0.75, 0.85, 1.0), vec3(1.0, 0.9, 0.75), chance.y) * (1.1 * bright * bright * bright * exp(-away * away));
}
#endif

void main() {
    const float radius = 6378137.0;
    vec3 direction = normalize(ray);
    // Where the base surface is the unit sphere: |eye + s d|^2 = 1 is a s^2 + 2 b s + c = 0. c comes from double
    // precision, so that the horizon is right to a small part of a pixel even 1 cm above the ground.
    vec3 d = direction * frame.base_axes.xyz;
    float a = dot(d, d);
    float b = dot(frame.eye_scaled.xyz, d);
    float c = frame.eye_scaled.w;
    // Above the horizon by about this, as the sine of an angle. Below the base surface there is no horizon but level.
    float above = c > 0.0 ? b + sqrt(a * c) : dot(direction, frame.eye_up.xyz);

    float day = dimmed(frame.sun.w);
#ifdef LOW_SUN
    float s = frame.sun_at_eye.w;
    // Redness keeps to the ground.
    vec3 air_here = air_colour(s, toward_sun(direction) * exp(-2.5 * max(above, 0.0)));
    vec3 zenith_here = zenith_colour(s);
#else
    vec3 air_here = kHazeColour * day;
    vec3 zenith_here = kZenithColour * day;
#endif
    float lowest = b >= 0.0 || c <= 0.0 ? max(frame.eye_up.w, 0.0)
                                        : (sqrt(max(1.0 + c - b * b / a, 1.0)) - 1.0) * radius;
    float air = exp(-pow(lowest / kGlowScale, 1.5));
    float high = 1.0 - exp(-3.5 * max(above, 0.0));
    vec3 glowing = mix(air_here, zenith_here, high);
#ifdef LOW_SUN
    glowing += sun_glow(direction, s);
#endif
    vec3 sky = mix(kSpaceColour, glowing, air);
#ifdef LOW_SUN
    sky += stars(direction) * (1.0 - smoothstep(-0.24, -0.08, s) * air);
#endif

    vec3 ground = kGroundColour * day;
    if (c > 0.0) {
        float way = radius * c / (sqrt(max(b * b - a * c, 0.0)) - min(b, 0.0));
        ground = mix(ground, air_here, haze(way, frame.eye_up.w, 0.0));
    }
    vec3 shown = mix(ground, sky, clamp(0.5 + above / max(fwidth(above), 1e-7), 0.0, 1.0));
    // The sky changes by less than one step of 8 bits over many pixels: ordered noise of one step hides the bands.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    colour = vec4(shown + noise / 255.0, 1.0);
}
