// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/mate.h"

#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course mate(const Situation& situation, Mind& /*mind*/, Deeds& /*deeds*/) {
    return pursue(situation, situation.senses.mate.offset, situation.nature.slow);
}

}  // namespace aquarama
