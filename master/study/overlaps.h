// SPDX-License-Identifier: Apache-2.0
// Overlaps of bodies: which fish, how deep and for how long. Bodies are taken as straight rods with
// round ends. Everything here only reads the world, after a tick, on the thread of the world.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::study {

// A body as a straight line with a half-width around it. A fish that is away has length 0.
struct Rod {
    // Origin of the body frame, metres.
    glm::vec3 origin{};
    glm::vec3 heading{1, 0, 0};  // unit vector
    float length = 0;            // metres
    // Half of the greatest width of the body, metres.
    float halfWidth = 0;
};

// Writes the rods of all fish; those of fish that are away get length 0. `halfWidths` are by kind,
// in body lengths.
void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods);

// Distance between the middle lines from nose to tail, metres; sampled at 33 points of `a`.
[[nodiscard]] float distanceBetween(const Rod& a, const Rod& b);

// Share of the shorter body that is inside the other: of the points sampled along its middle line
// those nearer to the other middle line than both half-widths. 0 where they do not overlap.
[[nodiscard]] float overlapOf(const Rod& a, const Rod& b);

// One time for which two fish overlapped.
struct BodyOverlap {
    // The two fish, a < b.
    std::uint32_t a = 0, b = 0;
    // Their intentions when the overlap began.
    fish::Intention intentionOfA = fish::Intention::Wander, intentionOfB = fish::Intention::Wander;
    Tick from;
    // How long they overlapped at all.
    std::uint64_t ticks = 0;
    // Longest run with a share over kDeepShare.
    std::uint64_t deepTicks = 0;
    // Greatest share of the shorter body.
    float deepest = 0;
};

// An overlap over this share of the shorter body is a deep one.
inline constexpr float kDeepShare = 0.25F;

// Tracks overlaps from one glance to the next. A glance is O(fish^2). Overlaps shorter than the
// time between two glances may be missed.
class OverlapLog {
  public:
    // Begins empty; `ticksBetweenGlances` is the time between two calls of note().
    explicit OverlapLog(std::uint64_t ticksBetweenGlances) : between_(ticksBetweenGlances) {}
    // Notes one glance and returns the overlaps that began at it, valid until the next call. Rods
    // and intentions are by fish.
    std::span<const BodyOverlap> note(Tick tick,
                                      std::span<const Rod> rods,
                                      std::span<const fish::Intention> intentions);

    // All overlaps, those that have ended first.
    [[nodiscard]] std::vector<BodyOverlap> all() const;
    // Ticks of overlap, summed over pairs.
    [[nodiscard]] std::uint64_t pairTicks() const { return pairTicks_; }

  private:
    // An overlap that still goes on.
    struct Open {
        BodyOverlap overlap;
        std::uint64_t deepRun = 0;
        Tick last;
    };
    void meet(const BodyOverlap& overlap, float share);

    std::uint64_t between_;
    std::uint64_t pairTicks_ = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Open> open_;
    std::vector<BodyOverlap> ended_;
    std::vector<BodyOverlap> fresh_;
};

}  // namespace aquarama::study
