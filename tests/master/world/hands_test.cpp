// SPDX-License-Identifier: Apache-2.0
// What visitors see who hold a hand before the wall: fish leave a quick one and come to one that is
// still.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/fish_at_ease.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kRuns = 10;
constexpr glm::vec3 kBefore{0, 0, -3};  // the middle of the screen

// The fish, and a hand that a tracker sees thirty times a second.
class Visit {
  public:
    explicit Visit(std::uint32_t seed) : world_(fishAtEase(seed)) { pass(10); }
    void pass(float seconds) {
        for (int tick = 0; tick < static_cast<int>(seconds * 60); ++tick) world_.advance();
    }
    // Holds the hand before the wall, waving by so many metres about its place at this speed.
    void hold(float seconds, float metres = 0, float metresPerSecond = 0) {
        for (int tick = 0; tick < static_cast<int>(seconds * 60); ++tick) {
            if (tick % 2 == 0) {
                const float way = metresPerSecond * static_cast<float>(tick) / 60;
                const float there = std::abs(std::remainder(way, 4 * metres));
                const float aside = metres > 0 ? there - metres : 0;
                world_.apply(WallHands{{1, kBefore + glm::vec3(aside, 0, 0)}});
            }
            world_.advance();
        }
    }
    // Fish this near to where the hand is met, 2.4 m before the eye.
    [[nodiscard]] std::size_t gathered(float metres) const {
        const glm::vec3 place = world_.surroundings().submarine.position + glm::vec3(0, 0, -2.4F);
        std::size_t count = 0;
        for (std::size_t i = 0; i < world_.view().size(); ++i)
            count += place::lengthOf(world_.view().position(i) - place) < metres ? 1U : 0U;
        return count;
    }
    // Fish about the line of sight through the hand.
    [[nodiscard]] std::vector<std::size_t> behindTheHand() const {
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < world_.view().size(); ++i)
            if (asideOf(i) < 0.35F) all.push_back(i);
        return all;
    }
    // Distance from that line, metres.
    [[nodiscard]] float asideOf(std::size_t fish) const {
        const glm::vec3 from =
            world_.view().position(fish) - world_.surroundings().submarine.position;
        return std::sqrt(from.x * from.x + from.y * from.y);
    }

  private:
    World world_;
};

// The mean over ten runs.
TEST(Hands, thatHoldStillDrawFishWithinTwentySeconds) {
    std::size_t before = 0;
    std::size_t after = 0;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
        Visit visit(seed);
        before += visit.gathered(1.2F);
        visit.hold(20);
        after += visit.gathered(1.2F);
    }
    std::cout << "within 1.2 m: " << before << " fish before, " << after << " after, in " << kRuns
              << " runs\n";
    EXPECT_GE(after, 4 * kRuns) << "of 36 in each";
    EXPECT_GE(after, 3 * before);
}

// Of fish within 0.35 m of the line from the viewer through the hand: how many are beyond 0.4 m.
TEST(Hands, thatAreQuickAreLeft) {
    std::size_t near = 0;
    std::size_t inOne = 0;
    std::size_t inTwo = 0;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
        Visit visit(seed);
        visit.hold(20);
        const std::vector<std::size_t> fish = visit.behindTheHand();
        const auto gone = [&] {
            return std::ranges::count_if(fish,
                                         [&](std::size_t i) { return visit.asideOf(i) > 0.4F; });
        };
        near += fish.size();
        visit.hold(1, 0.15F, 1.8F);
        inOne += static_cast<std::size_t>(gone());
        visit.hold(1, 0.15F, 1.8F);
        inTwo += static_cast<std::size_t>(gone());
    }
    std::cout << near << " fish at the hand; " << inOne << " gone in a second, " << inTwo
              << " in two\n";
    EXPECT_GE(near, 3 * kRuns);
    EXPECT_GE(inOne, 7 * near / 10);
    EXPECT_GE(inTwo, 9 * near / 10);
}

}  // namespace
}  // namespace aquarama::world
