// SPDX-License-Identifier: Apache-2.0
// Corrects a solved hall by the smooth difference that is left to what its cameras saw.
#pragma once

#include <vector>

#include "calibration/geometry/solve.h"

namespace aquarama::geometry {

// Sets the hall's corrections from the ties that are not held out: by least squares with a penalty
// on bends, in which outliers have little weight.
void correct(SolvedHall& hall, const std::vector<Tie>& ties);

}  // namespace aquarama::geometry
