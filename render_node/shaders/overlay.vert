// One glyph of a text: a box of 6 x 9 dots with its 5 x 7 dots inside.
// In: glyphs by instance, pixels from the top left corner; four corners. Out: place in dots, clip
// space.
#include "shader_interface.h"
struct Glyph {
    vec2 topLeft;  // pixels from the picture's top left corner
    uvec2 bits;
};
layout(std430, binding = kGlyphsStorage) readonly buffer Glyphs {
    Glyph glyphs[];
};
layout(location = kPictureSizeLocation) uniform vec2 pictureSize;
layout(location = kDotPixelsLocation) uniform float dotPixels;

layout(location = 0) out vec2 dot;  // from the glyph's own top left dot
layout(location = 1) flat out uvec2 bits;

void main() {
    Glyph glyph = glyphs[gl_InstanceID];
    vec2 cell = vec2(gl_VertexID & 1, gl_VertexID >> 1) * vec2(6.0, 9.0);
    dot = cell - 1.0;
    bits = glyph.bits;
    vec2 place = (floor(glyph.topLeft) + cell * dotPixels) / pictureSize;
    gl_Position = vec4(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, 0.0, 1.0);
}
