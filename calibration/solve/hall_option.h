// SPDX-License-Identifier: Apache-2.0
// The option --simulate.
#pragma once

#include <string>

#include "common/config/hall.h"
#include "common/config/rig.h"

namespace aquarama::solve {

// The hall that FILE or random:SEED means. Throws Error where it means none.
[[nodiscard]] config::Hall hallFrom(const std::string& text, const config::Rig& rig);

}  // namespace aquarama::solve
