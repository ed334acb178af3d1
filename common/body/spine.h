// SPDX-License-Identifier: Apache-2.0
// The bent axis of a fish: a cubic through nose, ring centres and tail.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::body {

inline constexpr std::size_t kKnots = 7;  // nose, five rings, tail

struct Spine {
    std::array<float, kKnots> stations{};
    std::array<glm::vec3, kKnots> centres{};
    std::array<glm::vec3, kKnots> slopes{};  // of centre by station
    std::array<glm::vec3, kKnots> right{};   // which way the fish's right is
};

[[nodiscard]] std::array<float, kKnots> knotStations(const FishBody& body);
[[nodiscard]] Spine spineOf(const std::array<float, kKnots>& stations, const NodalPoints& nodes);

// From stations and centres.
void setSlopes(Spine& spine);

// Where the axis is at a station, which way it runs and which way is right, both not normalised.
struct SpineSample {
    glm::vec3 centre{};
    glm::vec3 tailwards{};
    glm::vec3 right{};
};

// Cubic Hermite between knots, straight on behind the tail. Linear in all that the spine holds but
// its stations.
[[nodiscard]] SpineSample sampleAt(const Spine& spine, float station);

}  // namespace aquarama::body
