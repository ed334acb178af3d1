// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/wire/messages.h"
#include "master/simulation/insight.h"
#include "master/simulation/living_world.h"
#include "tests/master/world/few_fish.h"
#include "tests/support/messages.h"
#include "tests/support/synthetic_assets.h"

namespace aquarama::simulation {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// A world that has lived for so many ticks.
struct Lived final : LivingWorld {
    Lived(const world::WorldOptions& options, int ticks) : LivingWorld(options) {
        for (int i = 0; i < ticks; ++i) advance();
    }
};

TEST(Explain, lookingIntoAMindChangesNothing) {
    const world::WorldOptions options = worldOptionsOf(test::syntheticAssets());
    Lived watched(options, 200);
    Lived alone(options, 200);
    for (int tick = 0; tick < 60; ++tick) {
        for (std::uint32_t fish = 0; fish < 41; ++fish) ASSERT_FALSE(watched.explain(fish).empty());
        ASSERT_EQ(watched.hash(), alone.hash()) << tick;
        watched.advance();
        alone.advance();
    }
}

// The nodes draw it, terminals print it.
TEST(Explain, everyMindFitsOnAScreenOfPlainText) {
    Lived world(worldOptionsOf(test::syntheticAssets()), 100);
    for (int tick = 0; tick < 300; ++tick) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 41; ++fish) {
            const std::vector<std::string> lines = world.explain(fish);
            ASSERT_LE(lines.size(), kScreenLines);
            for (const std::string& line : lines) {
                ASSERT_LE(line.size(), kScreenColumns) << line;
                ASSERT_TRUE(std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; }))
                    << line;
            }
            ASSERT_TRUE(wire::decode(wire::encode(1, test::explanation(fish, 41, 0, lines))));
        }
    }
}

TEST(Explain, aFishThatIsNotThereHasNoLines) {
    const Lived world(worldOptionsOf(test::syntheticAssets()), 1);
    EXPECT_TRUE(world.explain(41).empty());
}

// Exactly one rule wins; whatever is after it has lost, each for a reason that is printed.
TEST(Explain, oneIntentionWinsAndEveryOtherSaysWhyItLost) {
    Lived world(worldOptionsOf(test::syntheticAssets()), 300);
    for (std::uint32_t fish = 0; fish < 41; ++fish) {
        const auto insight = insightInto(world.world(), fish);
        ASSERT_TRUE(insight);
        EXPECT_EQ(
            std::ranges::count(
                insight->reasoning.rules, behaviour::Verdict::Wins, &behaviour::Weighed::verdict),
            1);
        const std::vector<std::string> lines = world.explain(fish);
        const auto why = std::ranges::find_if(
            lines, [](const std::string& line) { return line.starts_with("WHY"); });
        ASSERT_EQ(lines.end() - why, static_cast<std::ptrdiff_t>(behaviour::kPriorityRules));
        EXPECT_TRUE(std::all_of(
            why, lines.end(), [](const std::string& line) { return line.size() > 25; }));
    }
}

// A scad two metres before a hungry shark's mouth.
TEST(Explain, aFrightenedFishIsSaidToFlee) {
    world::WorldOptions options = world::openWater(1, {world::scads(1), world::sharks(1)});
    const glm::vec3 middle = options.scene.water.centre;
    options.cast[0].start = config::Start{.centre = middle, .radiusMetres = 0.01};
    options.cast[1].start = config::Start{
        .centre = middle + glm::vec3{0.8F, 0, 0.3F}, .radiusMetres = 0.01, .hunger = 0.9};
    const Lived world(options, 12);
    const auto insight = insightInto(world.world(), 0);
    ASSERT_TRUE(insight);
    EXPECT_GT(insight->feelings.fear, 0.25F);
    const std::vector<std::string> lines = world.explain(0);
    EXPECT_THAT(lines, Contains(HasSubstr("blacktip_reef_shark, ")));
    EXPECT_THAT(lines, Contains(AllOf(HasSubstr("INTENDS"), HasSubstr("escape"))));
    EXPECT_THAT(lines, Contains(HasSubstr("comes after fear")));
    EXPECT_THAT(world.explain(1), Contains(HasSubstr("predator")));
}

TEST(Explain, anEatenFishIsSaidToBeAway) {
    Insight insight;
    insight.away = true;
    fish::FishView view;
    view.resize(1);
    const std::vector<std::string> names{"scad"};
    EXPECT_THAT(linesOf(insight, {view, names}), Contains(HasSubstr("away")));
}

}  // namespace
}  // namespace aquarama::simulation
