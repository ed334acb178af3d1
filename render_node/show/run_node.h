// SPDX-License-Identifier: Apache-2.0
// Runs a render node with the options of its command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/net/channels.h"

namespace aquarama::show {

// The options of a node. Folders and pipes: empty means none.
struct NodeOptions {
    std::string channel;
    std::vector<std::string> masterAddresses;  // control; of the master, then of its standby
    std::optional<net::PeerKeys> keys;         // where the master is on another machine
    bool headless = false;
    // The monitor of a channel that fills one, in place of the rig's; empty: the rig's.
    std::string connector;
    // With --headless, in place of the rig's device; empty: the rig's.
    std::string device;
    // Where the last frame is written.
    std::string snapshotFolder;
    // 16 bits for each sample of the snapshot, in place of 8 dithered ones.
    bool deep = false;
    // Above 1: panorama.png of the whole wall is written as well, so many times as fine as the
    // rig's.
    int panoramaScale = 1;
    // A socket that takes frames for a clip.
    std::string filmPipe;
    // Every how many frames the clip takes one; at least 1.
    int filmEvery = 1;
    // Where the times of frames are written.
    std::string traceFolder;
    // Reported to the master: version and commit, and the monitors of this machine.
    std::string build;
    std::vector<std::string> monitors;
};

// Runs one node from joining the show to its end.

// Call on the main thread, which handles the window's events and starts the drawing thread. Returns
// when the show is over or a signal has ended it; true where this node is to be started again.
// Throws Error for options that cannot be met.
bool runNode(const NodeOptions& options);

}  // namespace aquarama::show
