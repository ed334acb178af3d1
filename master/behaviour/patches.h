// SPDX-License-Identifier: Apache-2.0
// Which patch of turf a fish grazes at: a shoal goes where its first two members choose, others go
// round patches of their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/surroundings/turf.h"

namespace aquarama::behaviour {

// The patch that the fish is at or goes to; nothing where it does not graze now. One that is done
// with its patch gets the next one.
[[nodiscard]] Sighting patchFor(const Environment& environment,
                                const fish::SpeciesParameters& parameters,
                                std::uint32_t fish,
                                const fish::Mind& mind,
                                const Senses& senses);

// Whom a fish of a shoal follows from patch to patch: the first of its household, or the second
// where the first grazes at none; the fish itself where it leads, and on a loop.
[[nodiscard]] std::uint32_t leaderOf(const fish::FishView& view,
                                     const fish::SpeciesParameters& parameters,
                                     std::uint32_t fish);

}  // namespace aquarama::behaviour
