// SPDX-License-Identifier: Apache-2.0
// A beat is a cycle of the fish's motion, not only of its drive.
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "capture/dynamics.h"
#include "capture/speed_response.h"
#include "tests/capture/all_species.h"

namespace aquarama::capture {
namespace {

using Steady = EachSpecies;
INSTANTIATE_TEST_SUITE_P(Of,
                         Steady,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         nameOfSpecies);

std::array<config::Gait, 3> gaitsOf(const config::Species& species) {
    return {species.swim.slow, species.swim.medium, species.swim.fast};
}

double meanDistance(const NodeVectors& a, const NodeVectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::distance(a.at(i), b.at(i));
    return sum / body::kNodalPoints;
}

// The period of a motion, in samples, from nothing but its poses: the lag, up to a third of what
// was recorded, at which they are most like themselves.
std::size_t periodOf(const std::vector<NodeVectors>& poses) {
    std::size_t best = 0;
    double least = 0;
    const std::size_t mostLag = poses.size() / 3;
    for (std::size_t lag = 4; lag <= mostLag; ++lag) {
        double sum = 0;
        for (std::size_t i = 0; i + mostLag < poses.size(); ++i)
            sum += meanDistance(poses[i], poses[i + lag]);
        if (best == 0 || sum < least) {
            best = lag;
            least = sum;
        }
    }
    return best;
}

TEST_P(Steady, theMotionsOwnPeriodIsThatOfTheDrive) {
    for (const config::Gait& gait : gaitsOf(species())) {
        SteadySwimming steady = swimUntilSteady(species(), gait);
        std::vector<NodeVectors> poses;
        for (int sample = 0; sample < 5 * motion::kPhases; ++sample) {
            poses.push_back(inBodyFrame(steady.swimmer.state().positions));
            steady.swimmer.advance(steady.stepsPerPhase);
        }
        EXPECT_EQ(periodOf(poses), std::size_t{motion::kPhases}) << gait.beatHertz << " Hz";
        EXPECT_NEAR(steady.swimmer.stepSeconds() * steady.stepsPerPhase * motion::kPhases,
                    1 / gait.beatHertz,
                    1e-12);
    }
}

TEST_P(Steady, theRecordedBeatIsRepeatedTenBeatsLater) {
    SteadySwimming steady = swimUntilSteady(species(), species().swim.medium);
    steady.swimmer.advance(9 * motion::kPhases * steady.stepsPerPhase);
    RecordedCycle later{.poses = {steady.swimmer.state().positions}, .fins = {}};
    for (int phase = 0; phase < motion::kPhases; ++phase) {
        steady.swimmer.advance(steady.stepsPerPhase);
        later.poses.push_back(steady.swimmer.state().positions);
    }
    EXPECT_LT(differenceOf(steady.beat, later), 10 * kRepeatsBodyLengths);
}

TEST(SteadySwimming, aGaitThatNeverRepeatsIsRefusedBySpeciesAndGait) {
    config::Species wild = allSpecies().front();
    wild.name = "wild_fish";
    wild.swim.medium = {.beatHertz = 0.37, .gain = std::nan("")};
    try {
        static_cast<void>(swimUntilSteady(wild, wild.swim.medium));
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("wild_fish: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("0.37 beats a second"));
    }
}

}  // namespace
}  // namespace aquarama::capture
