// SPDX-License-Identifier: Apache-2.0
// Fish with visitors' drawings: they wait out of sight, come past the viewer, live, are spared, and
// go, and no other fish is changed by those that wait.
#include <iostream>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/captured_fish.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kFish = 12;
constexpr std::uint32_t kSlots = 4;
constexpr std::uint32_t kNumber = 77;

WorldOptions visited(std::uint32_t slots) {
    WorldOptions options;
    options.seed = 3;
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 0;
    options.scene.eye = {0, -6, 0};
    options.scene.water.centre = {0, -6, -3};
    options.scene.water.halfExtent = {6, 2, 6};
    WorldSpecies tangs = capturedSpecies(test::castMember("blue_tang"), kFish + slots);
    tangs.drawings = slots;
    options.cast.push_back(tangs);
    return options;
}

class DrawingsInAWorld : public ::testing::Test {
  protected:
    World world{visited(kSlots)};

    void pass(int seconds) {
        for (int tick = 0; tick < 60 * seconds; ++tick) world.advance();
    }
    // A fish that is let in from the left.
    void letIn(std::uint32_t fish, int aside = -1) {
        world.apply(EnterDrawing{.fish = fish, .number = kNumber, .picture = {}, .aside = aside});
    }
    [[nodiscard]] bool isAway(std::uint32_t fish) const {
        return motion::isAway(world.states(), fish);
    }
    [[nodiscard]] fish::Visit visit(std::uint32_t fish) const {
        return world.environment().wearers->of(fish)->visit;
    }
    [[nodiscard]] glm::vec3 fromEye(std::uint32_t fish) const {
        return world.view().position(fish) - world.environment().wearers->eye;
    }
    [[nodiscard]] std::uint32_t skinOf(std::uint32_t fish) const {
        std::vector<motion::FishRecord> records;
        world.records(records);
        return records[fish].skin;
    }
};

TEST_F(DrawingsInAWorld, waitOutOfSight) {
    pass(20);
    for (std::uint32_t fish = 0; fish < kFish + kSlots; ++fish) {
        EXPECT_EQ(isAway(fish), fish >= kFish) << fish;
        EXPECT_EQ(skinOf(fish), 0U);
    }
}

TEST_F(DrawingsInAWorld, comeFromTheirMakersSideAndShowThemselvesBeforeTheViewer) {
    pass(1);
    letIn(kFish, -1);
    letIn(kFish + 1, 1);
    world.advance();
    EXPECT_LT(fromEye(kFish).x, -1.5F);
    EXPECT_GT(fromEye(kFish + 1).x, 1.5F);
    EXPECT_GT(fromEye(kFish).z, 0) << "behind the viewer";
    EXPECT_EQ(skinOf(kFish), kNumber);
    EXPECT_EQ(world.traits()[kFish].lengthMillimetres,
              std::lround(1000 * visited(kSlots).cast[0].size.mostMetres));
    for (int second = 0; second < 40 && visit(kFish) == fish::Visit::Enters; ++second) pass(1);
    ASSERT_EQ(visit(kFish), fish::Visit::Shows);
    EXPECT_LT(place::lengthOf(fromEye(kFish)), 2.6F);
    EXPECT_LT(fromEye(kFish).z, -1.0F) << "ahead of the viewer";
    pass(10);
    EXPECT_EQ(visit(kFish), fish::Visit::Stays);
}

// A tour at the autopilot's fastest: the viewer waits for small fish, and goes on.
TEST(DrawingsOfAWorld, reachAViewerOnItsTourAndKeepUpWithIt) {
    WorldOptions options = visited(0);
    options.cast[0] = capturedSpecies(test::castMember("clownfish"), kFish + kSlots);
    options.cast[0].drawings = kSlots;
    options.scene.water.halfExtent = {15, 2, 15};
    options.scene.tour.emplace();
    options.scene.tour->metresPerSecond = 0.6;
    World world(options);
    const auto pass = [&](int seconds) {
        for (int tick = 0; tick < 60 * seconds; ++tick) world.advance();
    };
    const auto speed = [&] {
        return place::lengthOf(world.environment().surroundings->submarine.velocityMetresPerSecond);
    };
    pass(30);
    const float before = speed();
    EXPECT_GT(before, 0.5F);
    const fish::Wearers& wearers = *world.environment().wearers;
    const fish::Wearer& wearer = *wearers.of(kFish);
    const auto fromEye = [&] { return world.view().position(kFish) - wearers.eye; };
    world.apply(EnterDrawing{.fish = kFish, .number = 1, .picture = {}, .aside = 1});
    int seconds = 0;
    for (; seconds < 40 && wearer.visit == fish::Visit::Enters; ++seconds) pass(1);
    EXPECT_LT(seconds, 35) << "it comes by itself";
    for (; wearer.visit == fish::Visit::Shows; pass(1)) {
        EXPECT_GT(place::dot(fromEye(), wearers.ahead), 0.6F) << "it is seen";
        EXPECT_LT(place::lengthOf(fromEye()), 3.2F);
    }
    EXPECT_EQ(wearer.visit, fish::Visit::Stays);
    pass(20);
    EXPECT_GT(speed(), 0.9F * before) << "the tour goes on";
    std::cout << "it came in " << seconds << " s\n";
}

TEST_F(DrawingsInAWorld, swimAwayBehindTheViewerAndWaitForAnother) {
    letIn(kFish);
    pass(60);
    ASSERT_EQ(visit(kFish), fish::Visit::Stays);
    world.apply(LeaveDrawing{kFish});
    int seconds = 0;
    for (; seconds < 61 && !isAway(kFish); ++seconds) {
        EXPECT_EQ(skinOf(kFish), kNumber) << "until it is out of sight";
        pass(1);
    }
    EXPECT_LT(seconds, 60) << "by itself";
    EXPECT_EQ(visit(kFish), fish::Visit::Asleep);
    EXPECT_EQ(skinOf(kFish), 0U);
    letIn(kFish, 1);
    EXPECT_FALSE(isAway(kFish));
}

TEST_F(DrawingsInAWorld, areOfNoEffectOnOtherFish) {
    letIn(3);
    letIn(4000);
    world.apply(LeaveDrawing{3});
    world.apply(LeaveDrawing{kFish});
    EXPECT_EQ(skinOf(3), 0U);
    EXPECT_TRUE(isAway(kFish));
}

// The same inputs make the same world, and a drawing is part of its hash.
TEST(DrawingsOfAWorld, arePartOfItsHash) {
    World one(visited(kSlots));
    World other(visited(kSlots));
    World without(visited(kSlots));
    const EnterDrawing drawing{.fish = kFish, .number = 1, .picture = {}, .aside = 0};
    one.apply(drawing);
    other.apply(drawing);
    EXPECT_NE(one.hash(), without.hash());
    for (int tick = 0; tick < 600; ++tick) {
        one.advance();
        other.advance();
    }
    EXPECT_EQ(one.hash(), other.hash());
}

// A shark that is hungry catches scads, and none that wears a drawing unless it may.
TEST(DrawingsOfAWorld, areSparedUnlessTheyMayBeEaten) {
    constexpr std::uint32_t kScads = 40;
    const auto eaten = [](bool mayBe) {
        WorldSpecies prey = scads(kScads);
        prey.habits.fear.metres = 0.8F;  // in so little water farther sight would be endless fear
        prey.drawings = kScads;
        WorldOptions options = openWater(4, {prey, sharks(1)});
        options.drawingsMayBeEaten = mayBe;
        options.scene.eye = place::kEyePosition;
        World world(options);
        for (std::uint32_t fish = 0; fish < kScads; ++fish)
            world.apply(EnterDrawing{.fish = fish, .number = fish + 1, .picture = {}, .aside = 0});
        for (int tick = 0; tick < 60 * 1200; ++tick) world.advance();
        return world.counts().catches;
    };
    EXPECT_EQ(eaten(false), 0U);
    EXPECT_GT(eaten(true), 0U);
}

}  // namespace
}  // namespace aquarama::world
