// SPDX-License-Identifier: Apache-2.0
// What is wrong with a camera's pictures of a scan.
#pragma once

#include "calibration/scan/decode.h"
#include "calibration/scan/frames.h"

namespace aquarama::scan {

// What decoding has noticed of one channel.
struct ChannelNotes {
    double clipped = 0;  // share of its pixels whose white the camera cannot tell from more
    bool hasPhase = false;
    bool isTagged = false;
    float step = 0;  // its pixels between two of the camera
    // The picture of stripes that lies farthest from where the phase says, in its pixels.
    double shift = 0;
    std::size_t shiftedPicture = 0;  // in the scan
};

struct Evidence {
    const config::Scan& scan;
    const config::Rig& rig;
    std::uint32_t camera = 0;
    const CameraView& view;
    const SmallPictures& small;
    std::size_t firstBlack = 0;  // of the scan's pictures
    std::vector<ChannelNotes> channels;
};

[[nodiscard]] std::vector<ScanFault> faultsOf(const Evidence& evidence);

}  // namespace aquarama::scan
