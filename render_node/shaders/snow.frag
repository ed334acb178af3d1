// A speck of snow or plankton: round, fading towards its rim. In: light, and the place within the
// sprite. Out: scene radiance, added.
layout(location = 0) in vec3 light;
layout(location = 0) out vec4 radiance;
void main() {
    vec2 p = gl_PointCoord * 2.0 - 1.0;
    float rim = max(1.0 - dot(p, p), 0.0);
    radiance = vec4(light * (rim * rim * 2.25), 0.0);
}
