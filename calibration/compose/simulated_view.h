// SPDX-License-Identifier: Apache-2.0
// Draws the view in a simulated hall that shows the pictures of channels: `aquarama view`.
#pragma once

#include <string>

namespace aquarama::compose {

// The options of a view. An empty name is not given.
struct SimulatedView {
    std::string rigPath;
    // The simulated hall: a file or random:SEED. Empty: the light falls as the rig and its wall
    // file say.
    std::string hall;
    std::string wallPath;  // wall file for all channels, in place of the rig's
    std::string folder;    // of channel-NAME.png; or of panorama.png alone, which is drawn first
    std::string view;      // "hall": an eye at the back; "camera"
    std::string outPath;   // PNG
};

// Takes seconds; uses all processors. Throws Error where a file is missing or does not fit.
void drawView(const SimulatedView& options);

}  // namespace aquarama::compose
