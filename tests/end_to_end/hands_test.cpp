// SPDX-License-Identifier: Apache-2.0
// From the packets of a tracker to the fish: a stream of three hands is sent over the loopback to
// what the console listens with, and what that says goes into a world. Times are simulated. The
// same for people, whose places tremble.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "console/cues/touch_listener.h"
#include "tests/common/tuio/sample_streams.h"
#include "tests/console/cues/free_port.h"
#include "tests/console/cues/tracked_wall.h"
#include "tests/master/world/fish_at_ease.h"

namespace aquarama {
namespace {

constexpr std::uint32_t kRuns = 10;
constexpr int kTicksOfAFrame = 2;    // of the tracker, thirty a second
constexpr int kTicksOfAConsole = 6;  // ten times a second

// The tracker sees people on 4 x 3 m of the floor.
config::Rig wallOfPeople(const config::UdpAddress& listen) {
    config::Rig rig = test::wallOfHands(listen);
    rig.touch->peopleReachMetres = 2;
    rig.touch->topLeft = {-2, -1.6, -3};
    rig.touch->topRight = {2, -1.6, -3};
    rig.touch->bottomLeft = {-2, -1.6, 0};
    return rig;
}

// A world, the console's listener, and a tracker that sends what a function sees at each second.
class Hall {
  public:
    template <class RigAt>
    Hall(std::uint32_t seed, RigAt rigAt)
        : world_(world::fishAtEase(seed)),
          at_(test::freePort().address),
          listener_(rigAt(at_)),
          tracker_(test::freePort()) {
        for (int tick = 0; tick < 600; ++tick) world_.advance();
    }
    template <class Seen>
    void pass(float seconds, Seen seen, bool areBlobs = false) {
        const int last = tick_ + static_cast<int>(seconds * 60);
        for (; tick_ < last; ++tick_) {
            const float now = static_cast<float>(tick_) / 60;
            if (tick_ % kTicksOfAFrame == 0) send(seen(now), areBlobs);
            if (tick_ % kTicksOfAConsole == 0)
                if (const auto hands = listener_.tick(now)) world_.apply(*hands);
            world_.advance();
        }
    }
    // Fish within 1.2 m of where those come that are drawn by a place of the screen: 2.4 m off.
    [[nodiscard]] std::size_t gathered(glm::vec3 screen) const {
        const glm::vec3 place = eye() + glm::normalize(screen) * 2.4F;
        std::size_t count = 0;
        for (std::size_t i = 0; i < world_.view().size(); ++i)
            count += glm::length(world_.view().position(i) - place) < 1.2F ? 1U : 0U;
        return count;
    }
    // Fish about the line of sight through a place of the screen.
    [[nodiscard]] std::vector<std::size_t> behind(glm::vec3 screen) const {
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < world_.view().size(); ++i)
            if (asideOf(i, screen) < 0.35F) all.push_back(i);
        return all;
    }
    // Distance from that line, metres.
    [[nodiscard]] float asideOf(std::size_t fish, glm::vec3 screen) const {
        return glm::length(
            glm::cross(world_.view().position(fish) - eye(), glm::normalize(screen)));
    }

  private:
    [[nodiscard]] glm::vec3 eye() const { return world_.surroundings().submarine.position; }
    void send(const std::vector<test::SampleTouch>& seen, bool areBlobs) {
        const std::string packet = test::tuioFrame(++frame_, seen, "stream", areBlobs);
        tracker_.socket->send(at_, std::as_bytes(std::span(packet)));
    }

    world::World world_;
    config::UdpAddress at_;
    console::TouchListener listener_;
    test::Port tracker_;
    int tick_ = 0;
    std::uint32_t frame_ = 0;
};

// Where on the screen, and as the tracker's shares.
constexpr glm::vec3 kStill{-0.9F, 0.1F, -3}, kWaves{0.9F, 0, -3};
test::SampleTouch touchAt(std::uint32_t session, glm::vec3 screen) {
    return {session, (screen.x + 2) / 4, (1 - screen.y) / 2};
}

// Waves about its place from a second on: 0.3 m wide, at 1.8 m/s.
glm::vec3 wavingFrom(float begins, float now) {
    if (now < begins) return kWaves;
    const float there = std::abs(std::remainder(1.8F * (now - begins), 0.6F));
    return kWaves + glm::vec3(there - 0.15F, 0, 0);
}

// One hand is still, one is until the twentieth second and waves then, one strokes along the top at
// 0.4 m/s, and is another one whenever it comes again.
std::vector<test::SampleTouch> threeHands(float now) {
    const float stroke = std::fmod(0.4F * now, 3.6F) - 1.8F;
    const auto session = static_cast<std::uint32_t>(now * 0.4F / 3.6F);
    return {touchAt(7, kStill),
            touchAt(8, wavingFrom(20, now)),
            touchAt(100 + session, {stroke, 0.9F, -3})};
}

// In ten runs of 36 fish.
TEST(StreamOfHands, fishGatherAtTheStillOneAndLeaveTheQuickOne) {
    std::size_t before = 0, gathered = 0, stayed = 0, near = 0, inOne = 0;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
        Hall hall(seed, test::wallOfHands);
        before += hall.gathered(kStill);
        hall.pass(20, threeHands);
        gathered += hall.gathered(kStill);
        const std::vector<std::size_t> fish = hall.behind(kWaves);
        near += fish.size();
        hall.pass(1, threeHands);
        inOne += static_cast<std::size_t>(std::ranges::count_if(
            fish, [&](std::size_t i) { return hall.asideOf(i, kWaves) > 0.4F; }));
        stayed += hall.gathered(kStill);
    }
    std::cout << "three hands, " << kRuns << " runs: within 1.2 m of the still one " << before
              << " fish before, " << gathered << " after 20 s, " << stayed
              << " a second after another waved; of " << near << " at that one " << inOne
              << " gone in the second\n";
    EXPECT_GE(gathered, 3 * before);
    EXPECT_GE(gathered, 5 * kRuns);
    EXPECT_GE(stayed, 7 * gathered / 10);
    EXPECT_GE(near, kRuns);
    EXPECT_GE(inOne, 7 * near / 10);
}

// A metre before the wall; scanners see now the one leg, now the other.
std::vector<test::SampleTouch> standing(float now) {
    const float leg = std::fmod(now, 0.2F) < 0.1F ? -0.015F : 0.015F;
    return {{7, 0.35F + leg, 1.0F / 3}};
}
// Runs along the wall, 2.4 m/s, to and fro.
std::vector<test::SampleTouch> running(float now) {
    const float way = std::abs(std::remainder(0.6F * now, 1.0F));
    return {{8, 0.25F + way, 1.0F / 3}};
}

TEST(StreamOfPeople, fishGatherBeforeWhoStandsAndLeaveWhoRuns) {
    const glm::vec3 chest{-0.6F, -0.4F, -3};
    std::size_t before = 0, gathered = 0, left = 0;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
        Hall hall(seed, wallOfPeople);
        before += hall.gathered(chest);
        hall.pass(20, standing, true);
        gathered += hall.gathered(chest);
        hall.pass(3, running, true);
        left += hall.gathered(chest);
    }
    std::cout << "people, " << kRuns << " runs: within 1.2 m before somebody " << before
              << " fish before, " << gathered << " after 20 s, " << left
              << " when somebody has run to and fro\n";
    EXPECT_GE(gathered, 3 * before);
    EXPECT_GE(gathered, 8 * kRuns);
    EXPECT_LE(left, 6 * gathered / 10);
}

}  // namespace
}  // namespace aquarama
