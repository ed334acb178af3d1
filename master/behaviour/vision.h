// SPDX-License-Identifier: Apache-2.0
// Vision (Tu 1996, section 4.2): one eye in the middle of the head, a field of view of 300 degrees,
// a radius bounded by the clarity of the water; and the sense of a collision to come.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Factor on the distance from which a body is seen: 1 for small ones, length / kLargeBodyMetres for
// others, at most kMostConspicuous.
inline constexpr float kMostConspicuous = 2.5F;
[[nodiscard]] float conspicuousness(float lengthMetres);

// Distance from which a fish of this length sees a body so conspicuous, metres.
[[nodiscard]] float sightMetres(const fish::SpeciesParameters& parameters,
                                float lengthMetres,
                                float conspicuous,
                                float clarityMetres);

// The line from an eye to an object. Testing what hides an object is costly: it is done only for
// predators and the focus of attention.
struct SightLine {
    glm::vec3 from, offset;
    // Whether it passes a point nearer than `radius`.
    [[nodiscard]] bool passes(glm::vec3 centre, float radius) const;
};
// Whether rock or sand, or below one body, stands on the line. O(rocks about the line) and O(1).
[[nodiscard]] bool terrainHides(const place::Obstacles& obstacles, const SightLine& ray);
[[nodiscard]] bool bodyHides(const fish::FishView& view, std::uint32_t body, const SightLine& ray);

// Whether rock, sand or a large body stands between a fish and an object, which may be a fish.
[[nodiscard]] bool isHidden(const Environment& environment,
                            std::uint32_t fish,
                            std::uint32_t object,
                            const SightLine& ray);

// Which fish is about to be in the way (Tu 1996, section 5.4): the one with the largest share of
// its middle line in the sensitivity box about this fish.

// A box about the origin of a body frame, in metres: ahead and behind (x), up and down (y), aside
// (z).
struct Box {
    float ahead = 0, behind = 0, up = 0, aside = 0;
};

// The share of the straight line from `nose` to `tail`, in the frame of the box, that is inside.
[[nodiscard]] float shareInside(const Box& box, glm::vec3 nose, glm::vec3 tail);

// Writes Senses::collision and collisionShare, from the neighbours already in `senses` and from
// large bodies.
void feelCollision(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   Senses& senses);

}  // namespace aquarama::behaviour
