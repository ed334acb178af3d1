// Light is conserved: an area that shrinks becomes brighter. In: `before`, the place of the undisturbed
// grid, metres. Out: light relative to its mean, added up over the triangles. Space: texels of one
// layer.
#include "shader_interface.h"
layout(location = kCausticTexelLocation) uniform float texelMetres;
layout(location = 0) in vec2 before;
layout(location = 0) out float light;
const float kSharpest = 32.0;  // the sun's disc has a width: no focus is infinitely bright
void main() {
    vec2 a = dFdx(before), b = dFdy(before);
    light = min(abs(a.x * b.y - a.y * b.x) / (texelMetres * texelMetres), kSharpest);
}
