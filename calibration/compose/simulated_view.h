// SPDX-License-Identifier: Apache-2.0
// What is seen in a simulated hall of the pictures of channels: `aquarama view`.
#pragma once

#include <string>

namespace aquarama::compose {

// What is drawn, and of what. Empty names are not given.
struct SimulatedView {
    std::string rigPath;
    // How projectors and screen truly are: a hall's file or random:SEED. Where it is empty, the
    // light falls as the rig and its wall file say.
    std::string hall;
    std::string wallPath;  // wall file for all channels, in place of the rig's
    std::string folder;    // of channel-NAME.png; or of panorama.png alone, which is drawn first
    std::string view;      // "hall": an eye at the back; "camera"
    std::string outPath;   // PNG
};

// Takes seconds; uses all processors. Throws Error where a file is missing or does not fit.
void drawView(const SimulatedView& options);

}  // namespace aquarama::compose
