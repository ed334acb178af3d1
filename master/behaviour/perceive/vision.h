// SPDX-License-Identifier: Apache-2.0
// How far and past what a fish sees (Tu 1996, section 4.2): one eye in the middle of the head, a
// field of 300 degrees, a radius that the water's clarity bounds.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive/environment.h"
#include "master/fish/species_parameters.h"

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

}  // namespace aquarama::behaviour
