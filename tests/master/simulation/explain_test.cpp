// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

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
        for (std::uint32_t fish = 0; fish < 41; ++fish)
            ASSERT_FALSE(watched.explain(fish).lines.empty());
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
            const std::vector<std::string> lines = world.explain(fish).lines;
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
    EXPECT_TRUE(world.explain(41).lines.empty());
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
        const std::vector<std::string> lines = world.explain(fish).lines;
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
    const std::vector<std::string> lines = world.explain(0).lines;
    EXPECT_THAT(lines, Contains(HasSubstr("blacktip_reef_shark, ")));
    EXPECT_THAT(lines, Contains(AllOf(HasSubstr("INTENDS"), HasSubstr("escape"))));
    EXPECT_THAT(lines, Contains(HasSubstr("comes after fear")));
    EXPECT_THAT(world.explain(1).lines, Contains(HasSubstr("predator")));
}

// As the lines say where something is.
std::string sectorOf(float degreesRight) {
    const float aside = std::abs(degreesRight);
    const std::string side = degreesRight < 0 ? "left" : "right";
    if (aside >= 65 && aside < 115) return side;
    const std::string depth = aside < 65 ? "ahead" : "behind";
    return aside < 25 || aside >= 155 ? depth : depth + " " + side;
}

TEST(Explain, theValuesAreThoseOfTheLines) {
    constexpr std::array kSightings{"predator    ", "food        ", "mate        ", "prey "};
    Lived world(worldOptionsOf(test::syntheticAssets()), 300);
    int sightings = 0;
    for (std::uint32_t fish = 0; fish < 41; ++fish) {
        const conductor::Explanation one = world.explain(fish);
        const std::string text = testing::PrintToString(one.lines);
        ASSERT_TRUE(one.intention);
        const std::string target = one.target.empty() ? "" : " " + one.target;
        EXPECT_THAT(text,
                    HasSubstr(fmt::format("INTENDS  {}{}, its aim for {:.1f} s",
                                          fish::nameOf(*one.intention),
                                          target,
                                          one.pursuedSeconds)));
        for (const float feeling : {one.feelings.hunger, one.feelings.libido, one.feelings.fear})
            EXPECT_THAT(text, HasSubstr(fmt::format("] {:.2f}", feeling)));
        for (const conductor::NearestSeen& seen : one.seen) {
            ++sightings;
            EXPECT_THAT(text,
                        HasSubstr(fmt::format("{}{}, {:.1f} L {}",
                                              kSightings.at(static_cast<std::size_t>(seen.kind)),
                                              seen.name,
                                              seen.distanceLengths,
                                              sectorOf(seen.degreesRight))));
        }
    }
    EXPECT_GT(sightings, 0);
}

TEST(Explain, anEatenFishIsSaidToBeAway) {
    Insight insight;
    insight.away = true;
    fish::FishView view;
    view.resize(1);
    const std::vector<std::string> names{"scad"};
    const conductor::Explanation explanation = explanationOf(insight, {view, names});
    EXPECT_THAT(explanation.lines, Contains(HasSubstr("away")));
    EXPECT_FALSE(explanation.intention);
}

}  // namespace
}  // namespace aquarama::simulation
