// SPDX-License-Identifier: Apache-2.0
// Finds what is wrong with a camera's pictures of a scan.
#pragma once

#include "calibration/scan/decode.h"
#include "calibration/scan/frames.h"

namespace aquarama::scan {

// What decoding noted about one channel.
struct ChannelNotes {
    double clipped = 0;  // share of its pixels whose white is at the camera's limit
    bool hasPhase = false;
    bool isTagged = false;
    float step = 0;  // pixels of the channel between two pixels of the camera
    // The picture of stripes that lies farthest from where the phase says; pixels of the channel.
    double shift = 0;
    std::size_t shiftedPicture = 0;  // index in the scan
};

// All that the faults are found in. Everything outlives it.
struct Evidence {
    const config::Scan& scan;
    const config::Rig& rig;
    std::uint32_t camera = 0;
    const CameraView& view;
    const SmallPictures& small;
    std::size_t firstBlack = 0;          // index in the scan
    std::vector<ChannelNotes> channels;  // as the rig's
};

// All faults, the cause first. Builds a wall of the rig once.
[[nodiscard]] std::vector<ScanFault> faultsOf(const Evidence& evidence);

}  // namespace aquarama::scan
