// SPDX-License-Identifier: Apache-2.0
// Who perceives: handed through the senses of one act of perception.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/behaviour/vision.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// One act of perception: who looks, at what, and where the result goes.
struct Onlooker {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    std::uint32_t fish;
    const fish::Mind& mind;
    Senses& senses;
    fish::Aim aim = fish::aimOf(mind);

    // All fish, as others see them.
    [[nodiscard]] const fish::FishView& view() const { return *environment.view; }
    // How far it can see in this water, metres.
    [[nodiscard]] float clarity() const { return environment.surroundings->clarityMetres; }
    // How far it sees a body so conspicuous, metres.
    [[nodiscard]] float sight(float conspicuous) const {
        return sightMetres(parameters, senses.length, conspicuous, clarity());
    }
    [[nodiscard]] bool isHidden(const Sighting& sighting) const {
        return behaviour::isHidden(
            environment, fish, sighting.object, {senses.position, sighting.offset});
    }
    // Sighting of another fish, without asking whether something hides it.
    [[nodiscard]] Sighting sightingOf(std::uint32_t other) const {
        return behaviour::sightingOf(view(), other, senses.position);
    }
};

}  // namespace aquarama::behaviour
