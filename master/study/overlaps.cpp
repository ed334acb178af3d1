// SPDX-License-Identifier: Apache-2.0
#include "master/study/overlaps.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

namespace aquarama::study {

namespace {

// Intervals along a middle line between sampled points.
constexpr int kSamples = 32;

// A point of the middle line; `behindNose` is a share of the length.
glm::vec3 pointOf(const Rod& rod, float behindNose) {
    return rod.origin + rod.heading * (rod.length * (fish::kNoseBodyLengths - behindNose));
}

// Distance from a point to the middle line of a rod.
float distanceTo(const Rod& rod, glm::vec3 point) {
    const float along = glm::dot(point - rod.origin, rod.heading);
    const float nearest = std::clamp(
        along, (fish::kNoseBodyLengths - 1) * rod.length, fish::kNoseBodyLengths * rod.length);
    return glm::distance(point, rod.origin + rod.heading * nearest);
}

// Quick test by the distance of the origins. The tail is the longer part behind the origin, so that
// nothing of a body is farther away than it.
bool mayTouch(const Rod& a, const Rod& b, float room) {
    const float reach = (1 - fish::kNoseBodyLengths) * (a.length + b.length) + room;
    const glm::vec3 apart = b.origin - a.origin;
    return glm::dot(apart, apart) < reach * reach;
}

}  // namespace

void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods) {
    rods.resize(view.size());
    for (std::size_t fish = 0; fish < view.size(); ++fish) {
        const float length = view.shows(fish, fish::kAway) ? 0.0F : view.fish[fish].length;
        rods[fish] = {
            view.position(fish), view.heading(fish), length, length * halfWidths[view.kind[fish]]};
    }
}

float distanceBetween(const Rod& a, const Rod& b) {
    float nearest = distanceTo(b, pointOf(a, 0));
    for (int i = 1; i <= kSamples; ++i)
        nearest = std::min(nearest, distanceTo(b, pointOf(a, static_cast<float>(i) / kSamples)));
    return nearest;
}

float overlapOf(const Rod& a, const Rod& b) {
    if (a.length == 0 || b.length == 0) return 0;
    const float room = a.halfWidth + b.halfWidth;
    if (!mayTouch(a, b, room)) return 0;
    const Rod& shorter = a.length < b.length ? a : b;
    const Rod& other = a.length < b.length ? b : a;
    int inside = 0;
    for (int i = 0; i <= kSamples; ++i)
        inside += distanceTo(other, pointOf(shorter, static_cast<float>(i) / kSamples)) < room;
    return static_cast<float>(inside) / (kSamples + 1);
}

std::span<const BodyOverlap> OverlapLog::note(Tick tick,
                                              std::span<const Rod> rods,
                                              std::span<const fish::Intention> intentions) {
    assert(rods.size() == intentions.size());
    fresh_.clear();
    for (std::uint32_t a = 0; a < rods.size(); ++a)
        for (std::uint32_t b = a + 1; b < rods.size(); ++b)
            if (const float share = overlapOf(rods[a], rods[b]); share > 0)
                meet({.a = a,
                      .b = b,
                      .intentionOfA = intentions[a],
                      .intentionOfB = intentions[b],
                      .from = tick},
                     share);
    // Pairs that did not meet at this glance have ended.
    std::erase_if(open_, [&](const auto& entry) {
        if (entry.second.last.value == tick.value) return false;
        ended_.push_back(entry.second.overlap);
        return true;
    });
    return fresh_;
}

// Begins or continues the overlap of a pair; a glance stands for all ticks since the last one.
void OverlapLog::meet(const BodyOverlap& overlap, float share) {
    const auto [entry, isNew] =
        open_.try_emplace({overlap.a, overlap.b}, Open{overlap, 0, overlap.from});
    if (isNew) fresh_.push_back(overlap);
    Open& open = entry->second;
    open.last = overlap.from;
    open.overlap.ticks += between_;
    open.overlap.deepest = std::max(open.overlap.deepest, share);
    open.deepRun = share > kDeepShare ? open.deepRun + between_ : 0;
    open.overlap.deepTicks = std::max(open.overlap.deepTicks, open.deepRun);
    pairTicks_ += between_;
}

std::vector<BodyOverlap> OverlapLog::all() const {
    std::vector<BodyOverlap> all = ended_;
    for (const auto& [pair, open] : open_) all.push_back(open.overlap);
    return all;
}

}  // namespace aquarama::study
