// SPDX-License-Identifier: Apache-2.0
// The courtship of a pair (Tu 1996, section 5.6.6): the male loops before the female while she
// hovers and bobs; they circle; she rises and he follows from below; he nuzzles her belly and they
// spawn. Each fish knows only its own stage and what it sees of the other. A species that spawns in
// a rush begins with the rise, at a faster gait, and several males may follow one female.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// Values of Mind::stage while a fish mates, in order.
enum class CourtshipStage : std::uint8_t {
    // The other fish courts nobody yet.
    Follow,
    // The other fish courts a third one.
    Impress,
    // In this and all later stages both court each other.
    Loop,
    Circle,
    Ascend,
    Nuzzle,
};

// The view of one fish of a pair on both.
struct Couple {
    // Offset from the fish to its mate, metres.
    glm::vec3 offset{};
    glm::vec3 matesHeading{1, 0, 0};
    // Metres a second.
    float matesSpeed = 0;
    // Mean of both lengths, metres.
    float length = 0;
    bool isFemale = false;
    // Sense in which they circle; the same for both fish.
    bool turnsLeft = false;
};

// Whether a stage has reached its goal after `ticks` in it; `heading` is that of the fish. Never
// for Follow and Impress, which end when the other fish answers.
[[nodiscard]] bool isComplete(CourtshipStage stage,
                              const Couple& couple,
                              glm::vec3 heading,
                              std::uint32_t ticks);
// Ticks in a stage after which the fish gives up.
[[nodiscard]] std::uint32_t longestTicks(CourtshipStage stage);

// The course of one fish in a stage; what it does depends on its sex.
[[nodiscard]] fish::Course court(const Situation& situation,
                                 const fish::Mind& mind,
                                 const Couple& couple,
                                 CourtshipStage stage);

}  // namespace aquarama::behaviour
