// How finely a fish is drawn; detailOf() of render_node/surface/visibility.h is the reference.
// Uniforms of the choice, set once or for each view. Pixels are those of the wall's finest pixel at
// the shared eye.
#ifndef FISH_DETAIL_GLSL
#define FISH_DETAIL_GLSL
#include "shader_interface.h"

const uint kUnseen = 15u;  // in place of a level of detail

layout(location = kPlanesLocation) uniform vec4 planes[6];       // of the view's frustum, inward
// world, metres; w: the wall's finest pixel, radians
layout(location = kSharedEyeLocation) uniform vec4 sharedEye;
layout(location = kLimitsLocation) uniform float limits[7];      // pixels that a fish fills from this level on
layout(location = kFinestDetailLocation) uniform uint finestDetail;
layout(location = kCullsLocation) uniform bool culls;
layout(location = kChoosesDetailLocation) uniform bool choosesDetail;  // else all are heroes

struct Detail {
    uint level;
    float blend;
};

// The detail of a fish that fills so many pixels of the wall from nose to tail.
Detail detailOf(float pixels) {
    if (!choosesDetail) return Detail(kHero, 1.0);
    uint level = 0u;
    while (level < finestDetail && pixels >= limits[level + 1u]) ++level;
    if (level == kPoint) return Detail(level, 0.0);
    if (level == kFewTriangles) return Detail(level, 1.0);
    float from = limits[level];
    float to = level == kFading ? limits[kFewTriangles] : 1.35 * from;
    float t = clamp((pixels - from) / (to - from), 0.0, 1.0);
    return Detail(level, t * t * (3.0 - 2.0 * t));
}

Detail detailAt(vec3 place, float lengthMetres) {
    return detailOf(lengthMetres / (distance(sharedEye.xyz, place) * sharedEye.w));
}

// Tests a single point against the enlarged frustum.
bool reaches(vec3 place, float marginMetres) {
    for (int i = 0; i < 6; ++i)
        if (dot(planes[i].xyz, place) + planes[i].w < -marginMetres) return false;
    return true;
}
#endif
