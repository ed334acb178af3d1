// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <gtest/gtest.h>

#include "master/study/overlaps.h"

namespace aquarama::study {
namespace {

// One metre long, a tenth wide; the body frame's origin 0.385 m behind the nose.
Rod rodAt(glm::vec3 origin, glm::vec3 heading = {1, 0, 0}, float length = 1) {
    return {origin, heading, length, 0.05F * length};
}

TEST(Bodies, middleLinesAreAsFarApartAsTheyAreDrawn) {
    const Rod rod = rodAt({});
    EXPECT_NEAR(distanceBetween(rod, rodAt({0, 0.3F, 0})), 0.3F, 1e-5F) << "abreast";
    EXPECT_NEAR(distanceBetween(rod, rodAt({1.2F, 0, 0})), 0.2F, 1e-5F) << "in file";
    EXPECT_NEAR(distanceBetween(rod, rodAt({0, 0.4F, 0}, {0, 0, 1})), 0.4F, 0.002F) << "crosswise";
    EXPECT_NEAR(distanceBetween(rod, rodAt({0.77F, 0.3F, 0}, {-1, 0, 0})), 0.3F, 1e-5F)
        << "nose to nose";
}

TEST(Bodies, overlapIsTheShareThatIsInTheOther) {
    const Rod rod = rodAt({});
    EXPECT_EQ(overlapOf(rod, rodAt({0, 0.11F, 0})), 0);
    EXPECT_EQ(overlapOf(rod, rodAt({0, 0.09F, 0})), 1);
    EXPECT_NEAR(overlapOf(rod, rodAt({0.75F, 0, 0})), 0.35F, 0.04F);
    EXPECT_NEAR(overlapOf(rod, rodAt({}, {0, 0, 1})), 0.2F, 0.04F) << "crosswise: a width's worth";
    EXPECT_EQ(overlapOf(rod, rodAt({}, {1, 0, 0}, 0)), 0) << "one that is away";
}

TEST(Bodies, ofTwoTheShorterOneCounts) {
    EXPECT_EQ(overlapOf(rodAt({}, {1, 0, 0}, 4), rodAt({0, 0.1F, 0})), 1);
    EXPECT_EQ(overlapOf(rodAt({0, 0.1F, 0}), rodAt({}, {1, 0, 0}, 4)), 1);
}

constexpr std::array kWandering{fish::Intention::Wander, fish::Intention::Wander};

TEST(OverlapLog, aPairThatPartsAndMeetsAgainHasOverlappedTwice) {
    OverlapLog log(5);
    const auto look = [&](std::uint64_t tick, float apart) {
        const std::array rods{rodAt({}), rodAt({0, apart, 0})};
        return log.note({tick}, rods, kWandering).size();
    };
    EXPECT_EQ(look(0, 0.09F), 1U);
    EXPECT_EQ(look(5, 0.09F), 0U) << "it goes on";
    EXPECT_EQ(look(10, 0.5F), 0U);
    EXPECT_EQ(look(15, 0.09F), 1U);
    ASSERT_EQ(log.all().size(), 2U);
    EXPECT_EQ(log.all()[0].ticks, 10U);
    EXPECT_EQ(log.all()[0].deepTicks, 10U);
    EXPECT_EQ(log.all()[0].deepest, 1);
    EXPECT_EQ(log.all()[1].from.value, 15U);
    EXPECT_EQ(log.pairTicks(), 15U);
}

TEST(OverlapLog, whoIsDeepInTheOtherIsToldFromWhoOnlyTouches) {
    OverlapLog log(5);
    for (const float ahead : {0.97F, 0.5F, 0.5F, 0.97F, 0.5F}) {
        const std::array rods{rodAt({}), rodAt({ahead, 0, 0})};
        log.note({0}, rods, kWandering);
    }
    ASSERT_EQ(log.all().size(), 1U);
    EXPECT_EQ(log.all()[0].ticks, 25U);
    EXPECT_EQ(log.all()[0].deepTicks, 10U) << "the longest run";
}

}  // namespace
}  // namespace aquarama::study
