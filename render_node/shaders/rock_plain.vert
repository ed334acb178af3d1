// Rock of the lowest tier: light and water are computed at the vertices, grit and caustics at the
// pixels. In: as rock.vert. Out: sunlight and skylight for white stone as they reach the eye, and the
// light of the water in between.
#include "shader_interface.h"
#include "shading.glsl"
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 mottle;
layout(location = 3) out vec3 sunlit;  // light of white stone in the sun that reaches the eye
layout(location = 4) out vec3 skylit;  // the same in the light from above
layout(location = 5) out vec3 veil;
#include "rock_corner.glsl"
void main() {
    RockCorner it = rockCorner();
    place = it.place;
    normal = it.normal;
    mottle = it.mottle;
    vec3 n = normalize(normal), way = place - eyeAndTime.xyz;
    float range = length(way), depth = max(-place.y, 0.1);
    // All light without the sun's, at the mean of the waves.
    vec3 all = litAt(5.0, Occlusion(0.0, it.open.y), it.tint, place, n, 0.0);
    vec3 sun = it.tint * sunlight.rgb *
               (unscatteredShare(depth) * it.open.x *
                          max(dot(n, sunAndFilterDepth.xyz), 0.0) / kPi);
    sunlit = direct(sun, range, depth);
    skylit = direct(all, range, depth);
    veil = inscatter(way / range, range);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
