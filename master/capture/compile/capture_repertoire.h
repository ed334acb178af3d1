// SPDX-License-Identifier: Apache-2.0
// Captures a species: simulates its actions and compiles its repertoire (the paper's section 3).
#pragma once

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile/recording.h"

namespace aquarama {

// The same bytes each time on one machine, however many cores it has. Another machine's sine may
// differ in the last bit, which is why only the master captures. Progress comes from several
// threads, but from one at a time.
[[nodiscard]] Repertoire captureRepertoire(const Species& species, const Progress& progress);

}  // namespace aquarama
