// SPDX-License-Identifier: Apache-2.0
// What the wall shows, in the few values that desks are told.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/osc/osc.h"
#include "common/wire/messages.h"

namespace aquarama::console {

// One of them, as "black" and 1.
struct ShownValue {
    std::string name;
    osc::OscArgument value;
    friend bool operator==(const ShownValue&, const ShownValue&) = default;
};

// How many drawings of visitors there are.
struct DrawingCounts {
    std::uint32_t waiting = 0;   // for the crew
    std::uint32_t swimming = 0;  // or on their way
};

// All of them, always the same names in the same order. `isHeard`: the master answers; else its
// status is of the last time that it did.
[[nodiscard]] std::vector<ShownValue> shownBy(const v1::StatusReply& status,
                                              bool isHeard,
                                              const DrawingCounts& drawings = {});

}  // namespace aquarama::console
