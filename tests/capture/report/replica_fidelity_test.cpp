// SPDX-License-Identifier: Apache-2.0
// The replicas of all species against the fish that they stand for.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture_repertoire.h"
#include "capture/report/fidelity.h"
#include "capture/report/segment_count.h"
#include "common/base/units.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

constexpr double kSeconds = 30;

class ReplicaFidelity : public testing::TestWithParam<std::filesystem::path> {};

// The commands of eight scripts, each of 15 s; with AQUARAMA_SOAK in the environment of 60.
const std::vector<CommandErrors>& commandsOf(const std::filesystem::path& file) {
    static std::map<std::filesystem::path, std::vector<CommandErrors>> measured;
    std::vector<CommandErrors>& commands = measured[file];
    if (!commands.empty()) return commands;
    const double seconds = std::getenv("AQUARAMA_SOAK") == nullptr ? 15 : 60;
    const config::Species species = config::readSpecies(file.string());
    const motion::Repertoire repertoire = capture::captureRepertoire(species, [](double) {});
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        std::ranges::copy(measureFidelity(species, repertoire, seed, seconds).comparison.commands,
                          std::back_inserter(commands));
    return commands;
}

const std::vector<std::filesystem::path>& allFiles() {
    static const std::vector<std::filesystem::path> files =
        capture::speciesFiles({}, std::filesystem::path(AQUARAMA_SOURCE_DIR) / "config");
    return files;
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
    EXPECT_LE(summary.pathErrorMedian, 0.03);
    EXPECT_LE(summary.headingErrorRms, 3 * kRadiansPerDegree<double>);
}

TEST(ReplicaFidelity, nineOfTenCommandsOfAllSpeciesKeepWithinFivePercentOfTheirPath) {
    std::vector<CommandErrors> all;
    for (const std::filesystem::path& file : allFiles())
        std::ranges::copy(commandsOf(file), std::back_inserter(all));
    EXPECT_GT(all.size(), 400U);
    EXPECT_GE(shareWithin(all, 0.05), 0.9);
    // Scripts of a minute have one or two commands beyond 12 % (docs/fidelity.md).
    const bool isSoak = std::getenv("AQUARAMA_SOAK") != nullptr;
    EXPECT_GE(shareWithin(all, 0.12), isSoak ? 0.998 : 1);
    const double most = isSoak ? 0.13 : 0.12;
    for (const CommandErrors& one : all)
        EXPECT_LE(one.pathErrorAtEnd, most) << nameOf(one.command.manoeuvre);
}

INSTANTIATE_TEST_SUITE_P(OfAllSpecies,
                         ReplicaFidelity,
                         testing::ValuesIn(allFiles()),
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
