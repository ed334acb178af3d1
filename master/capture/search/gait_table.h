// SPDX-License-Identifier: Apache-2.0
// The gaits of species in the figures by which fish are compared, as a table in Markdown.
#pragma once

#include <string>

#include "master/capture/search/gait_trial.h"

namespace aquarama {

[[nodiscard]] std::string gaitTableHead();
[[nodiscard]] std::string gaitTableRows(
    const Species& species);  // slow, medium, fast: simulated now

}  // namespace aquarama
