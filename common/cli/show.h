// SPDX-License-Identifier: Apache-2.0
// `aquarama run`: the master and all nodes of a rig on this machine, as separate processes, watched
// over.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/rig.h"

namespace aquarama::cli {

struct ShowOptions {
    std::string rigPath;
    std::string scenePath;  // empty: the rig's
    bool headless = false;
    bool live =
        false;  // keeps the clock even where --headless, --frames or --snapshot imply lockstep
    std::optional<std::uint64_t> frames;
    std::optional<std::uint32_t> seed;
    std::optional<std::uint32_t> fish;
    std::string pattern;              // empty: the world
    std::string quality;              // empty: the rig's
    std::string snapshotFolder;       // empty: no pictures
    bool deep = false;                // 16-bit pictures
    std::string clipPath;             // a clip of the show, .mp4 or .webp; empty: none
    std::string clipOf = "panorama";  // or hall, or a channel's name
    int filmEvery = 1;                // the clip has every so many frames
    std::string traceFolder;
    std::string recordPath;  // the show is written to this new file; empty: it is not
    std::string replayPath;  // the recording that is shown; empty: a new world

    [[nodiscard]] bool lockstep() const {
        return !live &&
               (headless || frames.has_value() || !snapshotFolder.empty() || !clipPath.empty());
    }
};

// Returns the exit status. Live, a process that dies is started again; in lockstep its death ends
// the show with an error.
[[nodiscard]] int runShow(const ShowOptions& options, const config::Rig& rig);

}  // namespace aquarama::cli
