// SPDX-License-Identifier: Apache-2.0
// What a show is made of, as bytes that a recording keeps, and back: the same production is the
// same world on any machine.
#pragma once

#include <cstdint>

#include "common/wire/recording.h"
#include "master/staging/staging.h"

namespace aquarama {

[[nodiscard]] Production productionOf(const Staging& staging, std::uint32_t seed);

// Captures nothing: it has its repertoires. Throws Error where the scene, a species or a repertoire
// is wrong.
[[nodiscard]] Staging stagingOf(const Production& production);
[[nodiscard]] WorldOptions worldOptionsOf(const Production& production);

}  // namespace aquarama
