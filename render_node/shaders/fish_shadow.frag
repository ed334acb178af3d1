// Optical depth of a fish, and its first two moments over height.
// In: place on the ellipse (-1 to 1), height (world y) and share of the area. Out: depth, depth *
// height, depth * height^2, added up.
layout(location = 0) in vec2 across;
layout(location = 1) flat in vec2 heightAndShare;
layout(location = 0) out vec4 sums;
void main() {
    float height = heightAndShare.x;
    float depth = 2.2 * heightAndShare.y * max(1.0 - dot(across, across), 0.0);
    sums = depth * vec4(1.0, height, height * height, 0.0);
}
