// SPDX-License-Identifier: Apache-2.0
#include "capture/gait_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <future>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include "capture/compile_segment.h"
#include "capture/motor_controllers.h"
#include "capture/speed_response.h"
#include "capture/turn.h"
#include "common/base/units.h"

namespace aquarama::capture {

namespace {

// Strengths of bends.

constexpr int kHalvings = 8;  // the strength to 1/256

// The mean angle of left turns begun at kOnsets phases of the beat.
double meanDegrees(const config::Species& species,
                   const SteadySwimming& entry,
                   const config::Bend& bend) {
    double sum = 0;
    for (int i = 0; i < kOnsets; ++i)
        sum += turnRadians(
            recordTurn(species, entry, Controller::LeftTurn, bend, i * motion::kPhases / kOnsets));
    return sum / kOnsets * 180 / std::numbers::pi;
}

// The angle grows with the strength, so bisection over 0 to 1 finds the strength.
config::Bend fitting(const config::Species& species,
                     const SteadySwimming& entry,
                     config::Bend bend,
                     double degrees) {
    double weak = 0;
    double strong = 1;
    for (int i = 0; i < kHalvings; ++i) {
        bend.strength = (weak + strong) / 2;
        (meanDegrees(species, entry, bend) < degrees ? weak : strong) = bend.strength;
    }
    return bend;
}

}  // namespace

config::Turn withFittingStrengths(const config::Species& species) {
    const SteadySwimming entry = swimUntilSteady(species, species.swim.medium);
    return {.gradual = fitting(species, entry, species.turn.gradual, kGradualDegrees),
            .sharp = fitting(species, entry, species.turn.sharp, kSharpDegrees)};
}

namespace {

// Figures. From rest the speed takes dozens of beats to settle, the body wave only a few. So the
// quick trial starts near the final speed and waits only for the wave.
constexpr double kFlyingStart = 0.62;  // body lengths a beat, near the stride of most fish
constexpr int kWarmUpBeats = 12;

GaitFigures figuresOf(const config::Gait& gait, const RecordedCycle& beat) {
    const motion::ActionSegment segment = compileForward(beat);
    return {gait.beatHertz, measure(segment), bodyWave(segment)};
}

// One beat after the warm-up. It need not repeat exactly: compileForward() closes it.
RecordedCycle quickBeat(const config::Species& species, const config::Gait& gait) {
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const double period = 1 / gait.beatHertz;
    const int steps =
        static_cast<int>(std::ceil(period / motion::kPhases / longestStepSeconds(fish) - 1e-9));
    const double stepSeconds = period / (motion::kPhases * steps);
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity.x = kFlyingStart * gait.beatHertz;
    std::int64_t done = 0;
    const auto advance = [&](int count) {
        for (int i = 0; i < count; ++i)
            step(fish,
                 {.muscles = swim(species, gait, stepSeconds * (static_cast<double>(done++) + 0.5)),
                  .fins = {},
                  .rowing = {},
                  .tone = {}},
                 stepSeconds,
                 state);
    };
    advance(kWarmUpBeats * motion::kPhases * steps);
    RecordedCycle beat{.periodSeconds = period, .poses = {state.positions}, .fins = {}};
    for (int phase = 0; phase < motion::kPhases; ++phase) {
        advance(steps);
        beat.poses.push_back(state.positions);
    }
    return beat;
}

}  // namespace

GaitFigures steadyFigures(const config::Species& species, const config::Gait& gait) {
    return figuresOf(gait, swimUntilSteady(species, gait).beat);
}

ForwardFigures quickFigures(const config::Species& species) {
    const auto start = [&](const config::Gait& gait) {
        return std::async(std::launch::async,
                          [&species, &gait] { return figuresOf(gait, quickBeat(species, gait)); });
    };
    auto slow = start(species.swim.slow);
    auto medium = start(species.swim.medium);
    auto fast = start(species.swim.fast);
    return {slow.get(), medium.get(), fast.get()};
}

namespace {

// The objective of the search.

// The range of a figure in living fish.
struct Band {
    double least, most;
    double tolerance;  // a value outside of the range by this much counts 1
};
constexpr double kAny = std::numeric_limits<double>::infinity();

// Swimming animals keep a Strouhal number of 0.2 to 0.4, efficient ones of 0.25 to 0.35 (Taylor,
// Nudds & Thomas 2003; Triantafyllou et al. 1993).
constexpr Band kStrouhal{0.24, 0.35, 0.02};
// Stride: fish travel 0.5 to 0.7 body lengths in a beat (Videler & Wardle 1991).
constexpr Band kStride{0.53, 0.67, 0.02};
// Greatest less least stride of the three gaits, body lengths: the stride is nearly the same at any
// speed, so that speed is proportional to the beat frequency.
constexpr Band kStrideSpread{0, 0.06, 0.02};
// Tail, peak to peak: 0.2 body lengths (Bainbridge 1958), less in slow swimming.
constexpr Band kTail{0.15, 0.22, 0.01};
// Nose, peak to peak: 0.01 to 0.04 body lengths (Jayne & Lauder 1995; Videler & Hess 1984). A body
// with three muscle segments recoils a little more.
constexpr Band kNose{0, 0.05, 0.008};
// Length of the body wave: about one body length in carangiform fish (Videler & Hess 1984).
constexpr Band kWavelength{0.85, 1.3, 0.1};
// Fall of the phase from station to station, radians: the wave travels towards the tail everywhere.
constexpr Band kPhaseFall{0.2, kAny, 0.1};
// Ratio of the amplitudes of neighbouring stations near the tail: the wave grows towards the tail.
constexpr Band kGrowth{1.05, kAny, 0.05};

double squaredMiss(double value, const Band& band) {
    const double miss = std::max({0.0, band.least - value, value - band.most}) / band.tolerance;
    return miss * miss;
}

// The sum over the figures of one gait. Stations 4, 5 and 6 are rings 4 and 5 and the tail tips.
double missOf(const GaitFigures& gait) {
    const auto& swing = gait.wave.amplitudes;
    return squaredMiss(gait.swum.strouhal, kStrouhal) +
           squaredMiss(gait.swum.strideBodyLengths, kStride) +
           squaredMiss(gait.swum.tailAmplitude, kTail) +
           squaredMiss(gait.swum.noseAmplitude, kNose) +
           squaredMiss(gait.wave.wavelength, kWavelength) +
           squaredMiss(gait.wave.leastPhaseFall(), kPhaseFall) +
           squaredMiss(swing[5] / swing[4], kGrowth) + squaredMiss(swing[6] / swing[5], kGrowth);
}

}  // namespace

double missOf(const ForwardFigures& gaits) {
    const auto strideOf = [](const GaitFigures& gait) { return gait.swum.strideBodyLengths; };
    const auto [least, most] = std::ranges::minmax(gaits, {}, strideOf);
    double sum = squaredMiss(strideOf(most) - strideOf(least), kStrideSpread);
    for (const GaitFigures& gait : gaits) sum += missOf(gait);
    return sum;
}

namespace {

// Tables.

constexpr std::array kGaitNames{"slow", "medium", "fast"};

std::string plainName(const config::Species& species) {
    std::string name = species.name;
    std::ranges::replace(name, '_', ' ');
    return name;
}

}  // namespace

std::string gaitTableHead() {
    return "| species | gait | beat, Hz | gain | speed, L/s | stride, L | tail, L | Strouhal | "
           "wavelength, "
           "L | nose, L |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string gaitTableRows(const config::Species& species) {
    const std::array gaits{species.swim.slow, species.swim.medium, species.swim.fast};
    std::ostringstream rows;
    rows << std::fixed << std::setprecision(2);
    for (std::size_t i = 0; i < kGaitNames.size(); ++i) {
        const GaitFigures g = steadyFigures(species, gaits.at(i));
        rows << "| " << (i == 0 ? plainName(species) : "") << " | " << kGaitNames.at(i) << " | "
             << g.beatHertz << " | " << gaits.at(i).gain << " | " << g.swum.speedBodyLengths
             << " | " << g.swum.strideBodyLengths << " | ";
        if (gaits.at(i).rows > 0) {
            rows << "rows | – | – | – |\n";
            continue;
        }
        rows << std::setprecision(3) << g.swum.tailAmplitude << std::setprecision(2) << " | "
             << g.swum.strouhal << " | " << g.wave.wavelength << " | " << std::setprecision(3)
             << g.swum.noseAmplitude << std::setprecision(2) << " |\n";
    }
    return rows.str();
}

std::string turnTableHead() {
    return "| species | gradual, from slow | from medium | from fast | sharp, from slow | from "
           "medium | "
           "from fast |\n|---|---|---|---|---|---|---|\n";
}

std::string turnTableRow(const config::Species& species) {
    std::ostringstream row;
    row << std::fixed << std::setprecision(0) << "| " << plainName(species) << " |";
    const std::vector<TurnSpread> spreads = surveyTurns(species);
    for (const motion::Action turn :
         {motion::Action::TurnLeftGradual, motion::Action::TurnLeftSharp})
        for (const TurnSpread& spread : spreads)
            if (spread.turn == turn)
                row << ' ' << degreesOf(spread.least()) << "–" << degreesOf(spread.most()) << " |";
    return row.str() + '\n';
}

}  // namespace aquarama::capture
