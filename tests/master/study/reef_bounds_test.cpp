// SPDX-License-Identifier: Apache-2.0
// aquarama_reef_bounds: the default scene held to what a visitor is to see of it, from the eye at
// rest, through the wall of the theatre: ten minutes by day of one seed. With AQUARAMA_SOAK in the
// environment also an hour of three seeds, how its fish live in it, and four hours of the school's
// path; and an hour of the scene of the paper. No suite of ctest: it takes the build of the show.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <future>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/base/statistics.h"
#include "common/config/rig.h"
#include "master/study/diary.h"
#include "master/study/occupation.h"
#include "master/study/overlaps.h"
#include "master/study/quantities.h"
#include "master/study/school_path.h"
#include "master/study/species_log.h"
#include "master/study/study.h"
#include "master/study/wall_study.h"

namespace aquarama::study {
namespace {

constexpr std::uint64_t kTicksOfSecond = 60;
constexpr std::uint64_t kSecondsOfHour = 3600;
constexpr std::uint64_t kSecondsOfDay = 1200;
constexpr std::size_t kSeeds = 3;

bool isSoak() {
    return std::getenv("AQUARAMA_SOAK") != nullptr;
}

Scenario sceneOf(const std::string& name, std::uint32_t seed) {
    Scenario scenario = readScenario(AQUARAMA_SOURCE_DIR "/config/scenes/" + name + ".txtpb");
    scenario.world.seed = seed;
    return scenario;
}

const config::Rig& theatre() {
    static const config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
    return rig;
}

void expectDay(const WallFigures& day) {
    const std::string line = wallLine(day);
    std::cout << line << '\n';
    EXPECT_GE(day.cellShare.median, 0.42) << "cells with a fish of half a degree\n" << line;
    for (std::size_t third = 0; third < kThirds; ++third)
        EXPECT_GE(day.full.at(third), 0.90) << "of the time third " << third << " is full\n"
                                            << line;
    EXPECT_GE(day.allFull, 0.80) << "of the time all thirds are full\n" << line;
    EXPECT_LE(std::ranges::max(day.gapSeconds), 10U)
        << "seconds of a third without a fish of a degree\n"
        << line;
    EXPECT_LE(day.largestGroup.median, 0.25) << "of the fish in view in one school\n" << line;
    EXPECT_GE(day.species.median, 8) << "species of a degree\n" << line;
    EXPECT_GE(day.allEventsAMinute, 6) << "events a minute\n" << line;
}

void expectNight(const WallFigures& night) {
    std::cout << "by night: " << wallLine(night) << '\n';
    EXPECT_GE(night.cellShare.median, 0.14) << "cells with a fish of half a degree by night";
}

// From the end of dawn to sunset.
TEST(ReefByDay, tenMinutesKeepTheBounds) {
    Scenario scenario = sceneOf("reef", 1);
    scenario.world.scene.day.startsAt = 0.25;
    world::World world(scenario.world);
    WallStudy study(theatre(), world);
    for (std::uint64_t tick = 0; tick < 600 * kTicksOfSecond; ++tick) {
        world.advance();
        study.note(world);
    }
    const WallFigures day = study.figures(DayPart::Day);
    ASSERT_GE(day.seconds, 599U);
    expectDay(day);
}

// How the fish of a species lived for an hour.
struct Living {
    std::string name = {};
    bool isHunted = false, isHunter = false;
    SpeciesTally tally = {};
    std::uint64_t spawningsOfADay = 0;
    // Shares of its time outside shelter: in overlaps, and in sand, rock or air.
    double overlaps = 0, inTerrain = 0;
};

// Figures of an hour, and the school's path for longer.
struct Life {
    WallFigures day, night;
    std::vector<Living> species;
    // Share of the time of all fish outside shelter.
    double overlaps = 0, inTerrain = 0;
    // Of the school by day: shares of the time in one part, two to four, and more; 5 % and 95 %
    // quantile of its polarisation.
    double inTwoToFour = 0, inMore = 0;
    double lowPolarisation = 0, highPolarisation = 0;
    std::vector<glm::dvec3> path;
};

// Where bodies are, outside shelter.
class Bodies {
  public:
    static constexpr std::uint64_t kTicksBetweenGlances = 5;

    Bodies(const world::World& world, std::vector<float> halfWidths)
        : halfWidths_(std::move(halfWidths)), overlaps_(kTicksBetweenGlances) {
        outside_.resize(world.view().size());
        inTerrain_.resize(world.view().size());
        intentions_.resize(world.view().size());
    }

    // Who is in a shelter touches nobody: its rod has no length. Nor has that of a cleaner at work,
    // which lives by touching its clients.
    void note(const world::World& world) {
        if (world.tick().value % kTicksBetweenGlances != 0) return;
        rodsOf(world.view(), halfWidths_, rods_);
        const StudiedFish studied{world.view(), world.minds(), world.speciesParameters()};
        for (std::uint32_t fish = 0; fish < rods_.size(); ++fish) {
            if (isSheltered(studied, fish) ||
                fish::aimOf(world.minds()[fish]).intention == fish::Intention::Clean)
                rods_[fish].length = 0;
            intentions_[fish] = world.minds()[fish].intention;
            if (rods_[fish].length == 0) continue;
            ++outside_[fish];
            inTerrain_[fish] += isInTerrain(world.surroundings().obstacles, rods_[fish]) ? 1 : 0;
        }
        overlaps_.note(world.tick(), rods_, intentions_);
    }
    // Writes the shares of each species and of all.
    void share(const world::World& world, Life& life) const {
        std::vector<double> overlapped(outside_.size());
        for (const BodyOverlap& overlap : overlaps_.all())
            for (const std::uint32_t fish : {overlap.a, overlap.b})
                overlapped[fish] += static_cast<double>(overlap.ticks) / kTicksBetweenGlances;
        double outside = 0;
        for (const fish::SpeciesParameters& parameters : world.speciesParameters()) {
            Living& living = life.species[parameters.kind];
            double own = 0;
            for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish) {
                own += outside_[fish];
                living.overlaps += overlapped[fish];
                living.inTerrain += inTerrain_[fish];
            }
            outside += own;
            life.overlaps += living.overlaps;
            life.inTerrain += living.inTerrain;
            living.overlaps /= own;
            living.inTerrain /= own;
        }
        life.overlaps /= outside;
        life.inTerrain /= outside;
    }

  private:
    std::vector<float> halfWidths_;
    OverlapLog overlaps_;
    std::vector<Rod> rods_;
    std::vector<fish::Intention> intentions_;
    std::vector<std::uint32_t> outside_, inTerrain_;  // glances, by fish
};

WallFigures ofFirstHour(const WallStudy& study, DayPart part) {
    const auto events = std::ranges::find_if(study.events(), [](const NotedEvent& event) {
        return event.tick.value > kSecondsOfHour * kTicksOfSecond;
    });
    return wallFiguresOf(
        study.seconds().first(kSecondsOfHour), {study.events().begin(), events}, study.day(), part);
}

void describeSchool(const WallStudy& study, const std::vector<double>& polarisation, Life& life) {
    double seconds = 0;
    std::vector<double> byDay;
    for (std::size_t i = 0; i < study.seconds().size(); ++i) {
        const WallSecond& second = study.seconds()[i];
        if (second.centre) life.path.push_back(*second.centre);
        if (second.part == DayPart::Night) continue;
        ++seconds;
        life.inTwoToFour += second.parts >= 2 && second.parts <= 4 ? 1 : 0;
        life.inMore += second.parts > 4 ? 1 : 0;
        byDay.push_back(polarisation[i]);
    }
    life.inTwoToFour /= seconds;
    life.inMore /= seconds;
    life.lowPolarisation = quantile(byDay, 0.05);
    life.highPolarisation = quantile(byDay, 0.95);
}

Life livedFor(std::uint64_t hours, const std::string& scene, std::uint32_t seed) {
    const Scenario scenario = sceneOf(scene, seed);
    world::World world(scenario.world);
    WallStudy study(theatre(), world);
    SpeciesLog log(world, scenario.world.cast);
    Bodies bodies(world, scenario.halfWidths);
    Life life;
    std::vector<double> polarisation;
    const fish::SpeciesParameters& school = world.speciesParameters().front();
    for (std::uint64_t tick = 1; tick <= hours * kSecondsOfHour * kTicksOfSecond; ++tick) {
        world.advance();
        study.note(world);
        if (tick % kTicksOfSecond == 0)
            polarisation.push_back(
                schoolFigures(world.view(), school.first, school.last).polarisation);
        if (tick > kSecondsOfHour * kTicksOfSecond) continue;
        log.note(world);
        bodies.note(world);
        if (tick == kSecondsOfDay * kTicksOfSecond)
            for (const SpeciesTally& tally : log.byKind())
                life.species.push_back({.spawningsOfADay = tally.spawnings});
    }
    for (const fish::SpeciesParameters& parameters : world.speciesParameters()) {
        Living& living = life.species[parameters.kind];
        living.name = scenario.world.cast[parameters.kind].name;
        living.isHunted = parameters.huntedBy != 0;
        living.isHunter = parameters.habits.role == config::Role::Predator;
        living.tally = log.byKind()[parameters.kind];
    }
    bodies.share(world, life);
    life.day = ofFirstHour(study, DayPart::Day);
    life.night = ofFirstHour(study, DayPart::Night);
    describeSchool(study, polarisation, life);
    return life;
}

// One life of each seed, at once.
std::vector<Life> livesOf(std::uint64_t hours, const std::string& scene) {
    std::vector<std::future<Life>> running;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed)
        running.push_back(std::async(std::launch::async, livedFor, hours, scene, seed));
    std::vector<Life> lives;
    for (std::future<Life>& life : running) lives.push_back(life.get());
    return lives;
}

class ReefForHours : public testing::Test {
  protected:
    void SetUp() override {
        if (!isSoak()) GTEST_SKIP() << "takes hours of the scene: AQUARAMA_SOAK=1";
    }
    static constexpr std::uint64_t kHours = 4;
    static const std::vector<Life>& lives() {
        static const std::vector<Life> lives = livesOf(kHours, "reef");
        return lives;
    }
    // Of each seed.
    static void everyLife(const std::function<void(const Life&)>& claim) {
        for (std::size_t i = 0; i < kSeeds; ++i) {
            SCOPED_TRACE(testing::Message() << "seed " << i + 1);
            std::cout << "seed " << i + 1 << '\n';
            claim(lives()[i]);
        }
    }
};

TEST_F(ReefForHours, anHourKeepsTheBoundsByDayAndNight) {
    everyLife([](const Life& life) {
        expectDay(life.day);
        expectNight(life.night);
    });
}

TEST_F(ReefForHours, nobodyIsInSandRockOrAir) {
    everyLife([](const Life& life) {
        for (const Living& species : life.species) {
            if (species.inTerrain > 0)
                std::cout << fmt::format(
                    "{}: {:.2f} % of its time\n", species.name, 100 * species.inTerrain);
            EXPECT_EQ(species.inTerrain, 0) << species.name;
        }
    });
}

TEST_F(ReefForHours, bodiesOverlapForTwoPercentOfTheTimeOutsideShelterAtMost) {
    everyLife([](const Life& life) {
        std::cout << fmt::format("all: {:.2f} %\n", 100 * life.overlaps);
        for (const Living& species : life.species) {
            std::cout << fmt::format("{}: {:.2f} %\n", species.name, 100 * species.overlaps);
            EXPECT_LE(species.overlaps, 0.02) << species.name;
        }
    });
}

// A shark bears its young alive: it courts nobody here.
constexpr const char* kBearsLiveYoung = "blacktip_reef_shark";

// Hunters eat seldom: all three hours together tell whether they do.
TEST_F(ReefForHours, huntersEat) {
    std::map<std::string, std::uint64_t> meals;
    everyLife([&](const Life& life) {
        for (const Living& species : life.species)
            if (species.isHunter) meals[species.name] += species.tally.meals;
    });
    EXPECT_FALSE(meals.empty());
    for (const auto& [name, count] : meals) EXPECT_GT(count, 0U) << name;
}

TEST_F(ReefForHours, everySpeciesEatsFleesAndSpawnsWithinADay) {
    everyLife([](const Life& life) {
        for (const Living& species : life.species) {
            const SpeciesTally& tally = species.tally;
            std::cout << fmt::format(
                "{}: meals {}, flights {}, dives {}; spawnings {}, on the first day {}\n",
                species.name,
                tally.meals,
                tally.flights,
                tally.dives,
                tally.spawnings,
                species.spawningsOfADay);
            if (!species.isHunter) {
                EXPECT_GT(tally.meals, 0U) << species.name;
            }
            if (species.isHunted) {
                EXPECT_GT(tally.flights + tally.dives, 0U) << species.name;
            }
            if (species.name != kBearsLiveYoung) {
                EXPECT_GT(species.spawningsOfADay, 0U) << species.name;
            }
        }
    });
}

TEST_F(ReefForHours, theSchoolPartsNowAndThenAndItsPolarisationWanders) {
    everyLife([](const Life& life) {
        std::cout << fmt::format(
            "by day in two to four parts {:.0f} % of the time, in more {:.1f} %; polarisation "
            "{:.2f} to {:.2f}\n",
            100 * life.inTwoToFour,
            100 * life.inMore,
            life.lowPolarisation,
            life.highPolarisation);
        EXPECT_GE(life.inTwoToFour, 0.05) << "of the time";
        EXPECT_LE(life.inMore, 0.05) << "of the time";
        EXPECT_GE(life.highPolarisation - life.lowPolarisation, 0.3);
    });
}

// Tide and day are periods of the world; a peak of any other one would be a script's. The lags of
// a peak are known to a tenth of the tide.
TEST_F(ReefForHours, thePathOfTheSchoolHasNoPeriodOfItsOwn) {
    constexpr std::array<std::size_t, 2> kPeriods{620, 1200};
    constexpr std::size_t kTolerance = 62;
    std::vector<double> mean(2 * kSecondsOfHour + 1);
    for (const Life& life : lives()) {
        const std::vector<double> own = autocorrelationOf(life.path, mean.size() - 1);
        for (std::size_t lag = 0; lag < mean.size(); ++lag) mean[lag] += own[lag] / kSeeds;
    }
    const PathPeak any = highestPeak(mean);
    const PathPeak other = highestPeak(mean, kPeriods, kTolerance);
    std::cout << fmt::format(
        "highest peak {:.2f} after {} s; beside the periods of tide and day {:.2f} after {} s\n",
        any.height,
        any.lag,
        other.height,
        other.lag);
    EXPECT_LE(other.height, 0.3) << "after " << other.lag << " s";
}

TEST(ReefOf1998, anHourKeepsItsBound) {
    if (!isSoak()) GTEST_SKIP() << "takes an hour of the scene: AQUARAMA_SOAK=1";
    for (const Life& life : livesOf(1, "reef_1998")) {
        std::cout << wallLine(life.day) << '\n';
        EXPECT_GE(life.day.cellShare.median, 0.20) << "cells with a fish of half a degree";
    }
}

}  // namespace
}  // namespace aquarama::study
