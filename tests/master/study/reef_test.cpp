// SPDX-License-Identifier: Apache-2.0
// The reef as on the wall, with its real fish: five minutes of it, or with AQUARAMA_SOAK in the
// environment a day and a night.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "master/study/chronicle.h"
#include "master/study/study.h"

namespace aquarama::study {
namespace {

constexpr std::uint64_t kTicksOfMinute = 3600;

bool isSoak() {
    return std::getenv("AQUARAMA_SOAK") != nullptr;
}

// What was seen, each hour or, of the short life, all of it.
struct Life {
    std::vector<Hour> hours;
    std::vector<BodyOverlap> overlaps;
    std::string overlapsCsv;
    SpeciesTally species;
    std::uint64_t hash = 0;
};

Scenario sceneOf(const std::string& name) {
    return readScenario(AQUARAMA_SOURCE_DIR "/config/scenes/" + name + ".txtpb");
}

Life lived() {
    const Scenario scenario = sceneOf("reef");
    world::World world(scenario.world);
    const std::uint64_t hour = (isSoak() ? 60 : 5) * kTicksOfMinute;
    Chronicle chronicle(world, scenario.halfWidths, scenario.world.cast, hour);
    const std::uint64_t ticks = isSoak() ? 24 * hour : hour;
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        world.advance();
        chronicle.note(world);
    }
    if (isSoak())
        std::cout << hoursCsv(chronicle.hours()) << "hash of the world: " << std::hex
                  << world.hash() << std::dec << '\n';
    return {chronicle.hours(),
            chronicle.overlaps().all(),
            overlapsCsv(chronicle.overlaps(), world, scenario.world.cast),
            chronicle.species().all(),
            world.hash()};
}

class Reef : public testing::Test {
  protected:
    static const Life& life() {
        static const Life life = lived();
        return life;
    }
    template <class Claim>
    static void everyHour(const Claim& claim) {
        for (std::size_t i = 0; i < life().hours.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "hour " << i + 1);
            claim(life().hours[i]);
        }
    }
};

// They meet, cross and brush past one another, but nobody stays inside another fish.
TEST_F(Reef, noTwoFishOverlapForLong) {
    constexpr std::uint64_t longest = 6 * 60;
    // In a day one of a hundred thousand lasts longer.
    const std::uint64_t longestDeep = (isSoak() ? 5 : 4) * 60;
    for (const BodyOverlap& overlap : life().overlaps) {
        const auto pair = [&] {
            return testing::Message() << "fish " << overlap.a << " and " << overlap.b
                                      << " from tick " << overlap.from.value;
        };
        EXPECT_LE(overlap.ticks, longest) << pair();
        EXPECT_LE(overlap.deepTicks, longestDeep) << pair() << ", over a quarter of a body";
    }
    everyHour([](const Hour& hour) { EXPECT_LT(hour.overlapPercent, 3); });
}

TEST_F(Reef, nobodyLeavesTheWaterOrEntersTheTerrain) {
    everyHour([](const Hour& hour) {
        EXPECT_EQ(hour.bumps, 0U) << "into rock, sand or surface";
        EXPECT_LT(hour.farthestOutMetres, 0.6) << "a turn needs room";
    });
}

TEST_F(Reef, nobodyIsStuckAndNothingCollapsesIntoACorner) {
    const float minutes = isSoak() ? 60 : 5;
    everyHour([&](const Hour& hour) {
        EXPECT_GT(hour.shortestWayMetres, 0.5F * minutes);
        EXPECT_LT(hour.longestStaySeconds, 180) << "fish " << hour.whoStayed;
        EXPECT_GT(hour.spreadMetres, 1.0F);
        EXPECT_GT(hour.waterUsedPercent, 50);
    });
}

// Fish turn by bending, and go where they look: what the motor adds to the captured motion is a
// fifth of the turning at most, and slides by 8 degrees at most.
void expectCapturedMotion(const SpeciesTally& motion) {
    EXPECT_GE(motion.heading.percent(), 85);
    EXPECT_LE(quantileDegrees(motion.meanSlip, 0.99), 8);
    EXPECT_LT(static_cast<double>(motion.changes) / motion.fishSeconds, 7) << "changes of command";
}

TEST_F(Reef, fishTurnByCapturedSegmentsAndDoNotSlide) {
    expectCapturedMotion(life().species);
}

TEST_F(Reef, mealsAndSpawningsBySpeciesAreThoseOfTheWorld) {
    std::uint64_t meals = 0;
    std::uint64_t bites = 0;
    std::uint64_t spawnings = 0;
    for (const Hour& hour : life().hours) {
        meals += hour.counts.meals + hour.counts.catches;
        bites += hour.counts.bites;
        spawnings += hour.counts.spawnings;
    }
    EXPECT_GT(spawnings, 0U);
    EXPECT_EQ(life().species.spawnings, spawnings);
    EXPECT_GT(meals, 0U);
    // Of the species that graze, eight bites at least feed as much as a particle; some are begun.
    constexpr std::uint64_t fewestBites = 8;
    constexpr std::uint64_t begun = 31;
    EXPECT_GT(life().species.meals, meals);
    EXPECT_LE(life().species.meals, meals + bites / fewestBites + begun);
    EXPECT_GT(life().species.flights, 0U);
}

TEST(BaitBall, fishTurnByCapturedSegmentsAndDoNotSlide) {
    const Scenario scenario = sceneOf("bait_ball");
    world::World world(scenario.world);
    SpeciesLog species(world, scenario.world.cast);
    for (std::uint64_t tick = 0; tick < kTicksOfMinute; ++tick) {
        world.advance();
        species.note(world);
    }
    expectCapturedMotion(species.all());
}

TEST_F(Reef, theChronicleHasALineForEachHourAndOverlap) {
    const auto lines = [](const std::string& csv) {
        return static_cast<std::size_t>(std::ranges::count(csv, '\n'));
    };
    EXPECT_EQ(lines(hoursCsv(life().hours)), 1 + life().hours.size());
    EXPECT_EQ(lines(life().overlapsCsv), 1 + life().overlaps.size());
}

TEST_F(Reef, noSpeciesDiesOut) {
    everyHour([](const Hour& hour) { EXPECT_GE(hour.fewest, 375U) << "of 381"; });
}

TEST_F(Reef, inADayEveryRoutineIsSeenAndFishEatHuntAndSpawn) {
    if (!isSoak()) GTEST_SKIP() << "takes a day: AQUARAMA_SOAK=1";
    world::WorldCounts all;
    std::array<double, fish::kIntentions> shares{};
    for (const Hour& hour : life().hours) {
        all.meals += hour.counts.meals;
        all.catches += hour.counts.catches;
        all.spawnings += hour.counts.spawnings;
        all.returns += hour.counts.returns;
        EXPECT_GT(hour.counts.meals, 0U);
        for (std::size_t i = 0; i < fish::kIntentions; ++i)
            shares.at(i) += hour.intentionShare.at(i);
    }
    EXPECT_GT(all.catches, 0U);
    EXPECT_GT(all.spawnings, 0U);
    EXPECT_LE(all.catches - all.returns, 6U) << "who was eaten is replaced within a minute";
    for (std::size_t i = 0; i < fish::kIntentions; ++i) {
        // The reef's light and warmth suit all who live there.
        if (i == static_cast<std::size_t>(fish::Intention::Leave)) continue;
        EXPECT_GT(shares.at(i), 0) << "routine " << i;
    }
}

}  // namespace
}  // namespace aquarama::study
