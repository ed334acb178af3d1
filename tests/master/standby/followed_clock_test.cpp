// SPDX-License-Identifier: Apache-2.0
#include "master/standby/followed_clock.h"

#include <chrono>
#include <random>

#include <gtest/gtest.h>

#include "master/conductor/simulation_thread.h"

namespace aquarama::standby {
namespace {

using conductor::kTickPeriod;
using std::chrono::milliseconds;

net::Moment at(std::uint64_t tick) {
    return net::Moment{} + static_cast<int>(tick) * kTickPeriod;
}

TEST(FollowedClock, knowsNothingAtFirst) {
    EXPECT_FALSE(FollowedClock().tickAt(at(1)));
}

// Delays of a network differ; the shortest counts.
TEST(FollowedClock, namesTheTickWhateverTheDelays) {
    FollowedClock clock;
    std::mt19937 random(1);
    for (std::uint64_t tick = 5000; tick < 5300; ++tick)
        clock.add({tick}, at(tick) + milliseconds(1 + random() % 40));
    const auto now = clock.tickAt(at(5372));
    ASSERT_TRUE(now);
    EXPECT_GE(now->value, 5370U);
    EXPECT_LE(now->value, 5372U);
}

// A master that was late has lost that time for good.
TEST(FollowedClock, followsAMasterThatWentOnLate) {
    FollowedClock clock;
    const net::Duration late = std::chrono::seconds(1);
    for (std::uint64_t tick = 0; tick < 100; ++tick) clock.add({tick}, at(tick));
    for (std::uint64_t tick = 100; tick < 300; ++tick) clock.add({tick}, at(tick) + late);
    EXPECT_EQ(clock.tickAt(at(300) + late), Tick{300});
    clock.forget();
    EXPECT_FALSE(clock.tickAt(at(300)));
}

}  // namespace
}  // namespace aquarama::standby
