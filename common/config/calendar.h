// SPDX-License-Identifier: Apache-2.0
// What the hours of a wall have in store: moments by the clock of the hall, coming changes, and the
// scenes that are named. As civilTime(), these functions change the process's idea of local time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/hours.h"

namespace aquarama::config {

// From this moment of Unix time on something else is wanted than before.
struct HoursChange {
    long long at = 0;
    WantedHours wanted = {};
};

// The first change after a moment, up to so many days later; nothing where there is none.
[[nodiscard]] std::optional<HoursChange> changeAfter(const Hours& hours,
                                                     long long unixSeconds,
                                                     int days);

// The moment at which the clock of a zone shows "2026-12-24 18:00"; the first one where that comes
// twice. Throws Error where the text is no such time, and where the clock goes past it.
[[nodiscard]] long long momentOf(const std::string& zone, const std::string& text);
// "2026-12-24 18:00 +01:00 Thursday": what the clock of a zone shows, and how far it is ahead of
// UTC.
[[nodiscard]] std::string clockText(const std::string& zone, long long unixSeconds);

// "open, scene reef, quality high", "closed"
[[nodiscard]] std::string textOf(const WantedHours& wanted);

// The names of the scenes of all spans, each once, sorted.
[[nodiscard]] std::vector<std::string> scenesOf(const Hours& hours);
// The file of a scene that hours name, beside the scene of their rig. Throws Error, which names the
// rig, where it is not there.
[[nodiscard]] std::string scenePathOf(const std::string& name,
                                      const std::string& rigPath,
                                      const std::string& rigScene);

}  // namespace aquarama::config
