// SPDX-License-Identifier: Apache-2.0
// The smooth rest between a solved hall and what its cameras have seen.
#pragma once

#include <vector>

#include "calibration/geometry/solve.h"

namespace aquarama::geometry {

// Sets the hall's corrections from the ties that are not held out: least squares with a penalty on
// bends, where a tie that lies far off counts little.
void correct(SolvedHall& hall, const std::vector<Tie>& ties);

}  // namespace aquarama::geometry
