// SPDX-License-Identifier: Apache-2.0
// What adaptation gives, as a property over seeds; how much it gives is in docs/adaptation.md.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "master/study/study.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::study {
namespace {

Scenario calmSchool() {
    Scenario scenario;
    scenario.name = "school";
    world::WorldSpecies school{.tables = world::capturedTables("bigeye_scad"), .fish = 51};
    school.name = "synthetic scad";
    school.habits.shares.schooling = 1;
    scenario.world.scene.plankton = 0;
    scenario.world.cast = {school};
    scenario.halfWidths = {0.06F};
    return scenario;
}

// Of one quantity, seed by seed: what seeds have in common falls out.
struct Difference {
    double mean = 0;
    double standardError = 0;  // of the mean
};

Difference differenceOf(const std::vector<Figures>& without,
                        const std::vector<Figures>& with,
                        Quantity quantity) {
    std::vector<double> values;
    for (std::size_t seed = 0; seed < with.size(); ++seed) {
        const auto of = [&](const Figures& run) {
            return run.at(static_cast<std::size_t>(quantity));
        };
        values.push_back(of(with[seed]) - of(without[seed]));
    }
    const auto count = static_cast<double>(values.size());
    Difference difference;
    for (const double value : values) difference.mean += value / count;
    double squares = 0;
    for (const double value : values) squares += std::pow(value - difference.mean, 2);
    difference.standardError = std::sqrt(squares / (count - 1) / count);
    return difference;
}

TEST(Adaptation, aSchoolBeatsLessInStepWithRecommendations) {
    const Scenario scenario = calmSchool();
    std::vector<Figures> with, without;
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        with.push_back(runOnce(scenario, {}, seed, 2));
        without.push_back(runOnce(scenario, {.recommendations = false}, seed, 2));
    }
    for (const Quantity quantity : {Quantity::SameSegment, Quantity::InStep}) {
        const Difference difference = differenceOf(without, with, quantity);
        // Student's t, two-sided 95 %, for six seeds.
        EXPECT_LT(difference.mean, -2.571 * difference.standardError) << keyOf(quantity);
    }
}

// The bits: a quantity that a run does not have is no number, and equals nothing.
std::vector<std::uint64_t> bitsOfAll(std::span<const Figures> runs) {
    std::vector<std::uint64_t> bits;
    for (const Figures& run : runs)
        for (const double value : run) bits.push_back(bitsOf(value));
    return bits;
}

TEST(Study, sharedAmongThreadsAndInPartsItFindsTheSame) {
    StudyPlan plan{.scenarios = {calmSchool()}, .minutes = 0.05, .seeds = 2};
    const std::size_t count = runsOf(plan);
    const auto one = runSome(plan, 0, count, [](double) {});
    plan.threads = 3;
    auto parts = runSome(plan, 0, 3, [](double) {});
    std::ranges::copy(runSome(plan, 3, count, [](double) {}), std::back_inserter(parts));
    EXPECT_EQ(bitsOfAll(one), bitsOfAll(parts));
    EXPECT_EQ(samplesOf(plan, one)[0].at(1)[1][0], one[3][0]) << "the second condition and seed";
}

TEST(Study, writesALineForEachRunAndNothingWhereARunHasNone) {
    const StudyPlan plan{.scenarios = {calmSchool()}, .minutes = 0.05, .seeds = 2};
    const std::string csv =
        runsCsv(plan, samplesOf(plan, runSome(plan, 0, runsOf(plan), [](double) {})));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * static_cast<int>(kConditions.size()));
    EXPECT_NE(csv.find("\nschool,no recommendations,2,"), std::string::npos);
    EXPECT_NE(csv.find(",half_pinch_seconds,"), std::string::npos);
    EXPECT_NE(csv.find(",,"), std::string::npos) << "nobody threw a pinch";
    EXPECT_EQ(csv.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace aquarama::study
