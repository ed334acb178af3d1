// SPDX-License-Identifier: Apache-2.0
// Changes numbers in the text of a species file and leaves the rest, comments and layout, as it is.
#pragma once

#include <string>
#include <vector>

#include "common/config/species.h"

namespace aquarama::capture {

// The value of the first field that is reached by these names, as in {"swim", "slow", "gain"}, with
// four significant digits. Throws Error when the text holds no such field.
[[nodiscard]] std::string withNumber(const std::string& text,
                                     const std::vector<std::string>& field,
                                     double value);

// With all that the search may change as `species` has it.
[[nodiscard]] std::string withGaitsOf(const config::Species& species, std::string text);

}  // namespace aquarama::capture
