// SPDX-License-Identifier: Apache-2.0
// One sheet with a panel for each of the nine motor controllers.
#pragma once

#include <string>

#include "common/config/species.h"

namespace aquarama::report {

// SVG. The fish of each panel is simulated for it: in its stride at medium speed, then so ordered.
[[nodiscard]] std::string drawControllers(const config::Species& species);

}  // namespace aquarama::report
