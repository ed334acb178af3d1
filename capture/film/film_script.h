// SPDX-License-Identifier: Apache-2.0
// What fish and replica do in the film: every manoeuvre, once from rest and once from swimming
// where both exist.
#pragma once

#include "capture/report/script.h"
#include "common/motion/repertoire.h"

namespace aquarama::film {

// Longer than the film of any species.
inline constexpr double kWholeFilmSeconds = 600;

// A run-in of steady medium swimming, as that of report::makeScript(), then the film's commands
// until they last `seconds`, or all of them.
[[nodiscard]] report::Script filmScript(const motion::Repertoire& repertoire, double seconds);

}  // namespace aquarama::film
