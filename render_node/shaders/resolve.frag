// The light of a pixel, the mean over its samples, and beside it the depth of one of them, so that softening reads both
// at once. In: picture and depth of the scene. Out: linear light; depth.
#include "shader_interface.h"
#include "many_samples.glsl"
layout(location = 0) out vec4 lightAndDepth;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    lightAndDepth = vec4(lightAt(pixel), depthAt(pixel));
}
