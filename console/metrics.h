// SPDX-License-Identifier: Apache-2.0
// The console's figures for Prometheus: of the wall, of each node and projector, and of itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "console/console.pb.h"
#include "console/cues/osc_desk.h"

namespace aquarama::console {

// What the console measures of itself.
struct OwnFigures {
    std::uint64_t cutOff = 0;                    // connections, since the start
    bool isClockWrong = false;                   // this machine's
    std::optional<double> certificateDays = {};  // until it ends; empty: there is none
    std::optional<CueCounts> cues = {};          // empty: no desk is heard
};

// All figures in Prometheus' text format, 0.0.4. What is unknown has no sample.
[[nodiscard]] std::string metricsOf(const browser::Wall& wall,
                                    const browser::ProjectorList& projectors,
                                    const OwnFigures& own);

}  // namespace aquarama::console
