// SPDX-License-Identifier: Apache-2.0
// Company: whom a fish at ease keeps near (a partner, or a larger fish that it shadows), and how
// neighbours steer a fish.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

// The partner in a species that lives in pairs: fish pair up by index, two by two. kNobody for the
// last one of an odd number. `fish` is of this species.
[[nodiscard]] std::uint32_t partnerOf(const fish::SpeciesParameters& parameters,
                                      std::uint32_t fish);

// The fish that this one shadows now, swimming over its back, or kNobody. In every 50 s it shadows
// for 10 to 40 s one fish, drawn from the species that it likes to shadow and near enough to be
// seen.
[[nodiscard]] std::uint32_t shadowedBy(const Situation& situation);

// The course that stays with the shadowed fish or the partner; none where the fish goes alone.
[[nodiscard]] std::optional<fish::Course> keptCompany(const Situation& situation);

// The influence of neighbours on a fish: separation, alignment and cohesion (Reynolds 1987; Huth &
// Wissel 1992).

// Wanted distance between the middles of neighbours, in body lengths: on the way, and when a
// predator is near.
inline constexpr float kSpacing = 0.9F;
inline constexpr float kAlarmedSpacing = 0.65F;

// The influence of all neighbours of one fish. Directions in the world frame; weights in pullOf().
struct Company {
    glm::vec3 separation{}, alignment{}, cohesion{};
    // Mean speed of the schoolmates, in body lengths a second; 0 where there are none.
    float speed = 0;
    // Change of speed to close up, and to stay behind those ahead, both in body lengths a second.
    float hurry = 0;
    float brake = 0;
    // Whether so many of the schoolmates have turned off the course of the fish that it turns too.
    bool hasTurned = false;
};

// How a school keeps together at a time of day, as factors (master/behaviour/hours.h).
struct Togetherness {
    float spacing = 1, alignment = 1, cohesion = 1;
};

// Schoolmates act by all three rules; fish of other species only by separation. `alarm` is 0 at
// ease and 1 where a predator is near and all close up.
[[nodiscard]] Company companyOf(const fish::FishView& view,
                                const Senses& senses,
                                std::uint32_t fish,
                                float alarm,
                                const Togetherness& together = {});

// The weighted sum of the three rules, in units of the unit vector of the present course.
[[nodiscard]] glm::vec3 pullOf(const Company& company);

// Direction away from all neighbours that are too near, except prey; in the same units.
[[nodiscard]] glm::vec3 roomFrom(const Situation& situation);

}  // namespace aquarama::behaviour
