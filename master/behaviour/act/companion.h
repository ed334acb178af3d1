// SPDX-License-Identifier: Apache-2.0
// Whom a fish at ease keeps near: its partner, or the back of a larger fish.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

// Fish of one species that live in pairs: every two of them, in order; the odd one out is alone.
[[nodiscard]] std::uint32_t partnerOf(const fish::SpeciesParameters& parameters,
                                      std::uint32_t fish);

// The fish over whose back this one hangs now: for 10 to 40 of every 50 s, one of those it likes to
// shadow that is near enough to be seen.
[[nodiscard]] std::uint32_t shadowedBy(const Situation& situation);

// The course to keep with whom the fish keeps now; nothing for one that goes alone.
[[nodiscard]] std::optional<fish::Course> keptCompany(const Situation& situation);

}  // namespace aquarama::behaviour
