// SPDX-License-Identifier: Apache-2.0
// How far the light that the tables scatter into a view is from the Monte Carlo's, as a visitor
// would see it: CIEDE2000, luminance and all, exposed as the scene is.
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/scene.h"
#include "tests/support/water_light.h"

namespace aquarama::test {

struct Comparison {
    // Metres in type IA; in water that is hazier by a factor, ranges less by it, depths by its
    // root.
    std::vector<double> depths, ranges;
    int paths = 0;  // for each of the bands
    std::uint64_t seed = 0;
};
// Of all depths, ranges and of five directions. The irradiance at the eye is Jerlov's, as it is
// measured: the Monte Carlo says what becomes of a unit of it.
[[nodiscard]] std::vector<double> differences(const ForwardPhase& phase,
                                              config::WaterType type,
                                              const Comparison& comparison);

}  // namespace aquarama::test
