// SPDX-License-Identifier: Apache-2.0
// The parts of a species' file that say what it looks like: body, fins, eye.
#pragma once

#include "common/config/species.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

// Each throws Error with file:line:column for what no body can have.
[[nodiscard]] BodyProfile readProfile(const TextPlace& root);
// tailRoot: the last station of the profile, before which the other fins end.
[[nodiscard]] Fins readFins(const TextPlace& at, float tailRoot);
[[nodiscard]] FinMotion readFinMotion(const TextPlace& at);
[[nodiscard]] std::vector<Thread> readThreads(const TextPlace& root);
[[nodiscard]] FishEye readEye(const TextPlace& at);

}  // namespace aquarama::config
