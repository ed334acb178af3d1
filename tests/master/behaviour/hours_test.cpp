// SPDX-License-Identifier: Apache-2.0
// When fish rest, what outranks their rest, and what the time of day does to schools and clouds.
#include "master/behaviour/hours.h"

#include <gtest/gtest.h>

#include "tests/master/behaviour/aquarium.h"
#include "tests/master/behaviour/fish_in_mind.h"

namespace aquarama::behaviour {
namespace {

using place::DayPhase;

fish::SpeciesParameters speciesOf(config::Activity active) {
    fish::SpeciesParameters parameters;
    parameters.size = {
        .meanMetres = 0.2F, .deviationMetres = 0, .leastMetres = 0.1F, .mostMetres = 0.3F};
    parameters.habits.hours = {.active = active, .retires = 0.5, .rises = 0.5};
    return parameters;
}

bool rests(const fish::SpeciesParameters& parameters, DayPhase phase, double share) {
    return restsAt(parameters, 1, 7, 0.2F, place::timeIn(phase, share));
}

TEST(Hours, aSpeciesOfTheDayRetiresInDuskAndRisesInDawn) {
    const fish::SpeciesParameters day = speciesOf(config::Activity::Day);
    EXPECT_FALSE(rests(day, DayPhase::Dusk, 0.39));
    EXPECT_TRUE(rests(day, DayPhase::Dusk, 0.61));
    EXPECT_TRUE(rests(day, DayPhase::Night, 0.1));
    EXPECT_TRUE(restsAt(day, 1, 7, 0.2F, 0)) << "midnight";
    EXPECT_TRUE(rests(day, DayPhase::Dawn, 0.39));
    EXPECT_FALSE(rests(day, DayPhase::Dawn, 0.61));
    EXPECT_FALSE(rests(day, DayPhase::Noon, 0.5));
}

TEST(Hours, aSpeciesOfTheNightRestsByDayAndOneOfAllHoursNever) {
    const fish::SpeciesParameters night = speciesOf(config::Activity::Night);
    EXPECT_FALSE(rests(night, DayPhase::Dawn, 0.39));
    EXPECT_TRUE(rests(night, DayPhase::Dawn, 0.61));
    EXPECT_TRUE(rests(night, DayPhase::Noon, 0.5));
    EXPECT_TRUE(rests(night, DayPhase::Dusk, 0.39));
    EXPECT_FALSE(rests(night, DayPhase::Dusk, 0.61));
    const fish::SpeciesParameters always = speciesOf(config::Activity::Always);
    for (double time = 0; time < 1; time += 0.01)
        EXPECT_FALSE(restsAt(always, 1, 7, 0.2F, time)) << time;
}

TEST(Hours, oneThatSpawnsInARushMatesAtSunsetAndDuskOnly) {
    fish::SpeciesParameters parameters = speciesOf(config::Activity::Always);
    EXPECT_FALSE(fish::matesAt(parameters, 0.5)) << "no libido";
    parameters.habits.libidoPerSecond = 0.001F;
    EXPECT_TRUE(fish::matesAt(parameters, 0.5));
    parameters.habits.spawnsInRush = true;
    for (int minute = 0; minute < 1440; ++minute) {
        const DayPhase phase = place::phaseOf(minute / 1440.0);
        EXPECT_EQ(fish::matesAt(parameters, minute / 1440.0),
                  phase == DayPhase::Sunset || phase == DayPhase::Dusk);
    }
}

// Over a day each fish has one rest, however early and late it is.
TEST(Hours, theLargerRetireLaterAndRiseEarlier) {
    for (const double share : {0.0, 0.5, 1.0}) {
        fish::SpeciesParameters day = speciesOf(config::Activity::Day);
        day.habits.hours.retires = day.habits.hours.rises = share;
        const auto restOf = [&](float length) {
            int rest = 0, changes = 0;
            for (int minute = 0; minute < 1440; ++minute) {
                const bool now = restsAt(day, 1, 7, length, minute / 1440.0);
                const bool next = restsAt(day, 1, 7, length, (minute + 1) % 1440 / 1440.0);
                rest += now ? 1 : 0;
                changes += now != next ? 1 : 0;
            }
            EXPECT_EQ(changes, 2) << share;
            return rest;
        };
        EXPECT_GT(restOf(0.1F), restOf(0.3F) + 50) << share;
    }
}

TEST(Hours, byDayNothingIsOtherwise) {
    for (double time = place::timeIn(DayPhase::Noon, 0); time < place::beginOf(DayPhase::Sunset);
         time += 0.001)
        for (const place::ByPhase* values :
             {&kCloudHeight, &kSchoolSpacing, &kSchoolSpeed, &kSchoolAlignment, &kSchoolCohesion})
            ASSERT_EQ(place::valueAt(*values, time), 1.0F) << time;
    EXPECT_EQ(place::valueAt(kPatrolsDeeper, 0.5), 0.0F);
}

// A pacifist that is hungry, in love and sees all that it wants.
TEST(Rest, comesBeforeHungerAndLibidoAndAfterDangers) {
    FishInMind fish(config::Role::Pacifist);
    fish.parameters.habits.hours.active = config::Activity::Day;
    fish.parameters.huntedBy = 1;
    fish.feelings = {.hunger = 0.8F, .libido = 0.9F};
    fish.showFood(5);
    fish.showMate(3);
    EXPECT_EQ(fish.think(), fish::Intention::Mate);
    EXPECT_EQ(fish.rule(PriorityRule::Rest).verdict, Verdict::Awake);
    fish.senses.hour.rests = true;
    EXPECT_EQ(fish.think(), fish::Intention::Rest);
    EXPECT_EQ(fish.rule(PriorityRule::Libido).verdict, Verdict::Outranked);
    fish.threaten(9);
    EXPECT_EQ(fish.think(), fish::Intention::AvoidFish);
    fish.clearTheWay();
    fish.frighten(0.9F, 0.9F);
    EXPECT_EQ(fish.think(), fish::Intention::Escape);
    fish.calm();
    EXPECT_EQ(fish.think(), fish::Intention::Rest);
    fish.senses.hour.rests = false;
    EXPECT_EQ(fish.think(), fish::Intention::Mate);
}

TEST(Rest, isKeptInAShelterBesideOthers) {
    FishInMind fish(config::Role::Pacifist);
    fish.parameters.habits.hours.active = config::Activity::Day;
    fish.senses.hour.rests = true;
    fish.senses.shelter.site = {4, {0.2F, 0, 0}, 0.2F};
    EXPECT_EQ(fish.think(), fish::Intention::Rest);
    EXPECT_EQ(fish.mind.target, 4U);
    fish.threaten(9);
    EXPECT_EQ(fish.think(), fish::Intention::Rest);
    EXPECT_EQ(fish.rule(PriorityRule::OtherFish).verdict, Verdict::Sheltered);
}

// The home is 3 m away, the shelter beyond what a fish of 0.24 m sees, but near the home.
TEST(Rest, aFishKnowsTheShelterNearItsHome) {
    Aquarium aquarium({{-4, 0, 0}});
    const glm::vec3 home = Aquarium::kCentre + glm::vec3{3, 0, 0};
    aquarium.speciesParameters[0].homes = {home};
    aquarium.speciesParameters[0].habits.home.kind = config::HomeKind::Place;
    aquarium.speciesParameters[0].habits.hidesIn = {config::SiteKind::Branching};
    aquarium.speciesParameters[0].habits.hours.active = config::Activity::Day;
    aquarium.surroundings.sites = {
        {.kind = config::SiteKind::Branching, .place = home + glm::vec3{1, -1, 0}, .seed = 3}};
    const auto shelterAt = [&](double time) {
        aquarium.surroundings.timeOfDay = time;
        Grids grids = aquarium.freshGrids();
        return perceive(aquarium.environment(grids), aquarium.speciesParameters[0], 0, {})
            .shelter.site;
    };
    EXPECT_FALSE(shelterAt(0.5).seen());
    EXPECT_EQ(shelterAt(0).object, 0U);
    aquarium.surroundings.sites[0].place.x += 5;
    EXPECT_FALSE(shelterAt(0).seen()) << "too far from its home";
}

}  // namespace
}  // namespace aquarama::behaviour
