// A fish as the sun sees it: an ellipse along its body, where its shadow's rays meet the surface.
// In: records by instance; four corners. Out: place in the window of the fish map, clip space.
#include "shadow.glsl"
#include "fish_record.glsl"
#include "fish_data.glsl"
layout(location = 0) out vec2 across;
layout(location = 1) flat out vec2 heightAndShare;
const float kSlender = 0.15;  // half the body's height and breadth, of its length
void main() {
    uint i = uint(gl_InstanceID);
    vec3 place = placeMetresOf(i);
    float size = lengthMetresOf(i);
    vec2 along = surfacePoint(rotate(rotationOf(i), vec3(1.0, 0.0, 0.0)));
    float reach = length(along);
    along = reach > 1.0e-3 ? along / reach : vec2(1.0, 0.0);
    across = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    // Never less than a texel or two: the map is coarse. Its shade then grows fainter.
    float least = 1.2 / (fishWindow.z * float(textureSize(fishOnTheWay, 0).x));
    vec2 own = size * vec2(max(0.5 * reach, kSlender), kSlender);
    vec2 halfSize = max(own, least);
    vec2 offset = along * (across.x * halfSize.x) + vec2(-along.y, along.x) * (across.y * halfSize.y);
    heightAndShare = vec2(place.y, own.x * own.y / (halfSize.x * halfSize.y));
    vec2 at = (surfacePoint(place) + offset - fishWindow.xy) * fishWindow.z;
    gl_Position = isAway(i) ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(2.0 * at, 0.0, 1.0);
}
