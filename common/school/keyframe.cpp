// SPDX-License-Identifier: Apache-2.0
#include "common/school/keyframe.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>

#include "common/base/byte_stream.h"
#include "common/base/units.h"

namespace aquarama::school {
namespace {

constexpr std::uint32_t kVersion = 1;
using ModelNumbers = std::array<BitModel, sizeof(StepModels) / sizeof(BitModel)>;
// A model out of these bounds would leave no room for one of the two bits.
constexpr BitModel kLeastModel = 16, kMostModel = 0xFFFF - 16;
constexpr std::uint8_t kMostChanges = 127, kMostRecent = 3;

// All columns of the commands and of the memory of each fish, in the order of the file.
template <class Commands, class Memory, class OnColumn>
void onColumns(Commands& commands, Memory& memory, const OnColumn& on) {
    on(commands.action);
    on(commands.phaseRate);
    on(commands.brake);
    on(commands.mouth);
    on(commands.gaze);
    on(commands.pitch);
    on(commands.yawRate);
    on(memory.lastChanges);
    on(memory.recentlyChanged);
}

// Of all fish, one species after the other, or of none.
bool areWhole(const std::vector<RecordedRates>& rates, std::size_t fish) {
    std::uint32_t next = 0;
    for (const RecordedRates& one : rates) {
        if (one.first != next || one.last < one.first) return false;
        next = one.last;
    }
    return rates.empty() || next == fish;
}

bool isSound(const Keyframe& keyframe) {
    const auto& commands = keyframe.school.commands;
    const auto models = std::bit_cast<ModelNumbers>(keyframe.memory.models);
    const auto isAtMost = [](unsigned most) {
        return [most](unsigned number) { return number <= most; };
    };
    return std::ranges::all_of(
               models,
               [](BitModel model) { return model >= kLeastModel && model <= kMostModel; }) &&
           areWhole(keyframe.memory.rates, keyframe.school.size()) &&
           std::ranges::all_of(commands.action, isAtMost(motion::kActions - 1)) &&
           std::ranges::all_of(commands.phaseRate, [](int rate) { return rate >= 0; }) &&
           std::ranges::all_of(keyframe.memory.lastChanges, isAtMost(kMostChanges)) &&
           std::ranges::all_of(keyframe.memory.recentlyChanged, isAtMost(kMostRecent));
}

std::vector<RecordedRates> readRates(ByteReader& in) {
    const auto kinds = in.unsignedNumber<std::uint32_t>();
    if (kinds > kMostSpecies) return {};
    std::vector<RecordedRates> rates(kinds);
    for (RecordedRates& kind : rates) {
        kind.first = in.unsignedNumber<std::uint32_t>();
        kind.last = in.unsignedNumber<std::uint32_t>();
        in.numbers<std::int16_t>(kind.phaseRate);
    }
    return rates;
}

// Records are read and checked one by one. False: one of them is not playable.
bool readRecords(ByteReader& in, SchoolState& school) {
    for (std::size_t fish = 0; fish < school.size(); ++fish) {
        std::array<motion::FishRecord, 1> record;
        in.numbers<motion::FishRecord>(record);
        if (!motion::isPlayable(record.front())) return false;
        school.set(fish, record.front());
    }
    return true;
}

}  // namespace

std::vector<std::byte> encodeKeyframe(Tick tick,
                                      std::span<const motion::FishRecord> records,
                                      const motion::MotorCommands& commands,
                                      const StepMemory& memory) {
    assert(records.size() == memory.lastChanges.size());
    ByteWriter out;
    out.unsignedNumber(kVersion);
    out.unsignedNumber(static_cast<std::uint32_t>(records.size()));
    out.unsignedNumber(tick.value);
    out.unsignedNumber(static_cast<std::uint32_t>(memory.rates.size()));
    for (const RecordedRates& kind : memory.rates) {
        out.unsignedNumber(kind.first);
        out.unsignedNumber(kind.last);
        out.numbers<std::int16_t>(kind.phaseRate);
    }
    const auto models = std::bit_cast<ModelNumbers>(memory.models);
    out.numbers<BitModel>(models);
    out.numbers(records);
    onColumns(commands, memory, [&](const auto& column) { out.numbers(std::span{column}); });
    return std::move(out).take();
}

// Memory is taken once the length of the bytes has been compared with the number of fish.
std::optional<Keyframe> decodeKeyframe(std::span<const std::byte> bytes, std::size_t fish) {
    constexpr std::size_t kColumnBytes = 12;
    ByteReader in(bytes);
    if (in.unsignedNumber<std::uint32_t>() != kVersion) return std::nullopt;
    if (in.unsignedNumber<std::uint32_t>() != fish) return std::nullopt;
    Keyframe keyframe;
    keyframe.school.tick = {in.unsignedNumber<std::uint64_t>()};
    keyframe.memory = makeStepMemory(readRates(in), 0);
    ModelNumbers models{};
    in.numbers<BitModel>(models);
    keyframe.memory.models = std::bit_cast<StepModels>(models);
    if (!in.ok() || in.remaining() != fish * (sizeof(motion::FishRecord) + kColumnBytes))
        return std::nullopt;
    keyframe.school.resize(fish);
    keyframe.memory.lastChanges.resize(fish);
    keyframe.memory.recentlyChanged.resize(fish);
    if (!readRecords(in, keyframe.school)) return std::nullopt;
    onColumns(keyframe.school.commands, keyframe.memory, [&](auto& column) {
        in.numbers(std::span{column});
    });
    if (!in.ok() || !isSound(keyframe)) return std::nullopt;
    return keyframe;
}

}  // namespace aquarama::school
