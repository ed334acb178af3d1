layout(location = 0) in vec3 light;
layout(location = 0) out vec4 radiance;
void main() {
    vec2 p = gl_PointCoord * 2.0 - 1.0;
    float r2 = dot(p, p);
    radiance = vec4(light * max(1.0 - r2, 0.0) * 1.5, 0.0);
}
