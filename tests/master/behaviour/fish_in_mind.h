// SPDX-License-Identifier: Apache-2.0
// A mind for tests of decisions: what it senses and feels is put into it, nothing is perceived.
#pragma once

#include <limits>

#include "master/behaviour/intention_generator.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

struct FishInMind {
    explicit FishInMind(config::Role role = config::Role::Prey) {
        parameters.habits.role = role;
        parameters.habits.fear.from = 0.25F;
        parameters.habits.fear.alone = 0.6F;
        if (role == config::Role::Pacifist) parameters.habits.libidoPerSecond = 0.003F;
        if (role == config::Role::Predator) parameters.hunts = 1;
        if (role == config::Role::Prey) {
            mind.likes = fish::kLikesSchooling;
            senses.schoolmates.count = 3;
        }
    }

    void frighten(float fear, float greatest) {
        feelings.fear = fear;
        feelings.greatestFear = greatest;
        senses.predators[0] = {40, {1, 0, 0}, 1};
        senses.predatorCount = 1;
    }
    void calm() {
        feelings.fear = feelings.greatestFear = 0;
        senses.predatorCount = 0;
    }
    void showFood(std::uint32_t particle) { senses.food = {particle, {1, 0, 0}, 1}; }
    void showPrey(std::uint32_t fish) { senses.prey = {fish, {1, 0, 0}, 1}; }
    void showMate(std::uint32_t fish) { senses.mate = {fish, {1, 0, 0}, 1}; }
    void threaten(std::uint32_t fish, float share = 0.3F) {
        senses.collision = {fish, {0.2F, 0, 0}, 0.2F};
        senses.collisionShare = share;
    }
    void clearTheWay() {
        senses.collision = {};
        senses.collisionShare = 0;
        senses.urgency = 0;
    }

    // One thought without perception, feeling and routine.
    fish::Intention think() {
        fish::passTime(parameters, fish::kTicksBetweenThoughts, mind);
        const Decision decision = decide(parameters, mind, senses, feelings);
        remember(mind, decision);
        return mind.intention;
    }
    fish::Intention thinkFor(float seconds) {
        for (int thought = 0; thought < static_cast<int>(seconds * 7.5F); ++thought) think();
        return mind.intention;
    }
    [[nodiscard]] Weighed rule(PriorityRule which) const {
        return reason(parameters, mind, senses, feelings).rules[static_cast<std::size_t>(which)];
    }

    fish::SpeciesParameters parameters;
    fish::Mind mind;
    Senses senses;
    fish::Feelings feelings;
};

}  // namespace aquarama::behaviour
