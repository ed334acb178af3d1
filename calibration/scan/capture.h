// SPDX-License-Identifier: Apache-2.0
// Takes the pictures of a scan: shows its patterns one after the other and takes a picture of each.
#pragma once

#include <string>
#include <vector>

#include "calibration/scan/camera.h"
#include "calibration/scan/shown_patterns.h"
#include "common/config/rig.h"
#include "common/config/scan.h"

namespace aquarama::scan {

// Chooses the exposure by the white patterns of `sequence`, so that less than a thousandth of the
// pixels is near the camera's full code. Then it takes a picture of each pattern; black and white
// at three exposures. A picture is taken again where a channel was lost meanwhile. Writes lossless
// PNG files and scan.txtpb into the folder, which it creates, and shows the progress. `rig` gives
// names and refresh rate. Throws Error: as wall and camera do; where white is clipped at the
// shortest exposure; where the camera gives the same picture twice.
config::Scan capture(const config::Rig& rig,
                     PatternWall& wall,
                     Camera& camera,
                     const std::vector<config::ScanPattern>& sequence,
                     const std::string& folder);

// The same on the wall of a running show, with a camera of openCamera(). SIGINT, SIGTERM and SIGHUP
// return the wall to the show at once and end the scan with Error. Call it before other threads
// start.
config::Scan captureShow(const config::Rig& rig,
                         const ShownOn& where,
                         const std::string& device,
                         const std::vector<config::ScanPattern>& sequence,
                         const std::string& folder);

}  // namespace aquarama::scan
