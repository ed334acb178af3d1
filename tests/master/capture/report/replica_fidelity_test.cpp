// SPDX-License-Identifier: Apache-2.0
// The replicas of all species against the fish that they stand for.
#include <filesystem>

#include <gtest/gtest.h>

#include "common/base/units.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/report/fidelity.h"
#include "master/capture/report/segment_count.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

constexpr double kSeconds = 30;

class ReplicaFidelity : public testing::TestWithParam<std::filesystem::path> {};

// The goals are 1 % of a body length and 5 % of the path. The second is what the median command
// keeps to, give or take a script.
TEST_P(ReplicaFidelity, staysWithinTheBounds) {
    const config::Species species = config::readSpecies(GetParam().string());
    const motion::Repertoire repertoire = capture::captureRepertoire(species, [](double) {});
    const Summary summary =
        summarise(measureFidelity(species, repertoire, 1, kSeconds).comparison.commands);
    EXPECT_LE(summary.shapeWithin, 0.01);
    EXPECT_LE(summary.pathErrorMedian, 0.055);
    EXPECT_LE(summary.headingErrorRms, 6 * kRadiansPerDegree<double>);
}

INSTANTIATE_TEST_SUITE_P(OfAllSpecies,
                         ReplicaFidelity,
                         testing::ValuesIn(capture::speciesFiles(
                             {}, std::filesystem::path(AQUARAMA_SOURCE_DIR) / "config")),
                         [](const auto& tested) { return tested.param.stem().string(); });

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
