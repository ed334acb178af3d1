// SPDX-License-Identifier: Apache-2.0
// How hard a species must bend to turn as far as a turn is to go.
#pragma once

#include "common/config/species.h"

namespace aquarama::search {

// Well inside what a gradual turn (20 to 40 degrees) and a sharp one (40 to 80) may be, whatever
// the point of the beat where it begins.
inline constexpr double kGradualDegrees = 30;
inline constexpr double kSharpDegrees = 58;

// Strengths with which left turns out of medium swimming go as far as that on the average over the
// beat, or as near as the fish can; at the tempos that the species has. Throws Error when it does
// not become straight after them.
[[nodiscard]] config::Turn withFittingStrengths(const config::Species& species);

}  // namespace aquarama::search
