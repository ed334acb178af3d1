// For many small things that are lit at their vertices. In: light from the vertex shader. Out: the same
// as scene radiance, opaque.
layout(location = 0) centroid in vec3 light;
layout(location = 0) out vec4 radiance;
void main() { radiance = vec4(light, 1.0); }
