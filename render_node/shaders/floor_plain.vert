// The sand of the lowest tier: light and water are computed at the vertices, what the sand is made of and caustics at
// the pixels. In: as floor.vert. Out: what reaches the eye of white sand that faces the sun, and of such sand in all
// other light; the light of the water in between.
#include "shader_interface.h"
#include "shading.glsl"
#include "floor_corner.glsl"
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 sunlit;
layout(location = 3) out vec3 skylit;
layout(location = 4) out vec3 lamplit;
layout(location = 5) out vec3 veil;
#include "sand_colour.glsl"
// Water takes other wavelengths from white things: what sand loses holds for all that lies on it.
vec3 ofSand(vec3 light, float range, float depth) { return direct(kSand * light, range, depth) / kSand; }
void main() {
    FloorCorner it = floorCorner();
    place = it.place;
    normal = it.normal;
    vec3 n = normalize(normal), way = place - eyeAndTime.xyz;
    float range = length(way), depth = max(-place.y, 0.1);
    vec3 dark = litAt(5.0, Occlusion(0.0, 0.0), vec3(1.0), place, n, 0.0);
    sunlit = ofSand(sunlight.rgb * (unscatteredShare(depth) / kPi), range, depth);
    skylit = ofSand(litAt(5.0, Occlusion(0.0, 1.0), vec3(1.0), place, n, 0.0) - dark, range, depth);
    lamplit = ofSand(dark, range, depth);
    veil = inscatter(way / range, range);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
