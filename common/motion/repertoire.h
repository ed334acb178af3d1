// SPDX-License-Identifier: Apache-2.0
// The action repertoire of a species: one cycle of each action, captured from the biomechanical
// fish (paper, section 3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::motion {

inline constexpr int kPhases = 64;  // samples of one cycle; phase k is at k / 64 of the period

// The order of the segments in every repertoire: an action is its index here.
enum class Action : std::uint8_t {
    ForwardSlow,
    ForwardMedium,
    ForwardFast,
    TurnLeftGradual,
    TurnLeftSharp,
    TurnRightGradual,
    TurnRightSharp,
    Glide,
};
inline constexpr int kCapturedActions = 7;  // all but the last are captured
inline constexpr int kActions = 8;
inline constexpr int kForwardGaits = 3;           // the first of them
[[nodiscard]] const char* nameOf(Action action);  // "forward_slow", ...

// The change of the body frame from one phase to the next, in the body frame at its start: B' = B *
// increment (eq. 6 and 7 with the remedy of a body-frame rotation, R' = R * rotation). Translation
// in body lengths.
struct FrameIncrement {
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 translation{};
};

using ControlPointPose = std::array<std::array<std::int16_t, 3>, body::kControlPoints>;
using NodalPose = std::array<std::array<std::int16_t, 3>, body::kNodalPoints>;

// Poses are 16-bit: position in the body frame, in body lengths, is component * kPoseUnit.
inline constexpr float kPoseUnit = 1.0F / 32767.0F;

struct ActionSegment {
    float periodSeconds = 0.0F;  // of one cycle, for the recorded fish
    bool playsToEnd =
        false;  // a turn is entered at phase 0 and left at its end; the others anywhere
    std::array<FrameIncrement, kPhases> increments{};  // from phase k to k + 1
    std::array<NodalPose, kPhases> nodes{};            // deformation d at phase k (eq. 8)
    std::vector<ControlPointPose> controlPoints;  // s at phase k (eq. 9): kPhases of them, or none
};

// How the speed v of a fish goes after that of what it plays, p, in body lengths and seconds:
//     dv/dt = swimDrag |p| (p - v)     while the tail beats: it meets the water at a speed near p,
//     dv/dt = -glideDrag v |v|         in a glide or at rest, by the square of the speed;
// in both, fins that are spread to a share of one take away share * brakeRate * v. (The paper
// leaves this open; the law is ours.)
struct SpeedResponse {
    std::array<float, kForwardGaits> swimDrag{};  // 1 / body length; turns have that of medium
    float glideDrag = 0.0F;                       // 1 / body length
    float brakeRate = 0.0F;                       // 1 / s
};

struct Repertoire {
    std::string species;
    float recordedLengthMetres = 0.0F;
    SpeedResponse response;
    std::array<ActionSegment, kActions> segments{};
};

// Fills in Action::Glide, which is not captured: the relaxed pose in which a gradual turn ends,
// straight on at the speed of forward_medium. Motion warps lead into it and out of it (paper,
// section 4.2).
void addGlide(Repertoire& repertoire);

// The file: "AQREP", version, length, species, speed response, captured segments, SHA-256 of all
// that precedes it; little-endian.
[[nodiscard]] std::vector<std::byte> encodeRepertoire(const Repertoire& repertoire);

// With its glide. Throws Error, naming `source`, when the bytes are truncated, altered, of another
// version or out of bounds; sizes are checked before memory is taken.
[[nodiscard]] Repertoire decodeRepertoire(std::span<const std::byte> bytes,
                                          const std::string& source);

}  // namespace aquarama::motion
