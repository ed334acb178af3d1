// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/correct.h"

#include <cmath>

#include "calibration/geometry/smooth_fit.h"

namespace aquarama::geometry {

namespace {

constexpr int kCellsAcross = 20;
constexpr double kPlacePixels = 0.05;  // of a tie
// Standard deviations of the bend between controls and of the whole correction, in pixels.
constexpr Smoothness kSmoothness{.bend = 0.15, .size = 3};

// The difference between the model and the measured places at the ties of a channel.
std::vector<Measured> restsOf(const SolvedHall& hall,
                              const std::vector<Tie>& ties,
                              std::size_t channel) {
    const glm::dvec2 size(hall.rig.channels[channel].sizePixels);
    std::vector<Measured> rests;
    for (const Tie& tie : ties) {
        if (tie.heldOut || tie.channel != channel) continue;
        if (const auto place = hall.modelled(tie))
            rests.push_back(
                {tie.place / size, tie.place - *place, 1 / std::hypot(tie.sigma, kPlacePixels)});
    }
    return rests;
}

}  // namespace

void correct(SolvedHall& hall, const std::vector<Tie>& ties) {
    constexpr int kRounds = 3;
    for (std::size_t channel = 0; channel < hall.projectors.size(); ++channel) {
        const glm::dvec2 size(hall.rig.channels[channel].sizePixels);
        const glm::ivec2 cells(kCellsAcross, static_cast<int>(kCellsAcross * size.y / size.x));
        hall.corrections[channel] =
            smoothFit(restsOf(hall, ties, channel), cells, kSmoothness, 4 * kPlacePixels, kRounds);
    }
}

}  // namespace aquarama::geometry
