// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/loops.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "common/base/random_streams.h"
#include "common/place/place.h"

namespace aquarama::behaviour {

namespace {

constexpr std::uint32_t kFewestOfLoop = 8;

}  // namespace

Loop loopOf(const surroundings::Turf& turf, std::uint32_t seed, std::uint32_t fish) {
    assert(!turf.patches.empty());
    const std::uint32_t drawn = hashOf(seed, Stream::Loops, fish);
    const auto patches = static_cast<std::uint32_t>(turf.patches.size());
    const std::size_t count =
        std::min<std::size_t>(patches, kFewestOfLoop + drawn % (Loop::kMost - kFewestOfLoop + 1));
    const auto apart = [&](std::uint32_t one, std::uint32_t other) {
        return place::lengthOf(turf.patches[one].place - turf.patches[other].place);
    };
    // Each time the one that is farthest from those before it.
    Loop loop;
    loop.patches[loop.count++] = hashOf(drawn, 1) % patches;
    std::vector<float> nearest(patches, std::numeric_limits<float>::infinity());
    while (loop.count < count) {
        const std::uint32_t latest = loop.patches[loop.count - 1];
        for (std::uint32_t patch = 0; patch < patches; ++patch)
            nearest[patch] = std::min(nearest[patch], apart(patch, latest));
        loop.patches[loop.count++] =
            static_cast<std::uint32_t>(std::ranges::max_element(nearest) - nearest.begin());
    }
    // After each the nearest of those that are left.
    for (std::size_t i = 1; i < loop.count; ++i) {
        const auto rest = std::span(loop.patches).subspan(i, loop.count - i);
        const auto next = std::ranges::min_element(
            rest, {}, [&](std::uint32_t patch) { return apart(patch, loop.patches[i - 1]); });
        std::iter_swap(rest.begin(), next);
    }
    return loop;
}

Loops::Loops(const surroundings::Turf& turf,
             std::uint32_t seed,
             std::span<const fish::SpeciesParameters> speciesParameters) {
    for (const fish::SpeciesParameters& parameters : speciesParameters) {
        std::vector<Loop>& loops = ofKind_.emplace_back();
        const auto& graze = parameters.habits.graze;
        if (turf.patches.empty() || !graze || graze->manner != config::GrazeManner::Loop) continue;
        for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish)
            loops.push_back(loopOf(turf, seed, fish));
    }
}

const Loop* Loops::of(const fish::SpeciesParameters& parameters, std::uint32_t fish) const {
    assert(fish >= parameters.first);
    const std::size_t index = fish - parameters.first;
    if (parameters.kind >= ofKind_.size() || index >= ofKind_[parameters.kind].size())
        return nullptr;
    return &ofKind_[parameters.kind][index];
}

}  // namespace aquarama::behaviour
