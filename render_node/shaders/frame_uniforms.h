// SPDX-License-Identifier: Apache-2.0
// The frame's uniform block, included by C++ and by GLSL. std140, so only vec4 and mat4 members.
#ifndef AQUARAMA_FRAME_UNIFORMS_H
#define AQUARAMA_FRAME_UNIFORMS_H
#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace aquarama::shaders {
using mat4 = glm::mat4;
using vec4 = glm::vec4;
struct FrameUniforms {
#else
#include "shader_interface.h"
layout(std140, binding = kFrameBlock) uniform FrameUniforms {
#endif
    mat4 clipFromWorld;
    mat4 worldFromClip;
    vec4 eyeAndTime;         // eye of this view in world metres; w: seconds, restarts after 9000
    vec4 sharedEyeAndPixel;  // shared eye in world metres, from which levels of detail follow; w:
                             // the wall's finest pixel, radians
    vec4 sunAndFilterDepth;  // unit vector towards the refracted sun; w: depth of the diver's
                             // filter, metres
    vec4 viewport;           // width and height of what is drawn, pixels; rows of the whole picture,
                             // of which it may be a part; pixels in a radian in its middle
    vec4 sunlight;           // what there is of the sun's light at noon: red, green, blue; w: 0
    vec4 skylight;           // the same of the sky's
    vec4 lamp;               // the submarine's floodlight in world metres; w: its power at 1 m, the
                             // sun's at the surface being 1
    vec4 kdAndExposure;      // Kd of the three primaries where the filter looks, 1/m; w: what light
                             // is multiplied by before the tone
    vec4 grading;            // x: the share of the colour that water takes which is given back
    vec4 bottom;             // x: 1 over a sea floor, 0 in the open sea
    vec4 current;  // way of the water since tick 0 along x and z, metres; velocity along x
                   // and z, metres a second
#ifdef __cplusplus
};
}  // namespace aquarama::shaders
#else
};
#endif
#endif
