// SPDX-License-Identifier: Apache-2.0
// The gaits of species in the figures by which fish are compared, as a table in Markdown.
#pragma once

#include <string>

#include "common/config/species.h"

namespace aquarama::search {

[[nodiscard]] std::string gaitTableHead();
[[nodiscard]] std::string gaitTableRows(
    const config::Species& species);  // slow, medium, fast: simulated now

// How far its turns go, in degrees, when they are begun at any point of a slow, medium or fast
// beat.
[[nodiscard]] std::string turnTableHead();
[[nodiscard]] std::string turnTableRow(const config::Species& species);

}  // namespace aquarama::search
