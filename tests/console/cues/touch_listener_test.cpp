// SPDX-License-Identifier: Apache-2.0
// Hands of a tracker over a socket of the loopback, as points of the screen.
#include "console/cues/touch_listener.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/common/tuio/sample_streams.h"
#include "tests/console/cues/free_port.h"

namespace aquarama::console {
namespace {

// Before a wall of 4 x 2 m, 3 m away; the viewer sits half a metre to the right of the origin.
config::TouchedSurface surfaceAt(const config::UdpAddress& listen) {
    return {listen, {"127.0.0.1"}, {-2, 1, -3}, {2, 1, -3}, {-2, -1, -3}};
}
constexpr glm::dvec3 kSweetSpot{0.5, 0, 0};

TEST(TouchListener, aPlaceOfTheSurfaceIsAPointOfTheScreen) {
    const config::TouchedSurface surface = surfaceAt({"127.0.0.1", 1});
    EXPECT_EQ(pointAt(surface, kSweetSpot, {0, 0}), glm::vec3(-2.5F, 1, -3));
    EXPECT_EQ(pointAt(surface, kSweetSpot, {1, 1}), glm::vec3(1.5F, -1, -3));
    EXPECT_EQ(pointAt(surface, kSweetSpot, {0.5F, 0.25F}), glm::vec3(-0.5F, 0.5F, -3));
}

// A listener at a port of its own, and who sends to it.
class Tracked : public testing::Test {
  protected:
    explicit Tracked(std::vector<std::string> from = {"127.0.0.1"}) {
        config::TouchedSurface surface = surfaceAt(test::freePort().address);  // is free again
        surface.from = std::move(from);
        at = surface.listen;
        listener.emplace(surface, kSweetSpot);
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
    EXPECT_EQ(listener->tick(2), WallHands{}) << "its tracker is silent";
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

}  // namespace
}  // namespace aquarama::console
