// SPDX-License-Identifier: Apache-2.0
// Takes the pictures of a scan: shows its patterns, one after the other, and has a camera look.
#pragma once

#include <string>
#include <vector>

#include "calibration/scan/camera.h"
#include "calibration/scan/shown_patterns.h"
#include "common/config/rig.h"
#include "common/config/scan.h"

namespace aquarama::scan {

// Picks the exposure by the whitest patterns of `sequence`, such that less than a thousandth of the
// pixels comes near the camera's full code, then takes a picture of each pattern; black and white
// at three exposures. A picture during which a channel went is taken again. Writes lossless PNG
// files and scan.txtpb into the folder, which is made; says how far it is on standard output, in
// one line of a terminal. `rig`: whose names and refresh are meant. Throws Error: what the wall or
// the camera does; white that is clipped at the shortest exposure; a camera that gives the same
// picture twice.
config::Scan capture(const config::Rig& rig,
                     PatternWall& wall,
                     Camera& camera,
                     const std::vector<config::ScanPattern>& sequence,
                     const std::string& folder);

// The same on the wall of a running show by a camera of openCamera(). SIGINT, SIGTERM and SIGHUP
// give the wall back at once, and end it with Error. Call it before other threads are made.
config::Scan captureShow(const config::Rig& rig,
                         const ShownOn& where,
                         const std::string& device,
                         const std::vector<config::ScanPattern>& sequence,
                         const std::string& folder);

}  // namespace aquarama::scan
