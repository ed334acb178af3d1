// SPDX-License-Identifier: Apache-2.0

#include "master/capture/gait_trial.h"

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

#include "master/capture/compile_segment.h"
#include "master/capture/motor_controllers.h"
#include "master/capture/speed_response.h"
#include "master/capture/turn.h"

namespace aquarama::capture {

namespace {

constexpr int kHalvings = 8;

double meanDegrees(const config::Species& species,
                   const SteadySwimming& entry,
                   const config::Bend& bend) {
    double sum = 0;
    for (int i = 0; i < kOnsets; ++i)
        sum += turnRadians(
            recordTurn(species, entry, Controller::LeftTurn, bend, i * motion::kPhases / kOnsets));
    return sum / kOnsets * 180 / std::numbers::pi;
}

// The harder the bend the further the turn, so halving finds it.
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

// Speed takes dozens of beats to settle, the wave only a few.
constexpr double kFlyingStart = 0.62;  // body lengths a beat, as most fish go
constexpr int kWarmUpBeats = 12;

GaitFigures figuresOf(const config::Gait& gait, const RecordedCycle& beat) {
    const motion::ActionSegment segment = compileForward(beat);
    return {gait.beatHertz, measure(segment), bodyWave(segment)};
}

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
                 {.muscles = swim(species, gait, stepSeconds * static_cast<double>(done++)),
                  .fins = {}},
                 stepSeconds,
                 state);
    };
    advance(kWarmUpBeats * motion::kPhases * steps);
    RecordedCycle beat{.periodSeconds = period, .poses = {state.positions}};
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

struct Band {
    double least, most;
    double tolerance;  // outside by this much counts 1
};
constexpr double kAny = std::numeric_limits<double>::infinity();

// Swimming animals keep a Strouhal number of 0.2 to 0.4, efficient ones of 0.25 to 0.35 (Taylor,
// Nudds & Thomas 2003; Triantafyllou et al. 1993).
constexpr Band kStrouhal{0.24, 0.35, 0.02};
// Fish go 0.5 to 0.7 of their length in a beat (Videler & Wardle 1991), ...
constexpr Band kStride{0.53, 0.67, 0.02};
// ... the same at any speed, so that speed goes with the beat.
constexpr Band kStrideSpread{0, 0.06, 0.02};
// The tail swings through 0.2 of the length (Bainbridge 1958), in slow swimming through less.
constexpr Band kTail{0.15, 0.22, 0.01};
// The nose swings through 0.01 to 0.04 of it (Jayne & Lauder 1995; Videler & Hess 1984); a body of
// three muscle segments recoils a little more.
constexpr Band kNose{0, 0.05, 0.008};
// A carangiform body carries about one wave (Videler & Hess 1984), ...
constexpr Band kWavelength{0.85, 1.3, 0.1};
// ... which travels tailwards all the way ...
constexpr Band kPhaseFall{0.2, kAny, 0.1};
// ... and grows towards the tail.
constexpr Band kGrowth{1.05, kAny, 0.05};

double squaredMiss(double value, const Band& band) {
    const double miss = std::max({0.0, band.least - value, value - band.most}) / band.tolerance;
    return miss * miss;
}

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

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::array kGaits{"slow", "medium", "fast"};

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
    for (std::size_t i = 0; i < kGaits.size(); ++i) {
        const GaitFigures g = steadyFigures(species, gaits.at(i));
        rows << "| " << (i == 0 ? plainName(species) : "") << " | " << kGaits.at(i) << " | "
             << g.beatHertz << " | " << gaits.at(i).gain << " | " << g.swum.speedBodyLengths
             << " | " << g.swum.strideBodyLengths << " | " << std::setprecision(3)
             << g.swum.tailAmplitude << std::setprecision(2) << " | " << g.swum.strouhal << " | "
             << g.wave.wavelength << " | " << std::setprecision(3) << g.swum.noseAmplitude
             << std::setprecision(2) << " |\n";
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
                row << ' ' << spread.least() * kDegrees << "–" << spread.most() * kDegrees << " |";
    return row.str() + '\n';
}

}  // namespace aquarama::capture
