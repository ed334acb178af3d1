// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/mate_choice.h"

#include <algorithm>

namespace aquarama {

namespace {

constexpr float kTakenDearness = 1.5F;  // of one that courts another

}  // namespace

bool suitsAsMate(const FishView& view,
                 std::uint8_t likes,
                 std::uint32_t fish,
                 std::uint32_t other) {
    if (other == fish || view.kind[other] != view.kind[fish]) return false;
    if (!view.shows(other, kWilling) || view.shows(other, kAway)) return false;
    if (view.shows(other, kFemale) == ((likes & kIsFemale) != 0)) return false;
    const auto [shorter, longer] = std::minmax(view.length[fish], view.length[other]);
    return shorter >= kLeastSizeRatio * longer;
}

float dearnessOfMate(const FishView& view,
                     std::uint8_t likes,
                     std::uint32_t fish,
                     std::uint32_t other) {
    const std::uint32_t courted = view.partner[other];
    const bool isTaken = courted != kNobody && courted != fish;
    const float dearness = isTaken ? kTakenDearness : 1.0F;
    if ((likes & kIsFemale) == 0) return dearness;
    // What is dearer than its distance is fine for the search; nothing may be cheaper. So she
    // counts all as farther, the largest and him who courts her least.
    const float smaller = view.length[fish] / (kLeastSizeRatio * view.length[other]);
    return std::max(1.0F, smaller * smaller) * (courted == fish ? 1.0F : kTakenDearness);
}

}  // namespace aquarama
