// SPDX-License-Identifier: Apache-2.0
// The entries of the boot loader, as values: it starts the newest release that has tries left. What
// is good stays as long as another is tried, so that a power cut at any moment leaves something to
// start.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "releases/release.h"

namespace aquarama::releases {

// An entry, as its file's name has it: aquarama-1.4.0.conf, aquarama-1.4.0+2-1.conf.
struct BootEntry {
    ReleaseId release = {};
    std::optional<int> triesLeft = {};  // nothing: it is good
    std::string file = {};
};
inline constexpr int kTries = 3;

// The entry of a file's name; its serial is not known. Nothing: it is none of ours.
[[nodiscard]] std::optional<BootEntry> entryOf(const std::string& fileName);
// The name of its file.
[[nodiscard]] std::string fileOf(const ReleaseId& release, std::optional<int> triesLeft);

// A change of one file. Each is on the disk before the next one begins.
struct BootStep {
    // What becomes of the file.
    enum class What : std::uint8_t { Write, Rename, Remove };
    What what;
    BootEntry entry;      // that is written, renamed or removed
    std::string to = {};  // new name
};

// After these steps the boot loader starts this release: its entry is there, and none of a newer
// one.
[[nodiscard]] std::vector<BootStep> stepsToStart(const std::vector<BootEntry>& entries,
                                                 const ReleaseId& release);
// After these steps it is good.
[[nodiscard]] std::vector<BootStep> stepsToBless(const std::vector<BootEntry>& entries,
                                                 const ReleaseId& release);
// After these steps there are only entries of `kept`.
[[nodiscard]] std::vector<BootStep> stepsToForget(const std::vector<BootEntry>& entries,
                                                  const std::vector<ReleaseId>& kept);

}  // namespace aquarama::releases
