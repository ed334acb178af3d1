// SPDX-License-Identifier: Apache-2.0
// The yardstick flock does what its plain reference does, so its figures mean what they say.
#include "tests/bench/flock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/master/world/instruction_sets.h"

namespace aquarama::behaviour {
namespace {

// Largest difference of anything of one boid.
float differenceOf(const bench::Flock& flock,
                   std::size_t boid,
                   const std::array<float, bench::Flock::kColumns>& expected) {
    float most = 0;
    for (std::size_t column = 0; column < bench::Flock::kColumns; ++column)
        most = std::max(most, std::abs(flock.columns[column][boid] - expected[column]));
    return most;
}

TEST(Flock, everyInstructionSetStepsAsPlainCodeDoes) {
    constexpr std::size_t kBoids = 600;
    const float radius = bench::flockRadius(kBoids, 20);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        world::useOnly(target);
        bench::Flock flock = bench::makeFlock(kBoids, radius);
        bench::FlockStep step(kBoids, radius);
        for (int i = 0; i < 3; ++i) {
            const bench::Flock before = flock;
            step.run(flock);
            int different = 0;
            for (std::size_t boid = 0; boid < kBoids; ++boid) {
                const auto expected =
                    bench::flockReference(before, step.formerPlaceOf(boid), radius);
                different += differenceOf(flock, boid, expected) > 1e-3F ? 1 : 0;
            }
            // The processors' guesses at 1 / sqrt put a neighbour at the very border of the view
            // on its other side now and then.
            EXPECT_LE(different, 6);
        }
    }
    world::useOnly(0);
}

}  // namespace
}  // namespace aquarama::behaviour
