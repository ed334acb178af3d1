// SPDX-License-Identifier: Apache-2.0
// A chart of the water: the height of the sand and which rocks and plants are near, looked up
// instead of worked out. World frame, metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/scene.h"
#include "common/place/place.h"
#include "common/units/units.h"

namespace aquarama::surroundings {

// A kelp plant, as fish pass it: upright, from the sand to its top.
struct Stem {
    glm::vec2 foot{};  // x, z
    float topMetres = 0;
};

// How far from its footprint an obstacle is listed.
inline constexpr float kChartReachMetres = 2.7F;
// Between the corners at which the sand is measured. Interpolated, it is within 5 mm.
inline constexpr float kChartStepMetres = 0.25F;

class Chart {
  public:
    struct Footprint {
        glm::vec2 xz{};
        float radiusMetres = 0;
    };
    Chart() = default;
    // Covers the water and a metre and a half about it.
    Chart(const place::PlaceKey& place,
          const place::Region& water,
          std::span<const Footprint> footprints);

    // Whether a place is on the chart; only there may it be asked.
    [[nodiscard]] bool covers(glm::vec2 xz) const {
        const glm::vec2 at = xz - origin_;
        return at.x >= 0 && at.y >= 0 && at.x < extent_.x && at.y < extent_.y;
    }
    [[nodiscard]] float sand(glm::vec2 xz) const;
    [[nodiscard]] float highestSand() const { return highest_; }
    // Those footprints, ascending, that come within kChartReachMetres of the place; and some more.
    [[nodiscard]] std::span<const std::uint32_t> near(glm::vec2 xz) const;

  private:
    void measure(const place::PlaceKey& place);
    void list(std::span<const Footprint> footprints);

    glm::vec2 origin_{};
    glm::vec2 extent_{};  // 0: nothing is covered
    int corners_ = 0;     // along x
    int cells_ = 0;       // along x
    float highest_ = 0;
    std::vector<float> sand_;
    std::vector<std::uint32_t> starts_, listed_;
};

// Light and warmth of the water, as fish sense them (Tu 1996, section 5.1).

struct Climate {
    config::Day day;
    float surfaceCelsius = 28, celsiusPerMetre = -0.15F;
};
[[nodiscard]] Climate climateOf(const config::Scene& scene);

// 1 at noon, Day::night at midnight, a smooth wave between; the sky's, before the water takes any.
[[nodiscard]] float daylight(const config::Day& day, Tick tick);
// At a height y (negative), 0 to 1.
[[nodiscard]] float lightAt(const Climate& climate, float daylight, float y);
[[nodiscard]] float celsiusAt(const Climate& climate, float y);

}  // namespace aquarama::surroundings
