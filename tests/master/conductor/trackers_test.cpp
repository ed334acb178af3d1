// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/trackers.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

class TrackersTest : public testing::Test {
  protected:
    bool sees(const net::PeerId& tracker, const WallHands& hands, int laterMs = 40) {
        now_ += milliseconds(laterMs);
        return trackers_.hear(tracker, hands, now_);
    }
    Trackers trackers_;
    net::Moment now_{milliseconds(1000)};
};

TEST_F(TrackersTest, handsOfAllTrackersAreTogetherAndHaveIdsOfTheirOwn) {
    EXPECT_TRUE(sees("a", {{1, {1, 0, 0}}, {2, {2, 0, 0}}}));
    EXPECT_TRUE(sees("b", {{1, {3, 0, 0}}}));
    const WallHands all = trackers_.all(now_);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[2].point, glm::vec3(3, 0, 0));
    EXPECT_NE(all[0].id, all[1].id);
    EXPECT_NE(all[0].id, all[2].id);
    EXPECT_TRUE(sees("a", {{1, {1, 1, 0}}}));
    EXPECT_EQ(trackers_.all(now_).front().id, all.front().id) << "the same hand";
}

TEST_F(TrackersTest, theLastHandThatLeavesIsHeardAtOnceAndSilenceIsAsMuch) {
    EXPECT_FALSE(sees("a", {})) << "it saw none before";
    EXPECT_TRUE(sees("a", {{1, {}}}));
    EXPECT_FALSE(sees("a", {{1, {1, 0, 0}}}, 1)) << "too soon";
    EXPECT_TRUE(sees("a", {}, 1));
    EXPECT_TRUE(trackers_.all(now_).empty());
    EXPECT_TRUE(sees("a", {{1, {}}}));
    EXPECT_TRUE(trackers_.all(now_ + milliseconds(600)).empty());
}

TEST_F(TrackersTest, moreThanAWallHoldsAreLeftOut) {
    WallHands many;
    for (std::uint32_t i = 0; i < kMostWallHands; ++i) many.push_back({i, {}});
    EXPECT_TRUE(sees("a", many));
    EXPECT_TRUE(sees("b", many));
    EXPECT_EQ(trackers_.all(now_).size(), kMostWallHands);
    int heard = 0;
    for (int i = 0; i < 1000; ++i) heard += sees(std::to_string(i), many, 0) ? 1 : 0;
    EXPECT_LE(heard, 64);
}

}  // namespace
}  // namespace aquarama::conductor
