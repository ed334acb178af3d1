// SPDX-License-Identifier: Apache-2.0
// A particle of food on the wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "common/config/scene.h"

namespace aquarama::wire {

inline constexpr float kFoodUnitMetres = 1.0F / 8192.0F;
inline constexpr std::size_t kMostFood = config::kMostPlankton + 256;  // and pellets

// Where it is from the cloud's origin, x | y << 20 | z << 40, each in 20-bit two's complement and
// units of 2^-13 m (64 m to each side; a finer step than a particle drifts in a tick, so that none
// is seen to stutter); kind << 60 | generation << 62. All zero: nothing is there.
struct FoodRecord {
    enum class Kind : std::uint8_t { None, Plankton, Pellet };

    std::uint64_t bits = 0;

    [[nodiscard]] Kind kind() const { return static_cast<Kind>(bits >> 60U & 3U); }
    // Modulo 4: another number is another particle in the same place of the list.
    [[nodiscard]] unsigned generation() const { return static_cast<unsigned>(bits >> 62U); }
    [[nodiscard]] glm::vec3 offsetMetres() const {
        const auto axis = [this](unsigned shift) {
            const auto signedBits = static_cast<std::int64_t>(bits << (44U - shift)) >> 44U;
            return static_cast<float>(signedBits) * kFoodUnitMetres;
        };
        return {axis(0), axis(20), axis(40)};
    }
    // A decoder refuses any other.
    [[nodiscard]] bool isPossible() const {
        return kind() <= Kind::Pellet && (kind() != Kind::None || bits == 0);
    }
    friend bool operator==(const FoodRecord&, const FoodRecord&) = default;
};
static_assert(sizeof(FoodRecord) == 8);

// Nothing where it is out of reach of the numbers, or not a number.
[[nodiscard]] inline FoodRecord foodRecord(FoodRecord::Kind kind,
                                           glm::vec3 offsetMetres,
                                           unsigned generation) {
    constexpr float kFarthestUnits = 524287.0F;
    const glm::vec3 units = glm::round(offsetMetres / kFoodUnitMetres);
    const glm::vec3 size = glm::abs(units);
    const bool isThere = kind != FoodRecord::Kind::None && size.x <= kFarthestUnits &&
                         size.y <= kFarthestUnits && size.z <= kFarthestUnits;
    if (!isThere) return {};
    const auto axis = [](float value) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(value)) & 0xFFFFFU;
    };
    return {axis(units.x) | axis(units.y) << 20U | axis(units.z) << 40U |
            static_cast<std::uint64_t>(kind) << 60U | std::uint64_t{generation & 3U} << 62U};
}

// All food of one tick. A particle keeps its place in the list for as long as it is there.
struct FoodCloud {
    glm::vec3 originMetres{};  // world frame; the same in every tick of a show
    std::vector<FoodRecord> particles;
};

}  // namespace aquarama::wire
