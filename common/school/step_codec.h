// SPDX-License-Identifier: Apache-2.0
// The code of a step: what minds command anew in a tick, and the fish that were placed in it. All
// else follows from the motor. The models of the code learn from each step, so that steps are coded
// and decoded in order, without a gap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/school/range_coder.h"
#include "common/school/school_state.h"

namespace aquarama::school {

// A fish decides in each so many ticks, its index shifts the tick; most commands change then.
inline constexpr std::uint64_t kTicksBetweenDecisions = 8;

// A binary tree of models, for a number of so many bits.
template <unsigned bits>
using Tree = std::array<BitModel, std::size_t{1} << bits>;

// All models. Written and read as they lie in memory.
struct StepModels {
    // Whether the commands of a fish change at its decision: by what it does, and by how many of
    // its last two decisions changed any. Whether any of the seven others of its eight change, and
    // which of them.
    std::array<std::array<BitModel, 4>, 4> decides;
    BitModel others;
    std::array<std::array<BitModel, 4>, kTicksBetweenDecisions> other;
    // Which commands change, by which changed last.
    std::array<Tree<7>, 16> changes;
    std::array<Tree<6>, 64> action;  // by the one before
    std::array<Tree<6>, 64> rate;    // as a level, by the one before
    Tree<4> rateOff;                 // off all levels: from what is expected
    std::array<Tree<4>, 16> brake;   // as a level, by the one before
    Tree<8> mouth;
    std::array<Tree<4>, 16> gazeAside;  // by how it turned aside before
    std::array<Tree<4>, 2> gazeUp;      // by whether it turns aside
    std::array<Tree<7>, 4> pitch;       // levels from the one before, by what it does
    std::array<BitModel, 2> yawIsZero, yawIsLeft;
    Tree<7> yawHigh;
    std::array<Tree<8>, 16> yawLow;  // by the lowest bits of the upper half
    Tree<8> placed;                  // how many fish
};
static_assert(std::is_trivially_copyable_v<StepModels> &&
              std::has_unique_object_representations_v<StepModels>);

// All that the code of the next step depends on. Master and nodes have it alike.
struct StepMemory {
    StepModels models;
    std::vector<RecordedRates> rates;  // by species, one after the other
    std::vector<std::uint8_t>
        lastChanges;  // of each fish: which commands changed at its last change
    std::vector<std::uint8_t>
        recentlyChanged;  // of each fish: bit 0 and 1, whether at its last two decisions
};
// Of a stream that begins. `rates`: of all fish, or of none.
[[nodiscard]] StepMemory makeStepMemory(std::vector<RecordedRates> rates, std::size_t fish);

// A fish that was put somewhere, taken away, or given a drawing; after the step its record is this.
struct PlacedFish {
    std::uint32_t fish = 0;
    motion::FishRecord record;
};

// Codes the step that leads to a tick, in which the commands `known` become `commands`; both are of
// all fish. `known` and `memory` go on.
[[nodiscard]] std::vector<std::byte> encodeStep(Tick tick,
                                                const motion::MotorCommands& commands,
                                                std::span<const PlacedFish> placed,
                                                motion::MotorCommands& known,
                                                StepMemory& memory);

// The other way: `known` becomes what it was coded from. Returns the fish that were placed; nothing
// where these bytes are no such step, after which `known` and `memory` are of no use.
[[nodiscard]] std::optional<std::vector<PlacedFish>> decodeStep(Tick tick,
                                                                std::span<const std::byte> step,
                                                                motion::MotorCommands& known,
                                                                StepMemory& memory);

}  // namespace aquarama::school
