// SPDX-License-Identifier: Apache-2.0
#include "common/body/sections.h"

#include <algorithm>
#include <cmath>

namespace aquarama::body {

float Section::widthAt(float share) const {
    const float fullness = share < 0 ? fullnessDown : fullnessUp;
    const float rest = 1 - std::pow(std::min(std::abs(share), 1.0F), fullness);
    return halfWidth * std::pow(rest, 1 / fullness);
}

Sections::Sections(const config::BodyProfile& profile)
    : dorsal_(profile.stations, profile.dorsal),
      ventral_(profile.stations, profile.ventral),
      halfWidth_(profile.stations, profile.halfWidth),
      fullnessUp_(profile.stations, profile.fullnessUp),
      fullnessDown_(profile.stations, profile.fullnessDown) {}

Section Sections::at(float s) const {
    return {
        dorsal_.at(s), ventral_.at(s), halfWidth_.at(s), fullnessUp_.at(s), fullnessDown_.at(s)};
}

}  // namespace aquarama::body
