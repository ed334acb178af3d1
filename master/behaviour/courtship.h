// SPDX-License-Identifier: Apache-2.0
// The courtship of a pair that wants one another (Tu 1996, section 5.6.6): he loops before her
// while she hovers and bobs, they circle, she rises and he follows from below, he nuzzles her belly
// and they spawn. Each knows only its own stage and what it sees of the other.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// Of Mind::stage while a fish would mate.
enum class CourtshipStage : std::uint8_t {
    Follow,   // the other courts nobody yet
    Impress,  // the other courts a third
    Loop,     // from here on both court each other
    Circle,
    Ascend,
    Nuzzle,
};

// What one of two sees of both.
struct Couple {
    glm::vec3 offset{};  // from self to the mate, metres
    glm::vec3 matesHeading{1, 0, 0};
    float matesSpeed = 0;  // metres a second
    float length = 0;      // the mean of theirs, metres
    bool isFemale = false;
    bool turnsLeft = false;  // both the same way round
};

// Whether a stage has reached its goal after `ticks` in it. Of Follow and Impress: never; that is
// the other's to say.
[[nodiscard]] bool isComplete(CourtshipStage stage,
                              const Couple& couple,
                              glm::vec3 heading,
                              std::uint32_t ticks);
// How long it may take before the fish gives up.
[[nodiscard]] std::uint32_t longestTicks(CourtshipStage stage);

[[nodiscard]] fish::Course court(const Situation& situation,
                                 const fish::Mind& mind,
                                 const Couple& couple,
                                 CourtshipStage stage);

}  // namespace aquarama::behaviour
