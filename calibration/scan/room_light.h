// SPDX-License-Identifier: Apache-2.0
// Finds changes of the room's light and of the camera's exposure during a scan.
#pragma once

#include "calibration/scan/fault_list.h"
#include "calibration/scan/small_channels.h"

namespace aquarama::scan {

// Adds "ambient_light" where a later black differs from the first one.
void findBlackDrift(const Evidence& evidence, const SmallChannels& channels, FaultList& faults);
// Adds "ambient_light" or "auto_exposure" where pictures of phase are brighter or darker than white
// lets expect.
void findLightDrift(const Evidence& evidence, const SmallChannels& channels, FaultList& faults);

}  // namespace aquarama::scan
