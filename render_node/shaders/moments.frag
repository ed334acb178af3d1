// From the depth of the topmost things to their height and its square, over a few texels.
// In: a depth map, 1 at the surface, 0 at kMapDepthMetres below. Out: height (metres, negative
// below the surface) and its square.
#include "shader_interface.h"
layout(binding = kMomentDepthsUnit) uniform sampler2D depths;
layout(location = 0) out vec2 heightAndSquare;
void main() {
    ivec2 last = textureSize(depths, 0) - 1;
    vec2 sum = vec2(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(ivec2(gl_FragCoord.xy) + ivec2(x, y), ivec2(0), last);
            float height = (texelFetch(depths, at, 0).r - 1.0) * kMapDepthMetres;
            float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0) / 16.0;
            sum += weight * vec2(height, height * height);
        }
    heightAndSquare = sum;
}
