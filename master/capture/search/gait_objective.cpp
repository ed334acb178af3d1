// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/gait_objective.h"

#include <algorithm>
#include <limits>

namespace aquarama::search {

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

}  // namespace aquarama::search
