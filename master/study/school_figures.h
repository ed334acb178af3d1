// SPDX-License-Identifier: Apache-2.0
// How a group of fish holds together, as biologists measure it, and how alike its members beat.
#pragma once

#include <cstddef>

#include "common/motion/motion_state.h"
#include "master/fish/fish_view.h"

namespace aquarama::study {

// Of fish [first, last) that are there.
struct SchoolFigures {
    double nearestNeighbour = 0;  // mean distance, body lengths of the fish itself
    double polarisation = 0;      // length of the mean heading (Tunstrom et al. 2013)
    double rotation = 0;          // of the mean angular momentum about the group's middle (same)
    double radiusMetres = 0;      // root mean square distance from the group's middle
};
[[nodiscard]] SchoolFigures schoolFigures(const fish::FishView& view,
                                          std::size_t first,
                                          std::size_t last);

// Two are in step if they play one segment within a sixteenth of a cycle of each other.
struct Synchrony {
    double resultant = 0;    // mean resultant length of the phases; of n at random sqrt(pi / 4n)
    double sameSegment = 0;  // share of pairs that play the same segment
    double inStep = 0;       // share of pairs
};
[[nodiscard]] Synchrony synchronyOf(const motion::MotionStates& states,
                                    std::size_t first,
                                    std::size_t last);

}  // namespace aquarama::study
