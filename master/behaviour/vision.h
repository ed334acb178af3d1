// SPDX-License-Identifier: Apache-2.0
// How far and past what a fish sees (Tu 1996, section 4.2): one eye in the middle of the head, a
// field of 300 degrees, a radius that the water's clarity bounds.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// What is large is seen from farther off: 1 for the small, its length per kLargeBodyMetres for
// others, at most kMostConspicuous.
inline constexpr float kMostConspicuous = 2.5F;
[[nodiscard]] float conspicuousness(float lengthMetres);

// From how far a fish of this length sees what is so conspicuous, metres.
[[nodiscard]] float sightMetres(const fish::SpeciesParameters& parameters,
                                float lengthMetres,
                                float conspicuous,
                                float clarityMetres);

// From an eye to what it looks at. Rays are costly: they are cast only to predators and to the
// focus of attention.
struct SightLine {
    glm::vec3 from, offset;
    // Whether it comes so near to a point.
    [[nodiscard]] bool passes(glm::vec3 centre, float radius) const;
};
[[nodiscard]] bool terrainHides(const surroundings::Obstacles& obstacles, const SightLine& ray);
[[nodiscard]] bool bodyHides(const fish::FishView& view, std::uint32_t body, const SightLine& ray);

// Whether rock, sand or a large body stands between a fish and what it looks at.
[[nodiscard]] bool isHidden(const Environment& environment,
                            std::uint32_t fish,
                            std::uint32_t object,
                            const SightLine& ray);

// Which fish is about to be in the way (Tu 1996, section 5.4): the one most of whose middle line
// lies in the box about this fish to which it is sensitive.

// About the origin of a body frame: ahead (x), above and below (y), aside (z); metres.
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
