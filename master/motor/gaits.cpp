// SPDX-License-Identifier: Apache-2.0
#include "master/motor/gaits.h"

#include "common/units/ids.h"

namespace aquarama {

Gaits gaitsOf(const MotorTables& tables) {
    Gaits gaits;
    for (std::size_t i = 0; i < kActions; ++i) {
        const auto action = static_cast<Action>(i);
        gaits.phaseRate[i] = recordedPhaseRate(tables, action);
        gaits.speed[i] = recordedSpeedBodyLengths(tables, action);
        const float secondsOfCycle = 65536.0F / (static_cast<float>(gaits.phaseRate[i]) *
                                                 static_cast<float>(kTicksPerSecond));
        gaits.turn[i] = recordedTurnRate(tables, action) * secondsOfCycle;
    }
    return gaits;
}

}  // namespace aquarama
