// SPDX-License-Identifier: Apache-2.0
// Fins that row, flutter, ripple and fold beside the body that bears them: a pure function of time
// and of what a node knows of a fish. The reference of fish_fins.glsl.
// (docs/appendices/look.md, "Fins")
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "common/body/fin_table.h"
#include "common/body/fish_body.h"
#include "common/config/species.h"

namespace aquarama::body {

// cage: of this species at rest.
[[nodiscard]] FinTable makeFinTable(const config::Species& species, const ControlCage& cage);

inline constexpr float kFinSeconds = 10;  // after which all fins that go by the clock are as before

// What drives the fins of one fish.
struct FinDrive {
    float seconds = 0;               // of the show, modulo kFinSeconds
    float speed = 0;                 // body lengths a second; backwards is negative
    float climb = 0;                 // sine of its pitch, up is positive
    std::array<float, 2> turning{};  // 0 to 1: how far it is in a turn to the left, to the right
    std::uint32_t id = 0;
    // Of its beat, in cycles; and of the one that it comes from, until the weight is 1.
    float phase = 0, fromPhase = 0, weight = 1;
};

// How far a control point is from where the body alone would have it: tailwards, up, to the right;
// body lengths. drift: how fast the point goes to the right, body lengths in a radian of the beat.
[[nodiscard]] glm::vec3 finOffset(const FinTable& fins,
                                  std::size_t point,
                                  const FinDrive& drive,
                                  float drift);

// Of each control point the angle by which its right is turned from the body frame's z towards its
// x. Fins move in that frame.
void headingsOf(const FishBody& body, const NodalPoints& nodes, std::span<float> headings);

// tailwards, up, right to the body frame.
[[nodiscard]] glm::vec3 turned(glm::vec3 offset, float heading);

}  // namespace aquarama::body
