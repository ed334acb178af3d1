// SPDX-License-Identifier: Apache-2.0
// What the console knows of its wall and keeps of its own: pages show it, commands change it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/hours.h"
#include "common/config/rig.h"
#include "common/enrol/discovery.h"
#include "console/access.h"
#include "console/alerts.h"
#include "console/console.pb.h"
#include "console/drawing_book.h"
#include "console/files_of_show.h"
#include "console/opening.h"
#include "console/overview.h"
#include "console/panorama.h"

namespace aquarama::console {

// Of the server's thread.
struct State {
    // `rigFile`: its path; `build`: version and commit of the console. Throws Error where what is
    // kept on the disk cannot be read.
    State(config::Rig rigRead, std::string rigPath, std::string buildText, Access& accessBook)
        : rig{std::move(rigRead)},
          rigFile{std::move(rigPath)},
          build{std::move(buildText)},
          access{accessBook},
          events{config::consoleFolderOf(rigFile) / "events.jsonl"},
          opening{config::consoleFolderOf(rigFile)},
          panorama{rigFile} {
        wall.set_heard(false);
    }

    config::Rig rig;
    std::string rigFile;
    std::string build;
    Access& access;
    EventBook events;
    Opening opening;
    Alerts alerts;
    FigureRings figures;
    PanoramaWatch panorama;
    DrawingBook drawings;  // of visitors
    browser::Wall wall;    // as the master last said it
    browser::DoctorReport doctor;
    std::optional<browser::Calibrations> calibrations = {};  // as they were last read
    std::optional<browser::Releases> releases = {};          // as the depot last said it
    std::optional<browser::Tour> tour = {};                  // as it was last found
    std::string code = {};          // the last pairing code that somebody asked for in a page
    std::string doubtOfClock = {};  // empty: it may be right
    std::uint64_t refused = 0;      // requests, since the start
    std::string keyFolder = {};     // of the master's keys; empty: the rig's own
    UnixSeconds built = 0;          // when this program was
    std::vector<enrol::FoundNode> waiting = {};  // nodes without a key, as they were last found
    bool searchesNodes = false;
};

}  // namespace aquarama::console
