// SPDX-License-Identifier: Apache-2.0
// Hands of a tracker over a socket of the loopback, as points of the screen.
#include "console/cues/touch_listener.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/common/tuio/sample_streams.h"
#include "tests/console/cues/free_port.h"
#include "tests/console/cues/tracked_wall.h"

namespace aquarama::console {
namespace {

// The viewer sits half a metre to the right of the origin.
config::Rig rigAt(const config::UdpAddress& listen) {
    config::Rig rig = test::wallOfHands(listen);
    rig.sweetSpotMetres = {0.5, 0, 0};
    return rig;
}

// The tracker sees people on 6 x 4 m of the floor before it, from above.
config::Rig floorAt(const config::UdpAddress& listen) {
    config::Rig rig = rigAt(listen);
    rig.touch->peopleReachMetres = 2;
    rig.touch->topLeft = {-3, -1.6, -3};
    rig.touch->topRight = {3, -1.6, -3};
    rig.touch->bottomLeft = {-3, -1.6, 1};
    return rig;
}

TEST(TrackedPlaces, aPlaceOfTheSurfaceIsAPointOfTheScreen) {
    const TrackedPlaces places(rigAt({"127.0.0.1", 1}));
    EXPECT_EQ(places.pointOf({0, 0}), glm::vec3(-2.5F, 1, -3));
    EXPECT_EQ(places.pointOf({1, 1}), glm::vec3(1.5F, -1, -3));
    EXPECT_EQ(places.pointOf({0.5F, 0.25F}), glm::vec3(-0.5F, 0.5F, -3));
}

// Its direction from the viewer is that of the place in front of somebody, at 1.2 m.
void expectFront(const std::optional<glm::vec3>& point, glm::vec3 front, float share) {
    ASSERT_TRUE(point);
    EXPECT_LT(glm::length(*point - front * share), 1e-5F)
        << point->x << ' ' << point->y << ' ' << point->z;
}

TEST(TrackedPlaces, aPersonIsAPlaceOfTheScreenInFrontOfThem) {
    const TrackedPlaces places(floorAt({"127.0.0.1", 1}));
    expectFront(places.pointOf({0.5, 0}), {-0.5F, -0.4F, -3}, 1);  // with the nose at the wall
    const float way = std::hypot(1.5F, 3.0F);
    expectFront(places.pointOf({4.0 / 6, 0.25}), {0.5F, -0.4F, -3}, 1 - 1 / std::hypot(0.5F, 3.0F));
    expectFront(places.pointOf({1.0 / 3, 0.25}), {-1.5F, -0.4F, -3}, 1 - 1 / way);
}

TEST(TrackedPlaces, whoIsFarOrBesideOrBehindIsNotThere) {
    const TrackedPlaces places(floorAt({"127.0.0.1", 1}));
    EXPECT_TRUE(places.pointOf({0.5, 0.49}));
    EXPECT_FALSE(places.pointOf({0.5, 0.51})) << "beyond two metres";
    EXPECT_FALSE(places.pointOf({0.1, 0.1})) << "beside a wall that begins at -2 m";
    config::Rig behind = floorAt({"127.0.0.1", 1});
    behind.touch->topLeft.z = behind.touch->topRight.z = -4;
    EXPECT_FALSE(TrackedPlaces(behind).pointOf({0.5, 0.1})) << "half a metre behind the screen";
    EXPECT_TRUE(TrackedPlaces(behind).pointOf({0.5, 0.16})) << "at it, as trackers see";
}

// A television over heads, and one at knees: the nearest height that there is.
TEST(TrackedPlaces, aScreenThatIsHigherOrLowerHasThemAtItsEdge) {
    config::Rig high = floorAt({"127.0.0.1", 1});
    for (glm::dvec3* corner :
         {&high.touch->topLeft, &high.touch->topRight, &high.touch->bottomLeft})
        corner->y = -3;
    const auto atHigh = TrackedPlaces(high).pointOf({0.5, 0});
    ASSERT_TRUE(atHigh);
    EXPECT_NEAR(atHigh->y, -0.95F, 0.051F);
    config::Rig low = floorAt({"127.0.0.1", 1});
    for (glm::dvec3* corner : {&low.touch->topLeft, &low.touch->topRight, &low.touch->bottomLeft})
        corner->y = 0.5;
    const auto atLow = TrackedPlaces(low).pointOf({0.5, 0});
    ASSERT_TRUE(atLow);
    EXPECT_NEAR(atLow->y, 0.95F, 0.051F);
}

// On a curved wall, a metre and a half before it, nobody is quicker than they walk.
TEST(TrackedPlaces, aPersonMovesNoFasterThanTheyWalk) {
    config::Rig rig = floorAt({"127.0.0.1", 1});
    rig.sweetSpotMetres = {};
    rig.screen.shape = config::ScreenShape::Cylinder;
    rig.screen.radiusMetres = 3;
    rig.screen.arcRadians = 2;
    const TrackedPlaces places(rig);
    for (double x = 0.4; x < 0.6; x += 0.01)
        for (const glm::dvec2 step : {glm::dvec2(0.01, 0), glm::dvec2(0, 0.01)}) {
            const auto one = places.pointOf({x, 0.375}),
                       two = places.pointOf(glm::dvec2(x, 0.375) + step);
            ASSERT_TRUE(one && two);
            const double metres = glm::length(step * glm::dvec2(6, 4));
            EXPECT_LE(glm::length(*two - *one), 1.1 * metres);
            EXPECT_GE(glm::length(*two - *one), 0.5 * metres);
        }
}

// A listener at a port of its own, and who sends to it.
class Tracked : public testing::Test {
  protected:
    explicit Tracked(std::vector<std::string> from = {"127.0.0.1"}) {
        config::Rig rig = rigAt(test::freePort().address);  // is free again
        rig.touch->from = std::move(from);
        at = rig.touch->listen;
        listener.emplace(rig);
    }
    void send(const std::string& packet, const std::string& host = "127.0.0.1") {
        const test::Port tracker = test::freePort(host);
        tracker.socket->send(at, std::as_bytes(std::span(packet)));
    }

    config::UdpAddress at;
    std::optional<TouchListener> listener;
};

TEST_F(Tracked, handsComeStayAndLeave) {
    EXPECT_FALSE(listener->tick(0)) << "there is nothing to say";
    send(test::tuioFrame(1, {{7, 0.5F, 0.25F}}, "fence"));
    const auto first = listener->tick(0.1);
    ASSERT_TRUE(first);
    ASSERT_EQ(first->size(), 1U);
    EXPECT_EQ(first->front().point, glm::vec3(-0.5F, 0.5F, -3));
    send(test::tuioFrame(2, {{7, 0.75F, 0.25F}, {8, 0, 0}}, "fence"));
    const auto second = listener->tick(0.2);
    ASSERT_TRUE(second);
    ASSERT_EQ(second->size(), 2U);
    EXPECT_EQ(second->front().id, first->front().id) << "the same hand";
    EXPECT_EQ(second->front().point, glm::vec3(0.5F, 0.5F, -3));
    send(test::tuioFrame(3, {}, "fence"));
    EXPECT_EQ(listener->tick(0.3), WallHands{}) << "said once, so that they go at once";
    EXPECT_FALSE(listener->tick(0.4));
    send(test::tuioFrame(4, {{9, 0.5F, 0.5F}}, "fence"));
    EXPECT_TRUE(listener->tick(0.5));
    EXPECT_EQ(listener->tick(3.1), WallHands{}) << "its tracker is silent";
}

TEST_F(Tracked, noiseIsNoHand) {
    send(std::string(500, '\x5A'));
    send(test::oscMessage("/tuio/2Dcur", "s", test::oscText("alive")));
    send(std::string(9000, 'x'));
    EXPECT_FALSE(listener->tick(0.1));
    send(test::tuioFrame(1, {{7, 0.5F, 0.25F}}));
    EXPECT_TRUE(listener->tick(0.2));
}

class TrackedFromAfar : public Tracked {
  protected:
    TrackedFromAfar() : Tracked({"127.0.0.2"}) {}
};

TEST_F(TrackedFromAfar, strangersAreNotHeard) {
    send(test::tuioFrame(1, {{7, 0.5F, 0.25F}}), "127.0.0.1");
    EXPECT_FALSE(listener->tick(0.1));
    send(test::tuioFrame(1, {{7, 0.5F, 0.25F}}), "127.0.0.2");
    EXPECT_TRUE(listener->tick(0.2));
}

class TrackedOnTheFloor : public Tracked {
  protected:
    TrackedOnTheFloor() {
        config::Rig rig = floorAt(test::freePort().address);
        at = rig.touch->listen;
        listener.emplace(rig);
    }
    // Who stands there as a scanner of legs sees it: now the one, now the other, 12 cm apart.
    std::vector<glm::vec3> standing(int ticks) {
        std::vector<glm::vec3> points;
        for (int tick = 1; tick <= ticks; ++tick) {
            const float leg = tick % 2 == 0 ? 0.49F : 0.51F;
            send(test::tuioFrame(static_cast<std::uint32_t>(tick), {{7, leg, 0.2F}}, "", true));
            const auto hands = listener->tick(0.1 * tick);
            if (hands && hands->size() == 1) points.push_back(hands->front().point);
        }
        return points;
    }
};

// Below 0.25 m/s the world counts a hand as still.
TEST_F(TrackedOnTheFloor, whoStandsIsStillAlthoughLegsAreSeenInTurns) {
    const std::vector<glm::vec3> points = standing(30);
    ASSERT_EQ(points.size(), 30U);
    for (std::size_t i = 20; i < points.size(); ++i)
        EXPECT_LT(glm::length(points[i] - points[i - 1]) / 0.1F, 0.25F);
}

// Two metres in two seconds are known a third of a second later.
TEST_F(TrackedOnTheFloor, whoWalksIsFollowed) {
    std::optional<WallHands> hands;
    for (int tick = 1; tick <= 30; ++tick) {
        const float there = std::min(1.0F, static_cast<float>(tick) / 20);
        send(test::tuioFrame(static_cast<std::uint32_t>(tick), {{7, 0.3F + there / 3, 0}}));
        hands = listener->tick(0.1 * tick);
    }
    ASSERT_TRUE(hands && hands->size() == 1);
    EXPECT_NEAR(hands->front().point.x, 0.3F, 0.05F);
}

}  // namespace
}  // namespace aquarama::console
