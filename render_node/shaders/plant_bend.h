// SPDX-License-Identifier: Apache-2.0
// How the swell bends a stem, for C++ (tests) and GLSL alike.
// Lengths in metres, y up; share: 0 at the foot, 1 at the tip; push: displacement of the tip along
// x and z.
#ifndef AQUARAMA_PLANT_BEND_H
#define AQUARAMA_PLANT_BEND_H
#ifdef __cplusplus
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
namespace aquarama::shaders {
using vec2 = glm::vec2;
using vec3 = glm::vec3;
inline
#endif
    // The point at a share of the height of a stem whose tip is pushed sideways: a parabola, sunk
    // by the integral of half its slope squared, so that the stem neither stretches nor shrinks.
    vec3
    bentStem(float share, float height, vec2 push) {
    float sag = 2.0F / 3.0F * dot(push, push) / height * share * share * share;
    return vec3(push.x * share * share, height * share - sag, push.y * share * share);
}
#ifdef __cplusplus
}  // namespace aquarama::shaders
#endif
#endif
