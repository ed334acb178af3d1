// SPDX-License-Identifier: Apache-2.0
#include "master/fish/gaits.h"

#include "common/units/ids.h"

namespace aquarama::fish {

Gaits gaitsOf(const motion::MotorTables& tables) {
    Gaits gaits;
    for (std::size_t i = 0; i < motion::kActions; ++i) {
        const auto action = static_cast<motion::Action>(i);
        gaits.phaseRate[i] = motion::recordedPhaseRate(tables, action);
        gaits.speed[i] = motion::recordedSpeedBodyLengths(tables, action);
        const float secondsOfCycle = 65536.0F / (static_cast<float>(gaits.phaseRate[i]) *
                                                 static_cast<float>(kTicksPerSecond));
        gaits.turn[i] = motion::recordedTurnRate(tables, action) * secondsOfCycle;
    }
    return gaits;
}

}  // namespace aquarama::fish
