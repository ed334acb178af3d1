// SPDX-License-Identifier: Apache-2.0
// The part of a species' file that says how it lives.
#pragma once

#include <string>

#include "common/config/habits.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

// `species`: its own name, which it neither hunts nor shadows. Throws Error with file:line:column
// for what no fish can have and for habits that contradict its role.
[[nodiscard]] Habits readHabits(const TextPlace& at, const std::string& species);

}  // namespace aquarama::config
