// White dots on a dark box. In: place in dots from the glyph's top left dot; the bits of the glyph.
// Out: display light with alpha, for blending.
layout(location = 0) in vec2 dot;
layout(location = 1) flat in uvec2 bits;
layout(location = 0) out vec4 colour;

void main() {
    ivec2 at = ivec2(floor(dot));
    int index = at.y * 5 + at.x;
    bool inside = at.x >= 0 && at.y >= 0 && at.x < 5 && at.y < 7;
    bool lit = inside && ((index < 32 ? bits.x >> index : bits.y >> (index - 32)) & 1u) != 0u;
    colour = lit ? vec4(1.0) : vec4(0.0, 0.0, 0.0, 0.65);
}
