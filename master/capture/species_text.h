// SPDX-License-Identifier: Apache-2.0
// Changes numbers in the text of a species file and leaves the rest, comments and layout, as it is.
#pragma once

#include <string>
#include <vector>

#include "common/config/species.h"

namespace aquarama::capture {

// The text with the value of one field replaced, in four significant digits. `field` is the path to
// it, as in {"swim", "slow", "gain"}; the first field with this path is changed. Throws Error when
// the text has none.
[[nodiscard]] std::string withNumber(const std::string& text,
                                     const std::vector<std::string>& field,
                                     double value);

// The text with all parameters that the search may change, and the strengths of the turns, set to
// those of `species`. Throws Error when a field is missing.
[[nodiscard]] std::string withGaitsOf(const config::Species& species, std::string text);

}  // namespace aquarama::capture
