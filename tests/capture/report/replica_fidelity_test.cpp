// SPDX-License-Identifier: Apache-2.0
// The replicas of all species against the fish that they stand for.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture_repertoire.h"
#include "capture/report/fidelity.h"
#include "capture/report/segment_count.h"
#include "common/base/units.h"
#include "tests/support/all_species.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

constexpr double kSeconds = 30;
constexpr double kScriptSeconds = 15;

class ReplicaFidelity : public testing::TestWithParam<std::string> {};

// The commands of eight scripts, each of 15 s.
const std::vector<CommandErrors>& commandsOf(const std::string& name) {
    static std::map<std::string, std::vector<CommandErrors>> measured;
    std::vector<CommandErrors>& commands = measured[name];
    if (!commands.empty()) return commands;
    const config::Species species = test::castMember(name);
    const motion::Repertoire repertoire = capture::captureRepertoire(species, [](double) {});
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        std::ranges::copy(
            measureFidelity(species, repertoire, seed, kScriptSeconds).comparison.commands,
            std::back_inserter(commands));
    return commands;
}

// Of commands, the share whose path errs by at most so much at its end.
double shareWithin(const std::vector<CommandErrors>& commands, double error) {
    const auto within = std::ranges::count_if(
        commands, [&](const CommandErrors& one) { return one.pathErrorAtEnd <= error; });
    return static_cast<double>(within) / static_cast<double>(commands.size());
}

// The goals are 1 % of a body length and 5 % of the path.
TEST_P(ReplicaFidelity, staysWithinTheBounds) {
    const Summary summary = summarise(commandsOf(GetParam()));
    EXPECT_LE(summary.shapeWithin, 0.01);
    EXPECT_LE(summary.pathErrorMedian, 0.031);  // 3.01 % of the trumpetfish, less of all others
    EXPECT_LE(summary.headingErrorRms, 3 * kRadiansPerDegree<double>);
}

TEST(ReplicaFidelity, sixOfSevenCommandsOfAllSpeciesKeepWithinFivePercentOfTheirPath) {
    std::vector<CommandErrors> all;
    for (const std::string& name : test::allSpeciesNames())
        std::ranges::copy(commandsOf(name), std::back_inserter(all));
    EXPECT_GT(all.size(), 400U);
    EXPECT_GE(shareWithin(all, 0.05), 0.855);
    // One or two are beyond 12 %: what follows a retreat (docs/fidelity.md).
    EXPECT_GE(shareWithin(all, 0.12), 0.998);
    for (const CommandErrors& one : all)
        EXPECT_LE(one.pathErrorAtEnd, 0.13) << nameOf(one.command.manoeuvre);
}

INSTANTIATE_TEST_SUITE_P(OfAllSpecies,
                         ReplicaFidelity,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& tested) { return tested.param; });

TEST(ReplicaFidelity, ofAReplicaToItselfIsWithoutError) {
    const Script script = makeScript(test::scadRepertoire(), 2, kSeconds);
    const Trace trace = traceReplica(test::scadRepertoire(), script);
    const Comparison comparison = compare(script, {trace, trace, trace});
    for (const CommandErrors& errors : comparison.commands) {
        EXPECT_EQ(errors.shapeAsPlayed, 0);
        EXPECT_EQ(errors.pathErrorMost, 0);
        EXPECT_EQ(errors.headingError, 0);
    }
    EXPECT_EQ(comparison.openLoop.distanceMost, 0);
}

TEST(ReplicaFidelity, bringingAReplicaIntoPhaseWithItselfChangesNothing) {
    const Script script{{Manoeuvre::ForwardMedium, 60, 20}, {Manoeuvre::ForwardMedium, 60, 20}};
    const Trace alone = traceReplica(test::scadRepertoire(), script);
    const Trace inPhase = traceReplicaInPhase(test::scadRepertoire(), script, alone);
    const CommandErrors errors = compare(script, {alone, inPhase, inPhase}).commands.front();
    EXPECT_LT(errors.shapeAsPlayed, 1e-3);
    EXPECT_LT(errors.pathErrorMost, 2e-3);
}

// Without the curve in both, or with it in one of them, they would part by whole radians.
TEST(ReplicaFidelity, bothSwimATightCurve) {
    const double beat = 60 / test::scad().swim.medium.beatHertz;
    const Script script{{Manoeuvre::ForwardMedium, 90, beat}, {Manoeuvre::CurveLeft, 150, beat}};
    const CommandErrors errors =
        compare(script, traceBoth(test::scad(), test::scadRepertoire(), script)).commands.front();
    EXPECT_GT(errors.turn, 60 * kRadiansPerDegree<double>);
    EXPECT_LT(std::abs(errors.headingError), 10 * kRadiansPerDegree<double>);
}

// To either side of a bend: a fish that turned level would not agree with what was captured.
TEST(ReplicaFidelity, theFishRollsIntoItsTurns) {
    const double beat = 60 / test::scad().swim.medium.beatHertz;
    for (const auto& [manoeuvre, side] :
         {std::pair{Manoeuvre::TurnLeftSharp, 1}, std::pair{Manoeuvre::TurnRightSharp, -1}}) {
        ScriptCommand turn = briefest(test::scadRepertoire(), manoeuvre);
        const Trace fish =
            traceFish(test::scad(), Script{{Manoeuvre::ForwardMedium, 60, beat}, turn});
        double most = 0;  // height of its right side
        for (const TracePoint& point : fish)
            most = std::max(most, side * point.frame.worldFromBody[2].y);
        EXPECT_GT(most, std::sin(5 * kRadiansPerDegree<double>)) << nameOf(manoeuvre);
    }
}

// The fins of both stand as they row, and the tail beats where they do not.
TEST(ReplicaFidelity, bothRowWhereTheyHover) {
    const double beat = 60 / test::scad().swim.medium.beatHertz;
    const Script script{{Manoeuvre::ForwardMedium, 60, beat},
                        {Manoeuvre::Brake, 60, beat},
                        {Manoeuvre::Hover, 90, beat}};
    const auto strokeOf = [](const Trace& trace) {
        double least = 9, most = -9;
        for (std::size_t tick = trace.size() - 40; tick < trace.size(); ++tick) {
            const double stroke = static_cast<double>(trace[tick].drive.left.stroke);
            least = std::min(least, stroke);
            most = std::max(most, stroke);
        }
        return most - least;
    };
    const Traces traces = traceBoth(test::scad(), test::scadRepertoire(), script);
    EXPECT_GT(strokeOf(traces.fish), 0.2);
    EXPECT_NEAR(strokeOf(traces.replica), strokeOf(traces.fish), 0.05);
    EXPECT_EQ(traces.fish.at(60).drive.spread, 0);
    EXPECT_EQ(traces.fish.at(120).drive.spread, 1) << "braked";
    EXPECT_NEAR(static_cast<double>(traces.replica.at(120).drive.spread), 1, 1e-6);
}

TEST(Vocabulary, ofSevenSegmentsTurnsMuchBetterThanOfFewer) {
    const std::vector<VocabularyErrors> all =
        compareVocabularies(test::scad(), test::scadRepertoire(), 1, 20);
    const VocabularyErrors& one = all.at(0);
    const VocabularyErrors& five = all.at(2);
    const VocabularyErrors& seven = all.at(3);
    EXPECT_EQ(seven.segments, std::size_t{motion::kForwardGaits + 4});
    EXPECT_LT(seven.turnHeadingError, 0.6 * one.turnHeadingError);
    EXPECT_LT(seven.turnHeadingError, 0.9 * five.turnHeadingError);
    EXPECT_LT(seven.shapeWithin, one.shapeWithin);
}

}  // namespace
}  // namespace aquarama::report
