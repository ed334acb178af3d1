// SPDX-License-Identifier: Apache-2.0
// The choice of the fish that a channel draws, and of their level of detail (paper, section 6).
// This is the reference on the CPU for fish_cull.comp; tests compare the two.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace aquarama::surface {

// The planes of a view, world frame, metres.
struct FrustumPlanes {
    // Planes (normal, offset) that point inward: the four sides, then the two of the depth. Normals
    // have unit length, except that a far plane at infinity has none.
    std::array<glm::vec4, 6> planes{};

    // Whether a part of the ball may lie within: conservative near the edges.
    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const;
};
// The frustum of a matrix whose depth runs from zero to one, in either direction; the far plane may
// be at infinity.
[[nodiscard]] FrustumPlanes frustumOf(const glm::mat4& clipFromWorld);

// Levels of detail, from coarse to fine. From ControlMesh on a fish has a surface, which is refined
// 0 to 3 times. The numbers are those of shader_interface.h.
enum class DetailLevel : std::uint32_t {
    // A sprite with the area and the mean colour of the fish.
    Point,
    // Few triangles that fade into a point.
    Fading,
    // Rings of the control cage.
    FewTriangles,
    // The control mesh (paper, section 6).
    ControlMesh,
    // The limit surface, as the two levels that follow.
    Mesh,
    Hero,
    CloseUp,
};
inline constexpr std::size_t kDetailLevels = 7;

// The level of a fish, and how far it has changed from the next coarser one.
struct Detail {
    DetailLevel level = DetailLevel::Point;
    // 0: looks like the next coarser level; 1: entirely this level. It changes continuously, so
    // that no change of level is seen.
    float blend = 1.0F;
};

// The least size of a fish at each level: pixels of the wall that it would fill from nose to tail,
// seen from the side.
using DetailLimits = std::array<float, kDetailLevels>;
// The limits for a tier of quality. fineness divides those of the meshes: 1 is normal, larger
// values give finer meshes to smaller fish. Positive.
[[nodiscard]] DetailLimits detailLimits(float fineness);

// The shared eye and the angle of the wall's finest pixel. A level of detail may depend on these
// alone, so that neighbours, and a node that has just started, draw the same fish alike.
struct SharedView {
    glm::vec3 eyeMetres{};
    float pixelRadians = 0.0016F;
};
// The level of a fish at a place of the world; never finer than `finest`.
[[nodiscard]] Detail detailOf(const SharedView& view,
                              const DetailLimits& limits,
                              DetailLevel finest,
                              glm::vec3 placeMetres,
                              float lengthMetres);
// Radius of a ball about the fish's place that contains all that is drawn of it, metres. A far fish
// is drawn as a point, which may be larger than the fish.
[[nodiscard]] float marginOf(const SharedView& view,
                             glm::vec3 placeMetres,
                             float lengthMetres,
                             float reachBodyLengths);

}  // namespace aquarama::surface
