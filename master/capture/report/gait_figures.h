// SPDX-License-Identifier: Apache-2.0
// How well forward swimming is that of a fish: body wave, and speed against beat frequency.
#pragma once

#include <array>
#include <string>

#include "common/motion/repertoire.h"

namespace aquarama::report {

inline constexpr std::size_t kGaits = 3;  // the first three actions: slow, medium, fast

// speed = slope * beat + intercept, by least squares over the three gaits.
struct SpeedLine {
    double slope = 0;      // body lengths a beat
    double intercept = 0;  // body lengths a second
    double rSquared = 0;
};
[[nodiscard]] SpeedLine fitSpeed(const motion::Repertoire& repertoire);

// Speed against beat frequency with that line, and Bainbridge's (1958).
[[nodiscard]] std::string drawSpeed(const motion::Repertoire& repertoire);

// Strouhal number and stride against beat frequency, over the ranges of living fish (Taylor, Nudds
// & Thomas 2003; Videler & Wardle 1991).
[[nodiscard]] std::string drawStrouhalAndStride(const motion::Repertoire& repertoire);

// The midlines of one beat over each other, in a frame that swims along at the mean speed; how far
// each point of them swings, and a saithe's does (Videler & Hess 1984).
[[nodiscard]] std::string drawMidlines(const motion::Repertoire& repertoire, motion::Action gait);

}  // namespace aquarama::report
