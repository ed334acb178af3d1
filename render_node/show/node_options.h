// SPDX-License-Identifier: Apache-2.0
// What the command line of a node says.
#pragma once

#include <string>

namespace aquarama::show {

struct NodeOptions {
    std::string channel;
    std::string masterAddress;
    bool headless = false;
    std::string device;          // for --headless, instead of the rig's; empty: the rig's
    std::string snapshotFolder;  // of the last frame; empty: none
    bool deep = false;           // 16 bits instead of 8 dithered ones
    std::string filmPipe;        // a socket that takes frames for a clip; empty: none
    int filmEvery = 1;           // only every so many frames
    std::string traceFolder;     // empty: none
};

}  // namespace aquarama::show
