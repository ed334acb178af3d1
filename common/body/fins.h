// SPDX-License-Identifier: Apache-2.0
// A fin as a ruled patch: p runs along its base, q along each ray from base (0) to edge (1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/config/species.h"

namespace aquarama::body {

class FinPatch {
  public:
    explicit FinPatch(const config::Fin& fin);
    [[nodiscard]] glm::vec2 at(float p, float q) const;  // (s, y)
    [[nodiscard]] float rayAtStation(float s) const;     // the p whose base is at s
    // The same of a paddle: as round as the fin is, it is widest at half its length.
    [[nodiscard]] glm::vec2 paddleAt(float p, float q) const;
    [[nodiscard]] float angleRadians() const { return angleRadians_; }
    [[nodiscard]] glm::vec2 baseFront() const { return at(0, 0); }
    [[nodiscard]] glm::vec2 baseRear() const { return at(1, 0); }

  private:
    // Finely sampled, because p is even along the drawn points and not along the length.
    std::vector<float> p_;
    std::vector<float> baseS_, baseY_, edgeS_, edgeY_;
    float angleRadians_;
    float round_;
};

// Fins that row, flutter, ripple and fold beside the body that bears them: a pure function of time
// and of what a node knows of a fish. The reference of fish_fins.glsl.
// (docs/appendices/look.md, "Fins")

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
