// SPDX-License-Identifier: Apache-2.0
// Which tier of quality a node keeps up with.
#pragma once

#include <functional>

#include "common/config/rig.h"

namespace aquarama::show {

// Seconds that a frame takes at a tier, fish apart.
using FrameCost = std::function<double(config::QualityTier)>;

// Climbs from the lowest tier, which must do in any case, to the last whose frames take no more
// than the budget; beyond the first that takes more nothing is tried.
[[nodiscard]] config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost);

// The part of a refresh that a frame without fish may take: the other half is for the fish, for
// what a show brings, and for luck.
inline constexpr double kBudgetShare = 0.5;

}  // namespace aquarama::show
