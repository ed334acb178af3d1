// SPDX-License-Identifier: Apache-2.0
// A program of its own: it replaces operator new to count.
#include <gtest/gtest.h>

#include "tests/master/world/school_of_synthetic_fish.h"
#include "tests/support/count_memory.h"

namespace aquarama {
namespace {

TEST(World, advancingTakesNoMemory) {
    for (const unsigned threads : {1U, 2U}) {
        World world = syntheticWorld(1, 1000, threads);
        for (int i = 0; i < 3; ++i) world.advance();
        const std::size_t before = bytesTaken;
        for (int i = 0; i < 120; ++i) world.advance();
        EXPECT_EQ(bytesTaken - before, 0U) << threads << " threads";
    }
}

}  // namespace
}  // namespace aquarama
