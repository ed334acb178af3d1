// SPDX-License-Identifier: Apache-2.0
// Whom a fish at ease keeps near: its partner, or the back of a larger fish.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

// Fish of one species that live in pairs: every two of them, in order; the odd one out is alone.
[[nodiscard]] std::uint32_t partnerOf(const fish::SpeciesParameters& parameters,
                                      std::uint32_t fish);

// The fish over whose back this one hangs now: for 10 to 40 of every 50 s, one of those it likes to
// shadow that is near enough to be seen.
[[nodiscard]] std::uint32_t shadowedBy(const Situation& situation);

// The course to keep with whom the fish keeps now; nothing for one that goes alone.
[[nodiscard]] std::optional<fish::Course> keptCompany(const Situation& situation);

// What the fish next to one ask of it: room, a common course, and not to be left behind (Reynolds
// 1987; Huth & Wissel 1992).

// Between the middles of neighbours, in body lengths: at ease, and when a predator is about.
inline constexpr float kSpacing = 0.9F;
inline constexpr float kAlarmedSpacing = 0.65F;

struct Company {
    glm::vec3 separation{}, alignment{}, cohesion{};
    float speed = 0;  // mean of theirs, body lengths a second; 0: alone
    float hurry = 0;  // to close up, body lengths a second
    float brake = 0;  // for those just ahead, body lengths a second
};

// Of the same species one keeps with; to others one only gives way. alarm: 0 at ease, 1 where a
// predator is about and all close up.
[[nodiscard]] Company companyOf(const fish::FishView& view,
                                const Senses& senses,
                                std::uint32_t fish,
                                float alarm);

// The three together, against the unit vector of one's own course.
[[nodiscard]] glm::vec3 pullOf(const Company& company);

// Away from all that are too near, whoever they are but for its prey, against the same.
[[nodiscard]] glm::vec3 roomFrom(const Situation& situation);

}  // namespace aquarama::behaviour
