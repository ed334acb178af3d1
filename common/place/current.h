// SPDX-License-Identifier: Apache-2.0
// The current: a tide along the wall that turns, and the surge of the waves, stronger over crowns
// and weaker in the lee of boulders. A function of scene, place and tick, the same on every
// machine: no libm. World frame, metres, metres a second.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/scene.h"
#include "common/place/place.h"

namespace aquarama::place {

// A periodic wave between -1 and 1, of parabolas, with period 1; 0 at 0, then positive. It replaces
// a sine. Defined for cycles above -4096.
[[nodiscard]] inline float wave(float cycles) {
    const float t = cycles - static_cast<float>(static_cast<std::int32_t>(cycles + 4096.0F) - 4096);
    const float half = 2 * t - 1;
    return -4 * half * (1 - (half < 0 ? -half : half));
}

// The course of the surge, a level unit vector; the tide runs along x.
inline constexpr glm::vec3 kSurgeCourse{0.5F, 0.0F, 0.8660254F};

// The water far from boulders: its velocity at a tick, also before tick 0, and the way that it has
// made since tick 0, the integral of the velocity, which is periodic.
[[nodiscard]] glm::vec3 openCurrent(const config::SceneCurrent& current, std::int64_t tick);
[[nodiscard]] glm::vec3 openDrift(const config::SceneCurrent& current, std::int64_t tick);

// The factors over crowns and in the full lee.
inline constexpr float kOverCrown = 1.5F;
inline constexpr float kInLee = 0.4F;

// What boulders make of the current, tabled once in the water of the fish and constant afterwards:
// any thread may read it. A lookup is O(1).
class Current {
  public:
    // Still water.
    Current() = default;
    Current(const config::SceneCurrent& current, std::span<const Rock> rocks, const Region& water);

    // Whether no water moves, anywhere and at any time.
    [[nodiscard]] bool isStill() const { return factors_.empty(); }
    // The velocity far from boulders.
    [[nodiscard]] glm::vec3 open(std::int64_t tick) const { return openCurrent(current_, tick); }
    // The velocity at a place, from that far from boulders at the same tick. Outside the water that
    // of its border.
    [[nodiscard]] glm::vec3 at(glm::vec3 position, glm::vec3 open) const;
    // Prefetches what at() will read for a place.
    void fetch(glm::vec3 position) const;

  private:
    config::SceneCurrent current_;
    // Corners of the grid: origin, how many along each axis, and two factors of each, with the tide
    // towards +x and towards -x.
    glm::vec3 origin_{};
    int countX_ = 0, countY_ = 0, countZ_ = 0;
    std::vector<float> factors_;
    // Of each corner whether all factors of the cell that begins there are 1, as most are.
    std::vector<std::uint8_t> isOpen_;
    // A cell of the grid, by its corner of least coordinates, and a place in it, 0 to 1 each.
    struct Cell {
        int x, y, z;
        glm::vec3 share;
    };
    [[nodiscard]] Cell cellOf(glm::vec3 position) const;
    [[nodiscard]] bool isOpenFrom(int x, int y, int z) const;
    [[nodiscard]] std::size_t indexOf(int x, int y, int z) const {
        return static_cast<std::size_t>((z * countY_ + y) * countX_ + x);
    }
};

}  // namespace aquarama::place
