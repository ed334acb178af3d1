// SPDX-License-Identifier: Apache-2.0
// What adaptation gives, as a property over seeds; how much it gives is in docs/adaptation.md.
#include <cmath>

#include <gtest/gtest.h>

#include "master/study/statistics.h"
#include "master/study/study.h"
#include "tests/master/world/school_of_synthetic_fish.h"

namespace aquarama::study {
namespace {

Scenario calmSchool() {
    Scenario scenario;
    scenario.name = "school";
    world::WorldSpecies school{.tables = world::syntheticTables(), .fish = 51};
    school.name = "synthetic scad";
    school.habits.shares.schooling = 1;
    scenario.world.scene.plankton = 0;
    scenario.world.cast = {school};
    scenario.halfWidths = {0.06F};
    return scenario;
}

TEST(Adaptation, aSchoolBeatsLessInStepWithRecommendations) {
    const Scenario scenario = calmSchool();
    std::vector<Figures> with, without;
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        with.push_back(runOnce(scenario, {}, seed, 2));
        without.push_back(runOnce(scenario, {.recommendations = false}, seed, 2));
    }
    for (const Quantity quantity : {Quantity::SameSegment, Quantity::InStep}) {
        const Estimate difference = differenceOf(without, with, quantity);
        EXPECT_LT(difference.mean, 0) << infoOf(quantity).words;
        EXPECT_TRUE(isClear(difference)) << infoOf(quantity).words << ": " << difference.mean
                                         << " +- " << difference.standardError;
    }
}

TEST(Statistics, differencesAreTakenSeedBySeed) {
    std::vector<Figures> without(3), with(3);
    for (std::size_t seed = 0; seed < 3; ++seed) {
        without[seed].fill(static_cast<double>(seed) * 100);
        with[seed].fill(static_cast<double>(seed) * 100 - 1 - 0.1 * static_cast<double>(seed));
    }
    const Estimate difference = differenceOf(without, with, Quantity::Touches);
    EXPECT_NEAR(difference.mean, -1.1, 1e-9);
    EXPECT_NEAR(difference.standardError, 0.1 / std::sqrt(3.0), 1e-9);
    EXPECT_TRUE(isClear(difference));
}

TEST(Study, sharedAmongThreadsItFindsTheSame) {
    StudyPlan plan{.scenarios = {calmSchool()}, .minutes = 0.05, .seeds = 2};
    const auto one = runStudy(plan, [](double) {});
    plan.threads = 3;
    const auto three = runStudy(plan, [](double) {});
    for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
        for (std::size_t seed = 0; seed < 2; ++seed)
            EXPECT_EQ(one[0].at(condition)[seed][0], three[0].at(condition)[seed][0]);
}

}  // namespace
}  // namespace aquarama::study
