// SPDX-License-Identifier: Apache-2.0
// What the command line of a node says.
#pragma once

#include <string>

namespace aquarama {

struct NodeOptions {
    std::string channel;
    std::string masterAddress;
    bool headless = false;
    std::string device;          // for --headless, instead of the rig's; empty: the rig's
    std::string snapshotFolder;  // of the last frame; empty: none
    bool deep = false;           // 16 bits instead of 8 dithered ones
    int filmEvery = 0;           // also a snapshot every so many frames
    std::string traceFolder;     // empty: none
};

}  // namespace aquarama
