// SPDX-License-Identifier: Apache-2.0
// Finds pictures of a scan that show the pattern of another picture.
#pragma once

#include "calibration/scan/fault_list.h"
#include "calibration/scan/small_channels.h"

namespace aquarama::scan {

// Adds "dropped_frame" for pictures that show the pattern of the picture before.
void findRepeats(const Evidence& evidence, const SmallChannels& channels, FaultList& faults);
// Adds "dropped_frame" for tags that show another number than that of their picture.
void findLateChannels(const Evidence& evidence, const SmallChannels& channels, FaultList& faults);

}  // namespace aquarama::scan
