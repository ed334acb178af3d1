// SPDX-License-Identifier: Apache-2.0
// What the console reads on the master's machine beside the wall: the log of the show, scenes, the
// doctor's findings, calibrations; and its own list of events.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "console/access.h"
#include "console/console.pb.h"

namespace aquarama::console {

// The log of all nodes, which its master writes.
[[nodiscard]] std::filesystem::path logOf(const std::string& rigPath);
// Names of the scenes beside the rig's.
[[nodiscard]] std::vector<std::string> scenesBeside(const std::string& rigPath,
                                                    const std::string& scene);

// The last lines of a log that a page wants to see: of the node (empty: all), with this text, and
// only those that are more than information.
[[nodiscard]] browser::LogTail tailOf(const std::filesystem::path& log, const browser::Look& look);

// Asks `aquarama doctor`, which lies beside this program; takes seconds, a minute at most.
[[nodiscard]] browser::DoctorReport askDoctor(const std::string& rigPath);

// Those that were kept of the rig's wall file, and drift's last look; may take seconds.
[[nodiscard]] browser::Calibrations calibrationsOf(const std::string& rigPath);
// Puts one of them in place, by `aquarama calibrations`, which lies beside this program; takes
// seconds. Why not, where it is refused.
[[nodiscard]] std::string useCalibration(const std::string& rigPath, const std::string& name);

// A zip archive of the logs of a show (the last 8 MiB of each), its rig, and these other files,
// each a name and a text. Throws Error where a name is twice, or none for an archive.
[[nodiscard]] std::string bundleOf(const std::string& rigPath,
                                   std::vector<std::pair<std::string, std::string>> files);

// What happened, and who did it; the last of them, also of earlier runs. A line each in a file.
class EventBook {
  public:
    explicit EventBook(std::filesystem::path file);
    // A disk that is full loses the line there, not here.
    void add(const std::string& who, const std::string& what);
    [[nodiscard]] browser::EventList list() const;

  private:
    std::filesystem::path file_;
    std::deque<browser::Event> events_;  // the newest first
};

}  // namespace aquarama::console
