// SPDX-License-Identifier: Apache-2.0
// Who is at a mark: one alone, still for two seconds, and not where the mark before was.
#include "console/touch/still_place.h"

#include <gtest/gtest.h>

namespace aquarama::console {
namespace {

tuio::Hand handAt(glm::vec2 place, std::int64_t session = 1) {
    return {.source = {}, .session = session, .place = place, .velocity = {}};
}

// Sees the same hands from a time on, fifty times a second, until a place is found.
std::optional<double> foundAt(StillPlace& still,
                              const std::vector<tuio::Hand>& hands,
                              double from,
                              double to) {
    for (double now = from; now < to; now += 0.02)
        if (still.see(hands, now)) return now;
    return std::nullopt;
}

TEST(StillPlace, aHandThatIsStillForTwoSecondsIsFoundAndItsMeanIsTold) {
    StillPlace still(0.02, {});
    std::optional<glm::dvec2> found;
    double now = 5;
    for (int i = 0; !found; ++i, now += 0.02)
        found = still.see({handAt({i % 2 == 0 ? 0.495F : 0.505F, 0.3F}, i / 30)}, now);
    EXPECT_NEAR(now, 7.02, 0.03) << "also where its session changes";
    EXPECT_NEAR(found->x, 0.5, 1e-3);
    EXPECT_NEAR(found->y, 0.3, 1e-6);
}

TEST(StillPlace, aMoveASecondHandAndAnEmptyWallBeginAnew) {
    StillPlace still(0.02, {});
    EXPECT_EQ(still.text(), "nobody is seen");
    EXPECT_FALSE(foundAt(still, {handAt({0.5F, 0.5F})}, 0, 1.9));
    EXPECT_EQ(still.text(), "seen: hold still");
    EXPECT_NEAR(*foundAt(still, {handAt({0.55F, 0.5F})}, 1.9, 9), 3.9, 0.03) << "it moved";
    EXPECT_FALSE(foundAt(still, {handAt({0.55F, 0.5F}), handAt({0.1F, 0.1F}, 2)}, 4, 20));
    EXPECT_EQ(still.text(), "2 are seen: one alone, please");
    EXPECT_FALSE(foundAt(still, {handAt({0.55F, 0.5F})}, 20, 21.9));
    EXPECT_FALSE(foundAt(still, {}, 21.9, 22));
    EXPECT_FALSE(foundAt(still, {handAt({0.55F, 0.5F})}, 22, 23.9));
}

// It creeps by less than the bound between two looks.
TEST(StillPlace, aSlowHandIsNotStill) {
    StillPlace still(0.02, {});
    for (double now = 0; now < 10; now += 0.02)
        ASSERT_FALSE(still.see({handAt({static_cast<float>(0.04 * now), 0.5F})}, now)) << now;
}

TEST(StillPlace, theMarkBeforeIsNoneOfThis) {
    StillPlace still(0.02, {{0.5, 0.5}});
    EXPECT_FALSE(foundAt(still, {handAt({0.52F, 0.52F})}, 0, 10));
    EXPECT_NE(still.text().find("go on to this one"), std::string::npos);
    EXPECT_TRUE(foundAt(still, {handAt({0.6F, 0.5F})}, 10, 13));
}

}  // namespace
}  // namespace aquarama::console
