// SPDX-License-Identifier: Apache-2.0
// Little-endian numbers to and from bytes; the reader never passes its end and says so by `ok()`.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::motion {

class ByteWriter {
  public:
    template <class Unsigned>
    void unsignedNumber(Unsigned value) {
        for (std::size_t byte = 0; byte < sizeof(Unsigned); ++byte) {
            bytes_.push_back(
                static_cast<std::byte>(static_cast<std::uint64_t>(value) >> 8U * byte));
        }
    }
    void int16(std::int16_t value) { unsignedNumber(static_cast<std::uint16_t>(value)); }
    void float32(float value) { unsignedNumber(std::bit_cast<std::uint32_t>(value)); }
    template <class Container>
    void characters(const Container& text) {
        for (const auto character : text) unsignedNumber(static_cast<std::uint8_t>(character));
    }

    [[nodiscard]] std::vector<std::byte> take() && { return std::move(bytes_); }
    [[nodiscard]] std::span<const std::byte> written() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

// After the first number that is not wholly there, every number is zero and ok() is false.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class Unsigned>
    [[nodiscard]] Unsigned unsignedNumber() {
        std::uint64_t value = 0;
        const std::span<const std::byte> bytes = take(sizeof(Unsigned));
        for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
            value |= std::to_integer<std::uint64_t>(bytes[byte]) << 8U * byte;
        }
        return static_cast<Unsigned>(value);
    }
    [[nodiscard]] std::int16_t int16() {
        return static_cast<std::int16_t>(unsignedNumber<std::uint16_t>());
    }
    [[nodiscard]] float float32() { return std::bit_cast<float>(unsignedNumber<std::uint32_t>()); }
    [[nodiscard]] std::string characters(std::size_t count) {
        std::string text;
        for (const std::byte byte : take(count)) text += std::to_integer<char>(byte);
        return text;
    }

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] std::size_t remaining() const { return rest_.size(); }

  private:
    std::span<const std::byte> take(std::size_t count) {
        ok_ = ok_ && count <= rest_.size();
        if (!ok_) return {};
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

    std::span<const std::byte> rest_;
    bool ok_ = true;
};

// The action repertoire of a species: one cycle of each action, captured from the biomechanical
// fish (paper, section 3).

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

// Where a presented phase lies between two samples of the cycle.

struct PhaseSample {
    std::size_t before = 0, after = 0;
    float share = 0.0F;  // of `after`
};

// A phase outside of [0, 1) plays its nearest end.
[[nodiscard]] inline PhaseSample sampleAt(float phase) {
    const float at = std::clamp(phase, 0.0F, 1.0F) * kPhases;
    const auto before = static_cast<std::size_t>(at);
    return {before % kPhases, (before + 1) % kPhases, at - static_cast<float>(before)};
}

[[nodiscard]] inline const ActionSegment& segmentOf(const Repertoire& repertoire,
                                                    std::uint32_t segment) {
    return repertoire.segments[std::min<std::size_t>(segment, kActions - 1)];
}

}  // namespace aquarama::motion
