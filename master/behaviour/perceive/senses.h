// SPDX-License-Identifier: Apache-2.0
// What one fish perceives at one thought (Tu 1996, chapter 4; docs/minds.md). World axes, metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive/neighbours.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

struct Sighting {
    std::uint32_t object = fish::kNobody;  // fish, or particle of food
    glm::vec3 offset{};                    // from the body's middle
    float distance = std::numeric_limits<float>::infinity();
    bool hunting = false;  // of a predator: it is after somebody
    [[nodiscard]] bool seen() const { return object != fish::kNobody; }
};

inline constexpr std::size_t kMostPredators = 4;

struct Senses {
    // Of itself.
    glm::vec3 position{};
    glm::vec3 heading{1, 0, 0};
    float speed = 0;   // metres a second
    float length = 0;  // metres

    Neighbours schoolmates;    // nearest in view, of its own species
    Neighbours others;         // nearest in view, of any other: one gives way to them
    Sighting collision;        // the fish most of whose middle line is in the sensitivity box
    float collisionShare = 0;  // how much of it
    std::array<Sighting, kMostPredators> predators;  // nearest first, not hidden
    std::size_t predatorCount = 0;
    Sighting prey;  // the one of least cost (predators)
    Sighting mate;  // nearest of its species and the other sex that is willing
    Sighting food;  // nearest particle, seen or smelt
    float submarineMetres = std::numeric_limits<float>::infinity();
    // Where the surroundings and the submarine push; its length is 0 in the open and from 1 on only
    // turning away matters.
    glm::vec3 push{};
    float urgency = 0;
    float hurry = 0;  // of who is in the way of a submarine that comes on, 0 to 1
    float light = 1;  // 0 to 1, where it is
    float celsius = 26;
    // How far light or warmth are outside what its habits like, in the whole light or in ten
    // degrees; below 0 it is at ease by so much.
    float discomfort = -1;
    float betterUp = 0;  // where its habits are better met: 1 up, -1 down, 0 nowhere in its water
};

}  // namespace aquarama::behaviour
