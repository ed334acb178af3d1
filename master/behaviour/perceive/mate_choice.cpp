// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/mate_choice.h"

#include <algorithm>

namespace aquarama::behaviour {

namespace {

constexpr float kTakenDearness = 1.5F;  // of one that courts another
constexpr float kDevotion = 3;          // of anybody else to one whose courtship is answered

}  // namespace

bool suitsAsMate(const fish::FishView& view,
                 std::uint8_t likes,
                 std::uint32_t fish,
                 std::uint32_t other) {
    if (other == fish || view.kind[other] != view.kind[fish]) return false;
    if (!view.shows(other, fish::kWilling) || view.shows(other, fish::kAway)) return false;
    if (view.shows(other, fish::kFemale) == ((likes & fish::kIsFemale) != 0)) return false;
    const auto [shorter, longer] = std::minmax(view.fish[fish].length, view.fish[other].length);
    return shorter >= kLeastSizeRatio * longer;
}

float dearnessOfMate(const fish::FishView& view,
                     std::uint8_t likes,
                     std::uint32_t fish,
                     std::uint32_t other) {
    const std::uint32_t own = view.partner[fish];
    const bool isCourted = own != fish::kNobody && view.partner[own] == fish;
    const std::uint32_t theirs = view.partner[other];
    float dearness = theirs != fish::kNobody && theirs != fish ? kTakenDearness : 1.0F;
    if (isCourted && own != other) dearness = kDevotion;
    if ((likes & fish::kIsFemale) == 0) return dearness;
    // Nothing may cost less than its distance: so the smaller are dearer.
    const float smaller = view.fish[fish].length / (kLeastSizeRatio * view.fish[other].length);
    return dearness * std::max(1.0F, smaller * smaller);
}

}  // namespace aquarama::behaviour
