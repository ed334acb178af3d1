// A pellet of food. In: light and coverage from pellet.vert. Out: scene radiance; alpha is the
// coverage.
layout(location = 0) in vec3 light;
layout(location = 1) in float coverage;
layout(location = 0) out vec4 radiance;
void main() { radiance = vec4(light, coverage); }
