// SPDX-License-Identifier: Apache-2.0
// Which fish a channel draws, and how finely (paper, section 6): the CPU reference of what
// fish_cull.comp does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace aquarama::surface {

// What a view sees, world frame, metres.
struct Frustum {
    // Inward, with unit normals where they have one: the four sides, then the two of the depth.
    std::array<glm::vec4, 6> planes{};

    // Whether any of a ball lies within.
    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const;
};
// Depth zero to one, in either direction; the far plane may be at infinity.
[[nodiscard]] Frustum frustumOf(const glm::mat4& clipFromWorld);

// From coarse to fine. From the control mesh on they have a surface, which is refined 0 to 3 times.
enum class DetailLevel : std::uint32_t {
    Point,         // its area and its colour
    Fading,        // few triangles, fading into a point
    FewTriangles,  // rings of the control cage
    ControlMesh,   // paper, section 6
    Mesh,          // the limit surface, as the two that follow
    Hero,
    CloseUp,
};
inline constexpr std::size_t kDetailLevels = 7;

struct Detail {
    DetailLevel level = DetailLevel::Point;
    // How far it is from the next coarser level: 0 looks as that does, 1 is all its own.
    float blend = 1.0F;
};

// From which size on a fish has a level: pixels of the wall that it would fill from nose to tail,
// seen from the side.
using DetailLimits = std::array<float, kDetailLevels>;
// fineness: 1, or more to have the meshes finer than need be.
[[nodiscard]] DetailLimits detailLimits(float fineness);

// The shared eye, and the angle of the wall's finest pixel: what a level of detail may depend on,
// so that neighbours, and a node that was just started, draw the same fish alike.
struct SharedView {
    glm::vec3 eyeMetres{};
    float pixelRadians = 0.0016F;
};
[[nodiscard]] Detail detailOf(const SharedView& view,
                              const DetailLimits& limits,
                              DetailLevel finest,
                              glm::vec3 placeMetres,
                              float lengthMetres);
// How far anything that is drawn of a fish gets from its place. A point may be wider than the fish.
[[nodiscard]] float marginOf(const SharedView& view,
                             glm::vec3 placeMetres,
                             float lengthMetres,
                             float reachBodyLengths);

}  // namespace aquarama::surface
