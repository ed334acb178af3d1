// SPDX-License-Identifier: Apache-2.0
// Finds projectors and cameras that moved during a scan.
#pragma once

#include "calibration/scan/fault_list.h"
#include "calibration/scan/small_channels.h"

namespace aquarama::scan {

// Adds "moved" where a channel that is seen, or the camera, has moved since white was shown.
void findMovement(const Evidence& evidence,
                  const SmallChannels& channels,
                  std::size_t channel,
                  FaultList& faults);

}  // namespace aquarama::scan
