// SPDX-License-Identifier: Apache-2.0
// The fish that wear visitors' drawings: the last fish of a species wait out of sight until a
// drawing comes, swim in with it from where its maker stands, live as any other fish, and swim
// away.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"

namespace aquarama::fish {

// How a wearer is under way. It is led while it enters, shows itself to its maker, and leaves; it
// lives while it stays.
enum class Visit : std::uint8_t { Asleep, Enters, Shows, Stays, Leaves };

// One fish and its drawing.
struct Wearer {
    std::uint32_t fish = 0;
    Visit visit = Visit::Asleep;
    Tick since = {};           // of the visit's stage
    int aside = 0;             // from where it enters: -1 left, 0 middle, 1 right
    std::uint32_t number = 0;  // of the drawing; 0: none
    Digest picture = {};
};

// The wearers of one species: fish [first, last).
struct SlotRange {
    std::uint8_t kind = 0;  // its place in the cast
    std::uint32_t first = 0, last = 0;
};

// All of a world. Owned by it, changed between thoughts.
struct Wearers {
    std::vector<SlotRange> ranges;
    std::vector<Wearer> fish;  // in the order of the ranges
    bool mayBeEaten = false;
    // The viewer: the eye in metres, and level unit vectors ahead of it and to its right.
    glm::vec3 eye{}, ahead{0, 0, -1}, right{1, 0, 0};

    // Null for a fish that never wears one.
    [[nodiscard]] const Wearer* of(std::uint32_t number) const {
        std::size_t before = 0;
        for (const SlotRange& range : ranges) {
            if (number >= range.first && number < range.last)
                return &fish[before + number - range.first];
            before += range.last - range.first;
        }
        return nullptr;
    }
    [[nodiscard]] Wearer* of(std::uint32_t number) {
        return const_cast<Wearer*>(static_cast<const Wearers&>(*this).of(number));
    }
    // Adds the last fish of a species.
    void add(const SlotRange& range) {
        ranges.push_back(range);
        for (std::uint32_t one = range.first; one < range.last; ++one)
            fish.push_back({.fish = one});
    }
};

// The hash with them folded in; the same where there are none.
[[nodiscard]] std::uint64_t foldedWearers(std::uint64_t hash, const Wearers& wearers);

}  // namespace aquarama::fish
