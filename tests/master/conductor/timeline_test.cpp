// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/timeline.h"

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

Timeline ticks(std::uint64_t first, std::uint64_t last) {
    Timeline timeline;
    for (std::uint64_t tick = first; tick <= last; ++tick) {
        timeline.add(at(tick, kStart + static_cast<std::int64_t>(tick) * kTickPeriod));
    }
    return timeline;
}

TEST(Timeline, isEmptyBeforeTheFirstTick) {
    EXPECT_FALSE(Timeline{}.showing({0}, kStart));
    EXPECT_FALSE(Timeline{}.showing({0}, Tick{0}));
    EXPECT_FALSE(Timeline{}.newest());
}

TEST(Timeline, lockstepShowsTheTickItself) {
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

TEST(Timeline, aMomentBetweenTwoTicksShowsBothAndTheFraction) {
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

TEST(Timeline, aTicksOwnMomentShowsItAlone) {
    const auto state = ticks(0, 5).showing({1}, kStart + 4 * kTickPeriod);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->tick, Tick{4});
    EXPECT_EQ(state->fraction, 1.0F);
    EXPECT_TRUE(state->before.empty());
}

TEST(Timeline, momentsOutsideShowTheNearestTick) {
    EXPECT_EQ(ticks(3, 5).showing({1}, kStart)->tick, Tick{3});
    EXPECT_EQ(ticks(3, 5).showing({1}, kStart * 2)->tick, Tick{5});
}

TEST(Timeline, theWorldStandsStillThroughAPause) {
    Timeline timeline = ticks(0, 1);
    timeline.add(at(2, kStart + 600 * kTickPeriod));
    for (const int tick : {2, 300, 599}) {
        const auto state = timeline.showing({1}, kStart + tick * kTickPeriod);
        EXPECT_EQ(state->tick, Tick{1});
        EXPECT_EQ(state->fraction, 1.0F);
    }
    const auto state = timeline.showing({1}, kStart + 599 * kTickPeriod + kTickPeriod / 2);
    EXPECT_EQ(state->tick, Tick{2});
    EXPECT_NEAR(state->fraction, 0.5F, 1e-6F);
}

TEST(Timeline, forgetsTheOldest) {
    const Timeline timeline = ticks(0, 100);
    EXPECT_FALSE(timeline.showing({0}, Tick{100 - Timeline::kKept}));
    EXPECT_TRUE(timeline.showing({0}, Tick{101 - Timeline::kKept}));
    EXPECT_EQ(timeline.newest(), Tick{100});
}

}  // namespace
}  // namespace aquarama::conductor
