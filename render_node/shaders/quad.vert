// One triangle that covers the picture; uv has its origin at the bottom left.
// In: the vertex number, 0 to 2. Out: uv, 0 to 1 over the picture, and clip space at depth 0, which
// is the far plane.
layout(location = 0) out vec2 uv;
void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
