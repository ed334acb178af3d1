// Dots of a sign. In: uv from its top left. Out: linear light.
#include "shader_interface.h"
layout(location = kSignSizeLocation) uniform ivec2 size;  // columns, rows
layout(location = kSignDotsLocation) uniform uint dots[kMostSignBytes / 4];
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light;
// Of dots that are lit, below full white, so that the sign does not outshine the world; and of the others.
const float kLit = 0.55, kUnlit = 0.004;

void main() {
    ivec2 dot = clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
    int i = dot.y * size.x + dot.x, byte = i >> 3;
    uint eight = dots[byte >> 2] >> (8 * (byte & 3));
    bool isLit = (eight >> (7 - (i & 7)) & 1u) != 0u;
    light = vec4(vec3(isLit ? kLit : kUnlit), 1.0);
}
