// SPDX-License-Identifier: Apache-2.0
// The shape and the motion of fins. A fin is a ruled patch: p runs along its base from front (0) to
// rear (1), q along each ray from base (0) to edge (1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/body/face.h"
#include "common/body/fin_motion.h"
#include "common/body/fish_body.h"
#include "common/config/species.h"

namespace aquarama::body {

// A fin as drawn in the species file, in the plane of the body: (s, y) in body lengths, y up. Base
// and edge are monotone curves through the drawn points.
class FinPatch {
  public:
    // The fin of a species file.
    explicit FinPatch(const config::Fin& fin);
    // The point (s, y) of ray p at q; outside of [0, 1] p takes the nearest ray.
    [[nodiscard]] glm::vec2 at(float p, float q) const;
    // The p of the ray whose base is at station s. The stations of the base must rise with p.
    [[nodiscard]] float rayAtStation(float s) const;
    // As at(), for a paddle: with Fin::round = 1 the fin is a fifth wider than drawn at 0.4 of its
    // length and narrows towards its edge; with 0 it is as drawn.
    [[nodiscard]] glm::vec2 paddleAt(float p, float q) const;
    // How far a paired fin at rest stands off the flank.
    [[nodiscard]] float angleRadians() const { return angleRadians_; }
    [[nodiscard]] glm::vec2 baseFront() const { return at(0, 0); }
    [[nodiscard]] glm::vec2 baseRear() const { return at(1, 0); }

  private:
    // The curves, finely sampled: p is even along the drawn points, not along the length.
    std::vector<float> p_;
    std::vector<float> baseS_, baseY_, edgeS_, edgeY_;
    float angleRadians_;
    float round_;
};

// Fins that row, flutter, ripple and fold relative to the body: a pure function of time and of what
// a node knows about a fish. This is the reference that fish_fins.glsl is tested against.
// (docs/appendices/look.md, "Fins")

// The pectoral fin of the right side. Axes are unit vectors: tailwards, up, right; the root is in
// (s, y, z) of the rest shape.
struct PectoralFin {
    glm::vec3 root{};          // its middle
    glm::vec3 hinge{};         // about it the fin leaves the flank
    glm::vec3 ray{};           // from the root to the middle of the margin, at rest
    glm::vec3 chord{};         // along the root
    glm::vec3 stroke{};        // about it the fin beats
    float span = 0, area = 0;  // body lengths, and squared
    // FinPose::open of a fin that rows, that lies on the flank, and that brakes.
    float rowing = 0, folded = 0, spread = 0;
};
[[nodiscard]] PectoralFin pectoralFinOf(const config::Species& species);

// The constants of the motion of a species' fins. cage: of this species at rest.
[[nodiscard]] FinTable makeFinTable(const config::Species& species, const ControlCage& cage);

// The inputs of the motion of one fish's fins at one moment.
struct FinDrive {
    float seconds = 0;        // of the show, modulo kFinSeconds
    float speed = 0;          // body lengths a second; backwards is negative
    float tilt = 0;           // height of its right side: sine of its roll to the left
    float spread = 0;         // 0 to 1: how far its pectoral fins brake
    FinPose left{}, right{};  // of its pectoral fins, as captured
    FacePose face{};
    // Id of the fish, which gives each its own phase.
    std::uint32_t id = 0;
    // Phase of its tail beat and of the beat that a motion warp leaves, in cycles; weight is the
    // share of the first, 1 when no warp is under way.
    float phase = 0, fromPhase = 0, weight = 1;
};

// The displacement of a control point from where the body alone would place it: tailwards, up, to
// the right; body lengths. drift: how fast the point goes to the right, body lengths in a radian of
// the beat; it bends the tail fin.
[[nodiscard]] glm::vec3 finOffset(const FinTable& fins,
                                  std::size_t point,
                                  const FinDrive& drive,
                                  float drift);

// For each control point the angle, in radians, by which the direction to its right is turned from
// the body frame's z axis towards its x axis. Fin offsets are given in that turned frame. headings:
// one element for each vertex of the cage.
void headingsOf(const FishBody& body, const NodalPoints& nodes, std::span<float> headings);

// An offset (tailwards, up, right) of finOffset() as a vector of the body frame.
[[nodiscard]] glm::vec3 turned(glm::vec3 offset, float heading);

}  // namespace aquarama::body
