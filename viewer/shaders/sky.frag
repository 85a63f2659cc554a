// Sky, and the bare base surface (the sea's level) where there is no data: its horizon is the true one, at any height.
in vec3 ray;
out vec4 colour;

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
    float lowest = b >= 0.0 || c <= 0.0 ? max(frame.eye_up.w, 0.0)
                                        : (sqrt(max(1.0 + c - b * b / a, 1.0)) - 1.0) * radius;
    float air = exp(-pow(lowest / kGlowScale, 1.5));
    float high = 1.0 - exp(-3.5 * max(above, 0.0));
    vec3 sky = mix(kSpaceColour, mix(kHazeColour, kZenithColour, high) * day, air);

    vec3 ground = kGroundColour * day;
    if (c > 0.0) {
        float way = radius * c / (sqrt(max(b * b - a * c, 0.0)) - min(b, 0.0));
        ground = mix(ground, kHazeColour * day, haze(way, frame.eye_up.w, 0.0));
    }
    vec3 shown = mix(ground, sky, clamp(0.5 + above / max(fwidth(above), 1e-7), 0.0, 1.0));
    // The sky changes by less than one step of 8 bits over many pixels: ordered noise of one step hides the bands.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    colour = vec4(shown + noise / 255.0, 1.0);
}
