// SPDX-License-Identifier: Apache-2.0
// How far a species' swimming is from that of living fish.
#pragma once

#include "master/capture/search/gait_trial.h"

namespace aquarama::search {

// 0 when every figure of every gait lies where living fish have it; else the sum of the squares of
// what they miss by, each in units of its own tolerance.
[[nodiscard]] double missOf(const ForwardFigures& gaits);

}  // namespace aquarama::search
