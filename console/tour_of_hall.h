// SPDX-License-Identifier: Apache-2.0
// How far a new hall is, as `aquarama tour` finds it step by step, and the crew's word that a
// finding is right.
#pragma once

#include <string>

#include "console/console.pb.h"

namespace aquarama::console {

// All steps in their order; takes some seconds, as the doctor is one of them. Where they cannot be
// looked at, why.
[[nodiscard]] browser::Tour tourOf(const std::string& rigFile);
// The same of what `aquarama tour --json` says.
[[nodiscard]] browser::Tour tourIn(const std::string& json);

// Takes the finding of a step as right; takes some seconds. Why not, where it is refused.
[[nodiscard]] std::string confirmStep(const std::string& rigFile,
                                      const std::string& step,
                                      const std::string& found);

}  // namespace aquarama::console
