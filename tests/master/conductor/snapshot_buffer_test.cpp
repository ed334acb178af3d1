// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/snapshot_buffer.h"

#include <gtest/gtest.h>

#include "common/net/clock.h"

namespace aquarama::conductor {
namespace {

constexpr net::Instant kStart = std::chrono::seconds(100);

Snapshot at(std::uint64_t tick, net::Instant due) {
    return {{tick},
            due,
            tick * 10,
            {glm::vec3(static_cast<float>(tick), 0, 0), {1, 0, 0, 0}},
            1.0F / static_cast<float>(1 + tick),
            {motion::FishRecord{.x = static_cast<std::int32_t>(tick)}},
            {{7, 8, 9}, {{tick}}}};
}

SnapshotBuffer ticks(std::uint64_t first, std::uint64_t last) {
    SnapshotBuffer snapshots;
    for (std::uint64_t tick = first; tick <= last; ++tick) {
        snapshots.add(at(tick, kStart + static_cast<std::int64_t>(tick) * kTickPeriod));
    }
    return snapshots;
}

TEST(SnapshotBuffer, isEmptyBeforeTheFirstTick) {
    EXPECT_FALSE(SnapshotBuffer{}.showing({0}, kStart));
    EXPECT_FALSE(SnapshotBuffer{}.showing({0}, Tick{0}));
    EXPECT_FALSE(SnapshotBuffer{}.newest());
}

TEST(SnapshotBuffer, lockstepShowsTheTickItself) {
    const auto state = ticks(0, 5).showing({9}, Tick{3});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->frame, Frame{9});
    EXPECT_EQ(state->tick, Tick{3});
    EXPECT_EQ(state->fraction, 1.0F);
    EXPECT_TRUE(state->before.empty());
    EXPECT_EQ(state->after.at(0).x, 3);
    EXPECT_EQ(state->foodOriginMetres, glm::vec3(7, 8, 9));
    EXPECT_TRUE(state->foodBefore.empty());
    EXPECT_EQ(state->foodAfter.at(0).bits, 3U);
    EXPECT_EQ(state->daylight, 0.25F);
    EXPECT_EQ(state->worldHash, 30U);
    EXPECT_FALSE(ticks(0, 5).showing({9}, Tick{6}));
}

TEST(SnapshotBuffer, aMomentBetweenTwoTicksShowsBothAndTheFraction) {
    const auto state = ticks(0, 5).showing({1}, kStart + 2 * kTickPeriod + kTickPeriod / 4);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->tick, Tick{3});
    EXPECT_NEAR(state->fraction, 0.25F, 1e-6F);
    EXPECT_EQ(state->before.at(0).x, 2);
    EXPECT_EQ(state->after.at(0).x, 3);
    EXPECT_NEAR(state->eye.positionMetres.x, 2.25F, 1e-5F);
    EXPECT_EQ(state->foodBefore.at(0).bits, 2U);
    EXPECT_EQ(state->foodAfter.at(0).bits, 3U);
    EXPECT_NEAR(state->daylight, 0.75F / 3 + 0.25F / 4, 1e-6F);
}

TEST(SnapshotBuffer, aTicksOwnMomentShowsItAlone) {
    const auto state = ticks(0, 5).showing({1}, kStart + 4 * kTickPeriod);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->tick, Tick{4});
    EXPECT_EQ(state->fraction, 1.0F);
    EXPECT_TRUE(state->before.empty());
}

TEST(SnapshotBuffer, momentsOutsideShowTheNearestTick) {
    EXPECT_EQ(ticks(3, 5).showing({1}, kStart)->tick, Tick{3});
    EXPECT_EQ(ticks(3, 5).showing({1}, kStart * 2)->tick, Tick{5});
}

TEST(SnapshotBuffer, theWorldStandsStillThroughAPause) {
    SnapshotBuffer snapshots = ticks(0, 1);
    snapshots.add(at(2, kStart + 600 * kTickPeriod));
    for (const int tick : {2, 300, 599}) {
        const auto state = snapshots.showing({1}, kStart + tick * kTickPeriod);
        EXPECT_EQ(state->tick, Tick{1});
        EXPECT_EQ(state->fraction, 1.0F);
    }
    const auto state = snapshots.showing({1}, kStart + 599 * kTickPeriod + kTickPeriod / 2);
    EXPECT_EQ(state->tick, Tick{2});
    EXPECT_NEAR(state->fraction, 0.5F, 1e-6F);
}

TEST(SnapshotBuffer, forgetsTheOldest) {
    const SnapshotBuffer snapshots = ticks(0, 100);
    EXPECT_FALSE(snapshots.showing({0}, Tick{100 - SnapshotBuffer::kKept}));
    EXPECT_TRUE(snapshots.showing({0}, Tick{101 - SnapshotBuffer::kKept}));
    EXPECT_EQ(snapshots.newest(), Tick{100});
}

}  // namespace
}  // namespace aquarama::conductor
