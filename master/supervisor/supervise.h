// SPDX-License-Identifier: Apache-2.0
// Runs a show on this machine: starts the master and all nodes of a rig as processes, and
// supervises them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/rig.h"

namespace aquarama::supervisor {

inline constexpr const char* kDefaultRig = "config/desk.txtpb";  // where no rig is named

// The options of a show that its master needs. An empty string is an option that was not given.
struct ShowOptions {
    std::string rigPath = kDefaultRig;
    std::string scenePath;  // empty: the rig's
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> fish;    // of the first species; empty: as many as the scene has
    std::optional<std::uint64_t> frames;  // after which the show ends; empty: a user ends it
    std::string pattern;                  // empty: the world
    std::string quality;                  // empty: the rig's
    std::string keyFolder;                // empty: config::keyFolderOf()
    std::string traceFolder;
    std::string recordPath;  // the show is written to this new file; empty: it is not
    std::string replayPath;  // the recording that is shown; empty: a new world
    std::uint64_t replayFromTick = 0;
};

// The options of a show that its supervisor needs.
struct RunOptions {
    ShowOptions show;
    bool headless = false;
    bool live = false;  // follows the clock even where other options imply lockstep
    std::string snapshotFolder;
    bool deep = false;                // pictures of 16 bits
    int scale = 1;                    // of panorama.png: times as fine as the rig's
    std::string clipPath;             // .mp4 or .webp; empty: no clip
    std::string clipOf = "panorama";  // or hall, or a channel's name
    int filmEvery = 1;                // frames of the show to one of the clip
    // Where the clip is a part of a film: its frame at which the part begins.
    std::uint64_t clipFromFrame = 0;

    // Whether frame n shows tick n and no clock is read.
    [[nodiscard]] bool lockstep() const {
        return !live && (headless || show.frames.has_value() || !snapshotFolder.empty() ||
                         !clipPath.empty());
    }
};

// Runs the show to its end and returns the exit status. Live, a process that dies is started again;
// in lockstep its death ends the show with an error. Throws Error where the show cannot begin.
// Blocks the signals that it waits for: call it once, in a process of one thread.
[[nodiscard]] int runShow(const RunOptions& options, const config::Rig& rig);

}  // namespace aquarama::supervisor
