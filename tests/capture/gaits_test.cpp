// SPDX-License-Identifier: Apache-2.0
// Every species swims and turns as living fish do.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "capture/gait_trial.h"
#include "capture/turn.h"
#include "common/base/units.h"
#include "tests/support/all_species.h"

namespace aquarama::capture {
namespace {

constexpr std::size_t kTail = kWaveStations - 1;
const std::set<std::string> kLabriform{"blue_tang",
                                       "butterflyfish",
                                       "cleaner_wrasse",
                                       "clownfish",
                                       "coral_grouper",
                                       "green_chromis",
                                       "moorish_idol",
                                       "parrotfish",
                                       "powder_blue_tang",
                                       "sea_goldie",
                                       "sergeant"};

// Swum once for all tests.
const GaitFigures& figuresOf(const config::Species& species, const config::Gait& gait) {
    static std::map<std::tuple<std::string, double, double>, GaitFigures> swum;
    const auto key = std::tuple{species.name, gait.beatHertz, gait.gain};
    auto found = swum.find(key);
    if (found == swum.end()) found = swum.emplace(key, steadyFigures(species, gait)).first;
    return found->second;
}

class Gaits : public testing::TestWithParam<std::string> {
  protected:
    config::Species species_ = test::castMember(GetParam());
    std::array<config::Gait, 3> gaits_{
        species_.swim.slow, species_.swim.medium, species_.swim.fast};
};

INSTANTIATE_TEST_SUITE_P(Species,
                         Gaits,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& species) { return species.param; });

// Taylor, Nudds & Thomas 2003; Videler & Wardle 1991; Bainbridge 1958. A gait that is rowed has no
// tail beat.
TEST_P(Gaits, haveStrouhalNumberStrideAndAmplitudeOfFish) {
    for (const config::Gait& gait : gaits_) {
        if (gait.rows > 0) continue;
        const GaitFigures& figures = figuresOf(species_, gait);
        EXPECT_GT(figures.swum.strouhal, 0.22) << gait.beatHertz;
        EXPECT_LT(figures.swum.strouhal, 0.38) << gait.beatHertz;
        EXPECT_GT(figures.swum.strideBodyLengths, 0.5) << gait.beatHertz;
        EXPECT_LT(figures.swum.strideBodyLengths, 0.7) << gait.beatHertz;
        EXPECT_GT(figures.swum.tailAmplitude, 0.14) << gait.beatHertz;
        EXPECT_LT(figures.swum.tailAmplitude, 0.24) << gait.beatHertz;
        EXPECT_LT(figures.swum.noseAmplitude, 0.06) << gait.beatHertz;
    }
}

// Videler & Hess 1984: about one wave on the body, swinging further the nearer to the tail.
TEST_P(Gaits, sendOneGrowingWaveDownTheBody) {
    for (const config::Gait& gait : gaits_) {
        if (gait.rows > 0) continue;
        const BodyWave& wave = figuresOf(species_, gait).wave;
        EXPECT_GT(wave.leastPhaseFall(), 10 * kDegree) << gait.beatHertz;
        EXPECT_GT(wave.wavelength, 0.75) << gait.beatHertz;
        EXPECT_LT(wave.wavelength, 1.4) << gait.beatHertz;
        for (std::size_t i = 3; i < kTail; ++i)
            EXPECT_LT(wave.amplitudes.at(i), wave.amplitudes.at(i + 1)) << gait.beatHertz;
    }
}

// Labriform swimming at low speed (Walker & Westneat 1997): the pectoral fins drive a body that
// holds still. A fish that does not row at its slow gait beats its tail there.
TEST_P(Gaits, holdTheBodyStillWhereTheyAreRowed) {
    EXPECT_EQ(gaits_[0].rows > 0, kLabriform.contains(GetParam()));
    for (const config::Gait& gait : gaits_) {
        if (gait.rows == 0) continue;
        const SegmentMeasures& swum = figuresOf(species_, gait).swum;
        EXPECT_LT(swum.tailAmplitude, 1e-6);
        EXPECT_GT(swum.speedBodyLengths, 0.3);
        EXPECT_LT(swum.speedBodyLengths,
                  0.6 * figuresOf(species_, gaits_[1]).swum.speedBodyLengths);
    }
}

// Bainbridge 1958: speed goes with the beat. In between, gain goes with frequency in straight
// lines.
TEST_P(Gaits, speedRisesLinearlyWithTheBeat) {
    std::vector<config::Gait> gaits;
    for (const auto& [from, to] : {std::pair{gaits_[0], gaits_[1]}, {gaits_[1], gaits_[2]}}) {
        if (from.rows > 0) continue;
        for (const double share : {0.0, 0.5})
            gaits.push_back({.beatHertz = std::lerp(from.beatHertz, to.beatHertz, share),
                             .gain = std::lerp(from.gain, to.gain, share)});
    }
    gaits.push_back(gaits_[2]);

    const auto count = static_cast<double>(gaits.size());
    std::vector<double> speeds;
    double meanBeat = 0;
    double meanSpeed = 0;
    for (const config::Gait& gait : gaits) {
        speeds.push_back(figuresOf(species_, gait).swum.speedBodyLengths);
        meanBeat += gait.beatHertz / count;
        meanSpeed += speeds.back() / count;
    }
    EXPECT_TRUE(std::ranges::is_sorted(speeds, std::ranges::less_equal{}));
    double ff = 0, fu = 0, uu = 0;
    for (std::size_t i = 0; i < gaits.size(); ++i) {
        const double f = gaits[i].beatHertz - meanBeat;
        const double u = speeds[i] - meanSpeed;
        ff += f * f;
        fu += f * u;
        uu += u * u;
    }
    EXPECT_GT(fu * fu / (ff * uu), 0.95) << "R squared";
}

// Thrust and resistance both grow with the coefficient of drag, so that it is known badly and
// matters little. Prints a row of the table in docs/species.md.
TEST_P(Gaits, changeTheirStrideByAThirdOfAChangeOfDragAtMost) {
    const config::Gait& medium = gaits_[1];
    const SegmentMeasures fitted = figuresOf(species_, medium).swum;
    std::printf(
        "| %s | %.0f | %.3f |", GetParam().c_str(), species_.water.drag, fitted.strideBodyLengths);
    for (const double factor : {0.8, 1.2}) {
        config::Species changed = species_;
        changed.water.drag *= factor;
        const SegmentMeasures swum = steadyFigures(changed, medium).swum;
        const double stride = swum.strideBodyLengths / fitted.strideBodyLengths - 1;
        const double tail = swum.tailAmplitude / fitted.tailAmplitude - 1;
        std::printf(" %+.1f %% | %+.1f %% |", 100 * stride, 100 * tail);
        EXPECT_LT(std::abs(stride), std::abs(factor - 1) / 3);
    }
    std::printf("\n");
}

TEST_P(Gaits, takeAnEvenNumberOfTicks) {
    for (const config::Gait& gait : gaits_) {
        const double ticks = kTicksPerSecond / gait.beatHertz;
        EXPECT_NEAR(ticks / 2, std::round(ticks / 2), 1e-3) << gait.beatHertz;
    }
}

TEST_P(Gaits, turnAsFarAsAskedFromAnyPointOfTheBeat) {
    const SteadySwimming entry = swimUntilSteady(species_, species_.swim.medium);
    for (int onset = 0; onset < motion::kPhases; onset += motion::kPhases / 4) {
        const auto degrees = [&](const config::Bend& bend) {
            return turnRadians(recordTurn(species_, entry, Controller::LeftTurn, bend, onset)) /
                   kDegree;
        };
        EXPECT_GT(degrees(species_.turn.gradual), 22) << onset;
        EXPECT_LT(degrees(species_.turn.gradual), 38) << onset;
        EXPECT_GT(degrees(species_.turn.sharp), 45) << onset;
        EXPECT_LT(degrees(species_.turn.sharp), 78) << onset;
    }
}

}  // namespace
}  // namespace aquarama::capture
