// SPDX-License-Identifier: Apache-2.0
// A program of its own: it replaces operator new to count.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "tests/master/world/school_of_synthetic_fish.h"

namespace {
std::atomic<long> allocations = 0;
}

void* operator new(std::size_t bytes) {
    ++allocations;
    if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace aquarama {
namespace {

TEST(World, advancingTakesNoMemory) {
    for (const unsigned threads : {1U, 2U}) {
        World world = syntheticWorld(1, 1000, threads);
        for (int i = 0; i < 3; ++i) world.advance();
        const long before = allocations;
        for (int i = 0; i < 120; ++i) world.advance();
        EXPECT_EQ(allocations - before, 0) << threads << " threads";
    }
}

}  // namespace
}  // namespace aquarama
