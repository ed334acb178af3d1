// SPDX-License-Identifier: Apache-2.0
// A world that was saved goes on as if it had never stopped, and no bytes but such are taken for
// one.
#include "master/world/world_state.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/base/movement_versions.h"
#include "tests/master/world/lively_worlds.h"

namespace aquarama::world {
namespace {

using testing::HasSubstr;

void advanceTo(World& world, std::uint64_t tick) {
    while (world.tick().value < tick) {
        doAt(world, world.states().size());
        world.advance();
    }
}

std::vector<std::byte> savedBytes(const World& world) {
    WorldState state;
    world.save(state);
    return encodeState(state);
}

// Forty saves of a scene at ticks a few apart, each put into a world that was somewhere else. Its
// bytes hold every number that the next tick reads, so equal bytes later are an equal world.
void compareAt(const std::string& scene) {
    World world(optionsFor(scene));
    WorldOptions others = optionsFor(scene);
    others.scene.livedSeconds = 0;
    others.threads = 2;
    World restored(others);
    std::mt19937 random(20261127);
    std::vector<std::byte> saved = savedBytes(world);
    for (int i = 0; i < 40; ++i) {
        restore(restored, saved, "saved");
        ASSERT_EQ(restored.hash(), world.hash()) << scene << " at tick " << world.tick().value;
        const std::uint64_t next = world.tick().value + 1 + random() % 24;
        advanceTo(world, next);
        advanceTo(restored, next);
        saved = savedBytes(world);
        ASSERT_TRUE(savedBytes(restored) == saved) << scene << " before tick " << next;
        advanceTo(restored, next + random() % 8);  // is elsewhere when it is restored
    }
    restore(restored, saved, "saved");
    const std::uint64_t later = world.tick().value + 300;
    advanceTo(world, later);
    advanceTo(restored, later);
    EXPECT_EQ(restored.hash(), world.hash()) << scene;
}

TEST(WorldState, everySceneGoesOnFromASaveAtAThousandTicks) {
    const std::vector<std::string> scenes = allScenes();
    ASSERT_GE(scenes.size() * 40, 1000U);
    for (const std::string& scene : scenes) ASSERT_NO_FATAL_FAILURE(compareAt(scene));
}

class SavedWorld : public testing::Test {
  protected:
    SavedWorld() { advanceTo(world_, 200); }

    [[nodiscard]] WorldState state() const {
        WorldState state;
        world_.save(state);
        return state;
    }
    // The error with which bytes are refused; empty: they are taken.
    [[nodiscard]] std::string refusalOf(const std::vector<std::byte>& bytes) {
        try {
            restore(world_, bytes, "FILE");
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
    template <class Change>
    [[nodiscard]] std::string refusalAfter(Change change) {
        WorldState changed = state();
        change(changed);
        return refusalOf(encodeState(changed));
    }

    World world_{optionsFor("reef_1998")};
};

TEST_F(SavedWorld, isRefusedWhereAnyByteWasAlteredOrCutOff) {
    const std::vector<std::byte> saved = encodeState(state());
    EXPECT_EQ(refusalOf(saved), "");
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::byte> altered = saved;
        altered[random() % altered.size()] ^= std::byte{1} << random() % 8;
        EXPECT_THAT(refusalOf(altered), HasSubstr("FILE: "));
        std::vector<std::byte> cut = saved;
        cut.resize(random() % cut.size());
        EXPECT_THAT(refusalOf(cut), HasSubstr("FILE: "));
    }
    EXPECT_THAT(refusalOf({}), HasSubstr("no saved world"));
}

TEST_F(SavedWorld, ofAnotherBuildIsRefusedByName) {
    std::vector<std::byte> saved = encodeState(state());
    saved[9] = std::byte{kMindsVersion + 1};
    EXPECT_EQ(refusalOf(saved),
              "FILE: saved by another build, with version " + std::to_string(kMindsVersion + 1) +
                  " of the minds; this one has " + std::to_string(kMindsVersion));
}

TEST_F(SavedWorld, ofAnotherWorldIsRefused) {
    WorldState other;
    World(optionsFor("bait_ball")).save(other);
    EXPECT_THAT(refusalOf(encodeState(other)), HasSubstr("another world"));
}

// The digest is right in all of these: somebody else than we wrote them.
TEST_F(SavedWorld, withNumbersThatCannotBeIsRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusalAfter([&](WorldState& s) { s.courses[3].direction.y = nan; }),
                HasSubstr("beyond all bounds"));
    EXPECT_THAT(refusalAfter([&](WorldState& s) { s.timeOfDay = nan; }),
                HasSubstr("beyond all bounds"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.timeOfDay = 1; }), HasSubstr("time of day"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.states.segment[4] = 0xffff; }),
                HasSubstr("fish 4"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.commands.action[5] = 200; }),
                HasSubstr("fish 5"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.minds[6].intention = fish::Intention{77}; }),
                HasSubstr("fish 6"));
    EXPECT_THAT(refusalAfter([](WorldState& s) {
                    s.minds[7].intention = fish::Intention::Escape;
                    s.minds[7].target = 1'000'000;
                }),
                HasSubstr("the aim of fish 7"));
    EXPECT_THAT(
        refusalAfter([](WorldState& s) { s.absences.push_back({.fish = 1'000, .until = {}}); }),
        HasSubstr("absence"));
    EXPECT_THAT(refusalAfter([](WorldState& s) {
                    s.meals.swallows = {{0, 1'000'000, 3}};
                }),
                HasSubstr("meal 0"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.wearers.front().aside = 5; }),
                HasSubstr("drawing 0"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.nextDrop = 99; }), HasSubstr("drop 99"));
    EXPECT_THAT(refusalAfter([](WorldState& s) { s.hands.hands.resize(kMostWallHands + 1); }),
                HasSubstr("another world"));
}

}  // namespace
}  // namespace aquarama::world
