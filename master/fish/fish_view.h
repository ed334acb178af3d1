// SPDX-License-Identifier: Apache-2.0
// A species as its fish's minds use it: its habits, and names resolved to indices of the cast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/species.h"
#include "common/units/units.h"

namespace aquarama::fish {

struct SpeciesParameters {
    std::uint8_t kind = 0;                 // its own index in the cast
    std::uint32_t first = 0, last = 0;     // its fish are [first, last) of all
    std::uint64_t hunts = 0;               // a bit for each kind that it eats
    std::uint64_t huntedBy = 0;            // a bit for each kind that eats it
    std::uint64_t shadows = 0;             // a bit for each kind that it likes to follow
    float slow = 1, medium = 2, fast = 3;  // body lengths a second, of its repertoire
    config::Habits habits;
};

// What fish can see of one another at the start of a tick, world frame. Nothing in it changes while
// the fish think.

inline constexpr std::uint32_t kNobody = 0xffffffffU;  // no fish, no particle

// What a fish shows of its mood, as bits of FishView::signs.
enum Sign : std::uint8_t {
    kAway = 1,     // eaten, or not yet come: nobody sees it
    kWilling = 2,  // would mate
    kFemale = 4,
    kHunting = 8,
    kSchooling = 16,  // swims in a school
};

// A fish as it swims. Who looks at a neighbour needs all of it, and finds it in one line of memory.
struct alignas(32) VisibleFish {
    glm::vec3 position{};  // body frame's origin, metres
    glm::vec3 heading{};   // course without the sway of the tail beat
    float speed = 0;       // metres a second
    float length = 0;      // metres
};

struct FishView {
    std::vector<VisibleFish> fish;
    std::vector<std::uint8_t> kind;      // its species, an index into the cast
    std::vector<std::uint8_t> signs;     // of Sign
    std::vector<std::uint32_t> partner;  // whom it courts; kNobody
    std::vector<std::uint8_t> stage;     // of its courtship or hunt: Mind::stage

    void resize(std::size_t count) {
        fish.resize(count);
        kind.resize(count);
        signs.resize(count);
        partner.resize(count, kNobody);
        stage.resize(count);
    }
    [[nodiscard]] std::size_t size() const { return fish.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return fish[i].position; }
    [[nodiscard]] glm::vec3 heading(std::size_t i) const { return fish[i].heading; }
    // Asks memory for a fish that will be looked at soon.
    void fetch(std::size_t i) const { __builtin_prefetch(&fish[i]); }
    [[nodiscard]] bool shows(std::size_t i, Sign sign) const { return (signs[i] & sign) != 0; }
};

// Where a fish's mouth is.

// Of the mouth before the origin of the body frame: nodal point 0 of every species' rest shape.
inline constexpr float kMouthBodyLengths = 0.385F;

[[nodiscard]] inline glm::vec3 mouthOf(const FishView& view, std::uint32_t fish) {
    return view.position(fish) + view.heading(fish) * (kMouthBodyLengths * view.fish[fish].length);
}

}  // namespace aquarama::fish
