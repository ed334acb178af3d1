// SPDX-License-Identifier: Apache-2.0
// All that a render node holds of the fish of a scene: how they move, what their minds have
// commanded, which drawings they wear. Master and nodes have it alike to the bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"

namespace aquarama::school {

// The fish of a scene at one tick, by index. Owned by whoever advances it.
struct SchoolState {
    Tick tick;
    motion::MotionStates states;
    motion::MotorCommands commands;
    std::vector<std::uint32_t> skins;  // FishRecord::skin

    // Gives each of so many fish an element of every column.
    void resize(std::size_t fish);
    // Number of fish.
    [[nodiscard]] std::size_t size() const { return states.size(); }
    // The record of each fish, by index, and how one becomes as a record says.
    void records(std::vector<motion::FishRecord>& records) const;
    void set(std::size_t fish, const motion::FishRecord& record);
};

// Folds every bit of a state into one number: equal states have equal hashes. `records` and
// `commands` are of the same fish.
[[nodiscard]] std::uint64_t hashOf(const std::vector<motion::FishRecord>& records,
                                   const motion::MotorCommands& commands);

// The phase rates of the fish [first, last) of a species as recorded, by action.
struct RecordedRates {
    std::uint32_t first = 0, last = 0;
    std::array<std::int16_t, motion::kActions> phaseRate{};
};
[[nodiscard]] RecordedRates recordedRates(const motion::MotorTables& tables,
                                          std::uint32_t first,
                                          std::uint32_t last);

}  // namespace aquarama::school
