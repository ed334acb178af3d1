// SPDX-License-Identifier: Apache-2.0
#include "common/wire/state_codec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "common/config/rules.h"
#include "common/wire/messages.h"

namespace aquarama::wire {
namespace {

// The records are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);

// Of FoodRecord; a receiver refuses any other.
constexpr std::uint32_t kLayoutVersion = 6;
constexpr int kPlaceNumbers = 3;

template <class Record>
void writeRecords(std::span<const Record> records, std::string& bytes) {
    bytes.assign(reinterpret_cast<const char*>(records.data()), records.size_bytes());
}

// Empty where the bytes are no whole records, more than `most`, or one of them is not good. Memory
// is taken after the size was checked.
template <class Record, class Check>
std::optional<std::vector<Record>> readRecords(const std::string& bytes,
                                               std::size_t most,
                                               Check isGood) {
    const std::size_t count = bytes.size() / sizeof(Record);
    if (bytes.size() % sizeof(Record) != 0 || count > most) return std::nullopt;
    std::vector<Record> records(count);
    if (!records.empty()) std::memcpy(records.data(), bytes.data(), bytes.size());
    if (!std::ranges::all_of(records, isGood)) return std::nullopt;
    return records;
}

auto readFood(const std::string& bytes) {
    return readRecords<FoodRecord>(bytes, kMostFood, &FoodRecord::isPossible);
}

// Between two ticks both are needed; where there is nothing, both are empty.
template <class Records>
bool arePaired(const Records& before, const Records& after, float fraction) {
    return before.size() == after.size() || (before.empty() && fraction == 1.0F);
}

bool isShare(float number) {
    return number >= 0.0F && number <= 1.0F;
}

// Unset is never taken for zero.
bool hasAllScalars(const v1::State& message) {
    return message.has_frame() && message.has_tick() && message.has_fraction() &&
           message.has_world_hash() && message.has_food_before() && message.has_food_after() &&
           message.has_time_of_day() && message.layout_version() == kLayoutVersion;
}

std::string textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::vector<std::byte> bytesIn(const std::string& text) {
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

void writeSchool(const SchoolPart& school, v1::SchoolPart& message) {
    message.set_stream(school.stream);
    if (!school.keyframe.empty()) message.set_keyframe(textOf(school.keyframe));
    message.set_first_tick(school.steps.empty() ? 0 : school.steps.front().tick.value);
    for (const SchoolStep& step : school.steps) {
        v1::SchoolStep& written = *message.add_steps();
        if (!step.code.empty()) written.set_code(textOf(step.code));
        if (step.hash) written.set_hash(*step.hash);
    }
}

std::optional<SchoolPart> readSchool(const v1::SchoolPart& message) {
    if (!config::keepsRules(message)) return std::nullopt;
    SchoolPart school{message.stream(), bytesIn(message.keyframe()), {}};
    Tick tick{message.first_tick()};
    for (const v1::SchoolStep& step : message.steps()) {
        school.steps.push_back({tick, bytesIn(step.code()), {}});
        if (step.has_hash()) school.steps.back().hash = step.hash();
        ++tick.value;
    }
    return school;
}

}  // namespace

// A comparison with a number that is none is false: such a place is not there either.
FoodRecord foodRecord(FoodRecord::Kind kind, glm::vec3 offsetMetres, unsigned generation) {
    constexpr float kFarthestUnits = 524287.0F;
    const glm::vec3 units = glm::round(offsetMetres / kFoodUnitMetres);
    const glm::vec3 size = glm::abs(units);
    const bool isThere = kind != FoodRecord::Kind::None && size.x <= kFarthestUnits &&
                         size.y <= kFarthestUnits && size.z <= kFarthestUnits;
    if (!isThere) return {};
    const auto axis = [](float value) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(value)) & 0xFFFFFU;
    };
    return {axis(units.x) | axis(units.y) << 20U | axis(units.z) << 40U |
            static_cast<std::uint64_t>(kind) << 60U | std::uint64_t{generation & 3U} << 62U};
}

Packet encodeState(std::uint64_t session, const StateView& state, const SchoolPart& school) {
    v1::Envelope envelope;
    v1::State& message = *envelope.mutable_state();
    message.set_frame(state.frame.value);
    message.set_tick(state.tick.value);
    message.set_fraction(state.fraction);
    message.set_world_hash(state.worldHash);
    writeEye(state.eye, *message.mutable_eye());
    message.set_layout_version(kLayoutVersion);
    const auto& origin = state.foodOriginMetres;
    for (const float number : {origin.x, origin.y, origin.z}) message.add_food_origin(number);
    writeRecords(state.foodBefore, *message.mutable_food_before());
    writeRecords(state.foodAfter, *message.mutable_food_after());
    message.set_time_of_day(state.timeOfDay);
    assert(state.show != nullptr);
    *message.mutable_show() = *state.show;
    writeSchool(school, *message.mutable_school());
    return encode(session, std::move(envelope));
}

std::optional<CodedState> readState(const v1::State& message) {
    if (!hasAllScalars(message)) return std::nullopt;
    const auto eye = readEye(message.eye());
    auto foodBefore = readFood(message.food_before());
    auto foodAfter = readFood(message.food_after());
    auto school = readSchool(message.school());
    if (!eye || !foodBefore || !foodAfter || !school) return std::nullopt;
    const float fraction = message.fraction();
    const float timeOfDay = message.time_of_day();
    auto show = readShow(message.show());
    const auto& origin = message.food_origin();
    if (!isShare(fraction) || !isShare(timeOfDay) || !show) return std::nullopt;
    if (origin.size() != kPlaceNumbers || !areFinite(origin)) return std::nullopt;
    if (!arePaired(*foodBefore, *foodAfter, fraction)) return std::nullopt;
    return CodedState{.frame = {{.frame = {message.frame()},
                                 .tick = {message.tick()},
                                 .fraction = fraction,
                                 .eye = *eye,
                                 .worldHash = message.world_hash(),
                                 .foodOriginMetres = {origin[0], origin[1], origin[2]},
                                 .foodBefore = std::move(*foodBefore),
                                 .foodAfter = std::move(*foodAfter),
                                 .timeOfDay = timeOfDay,
                                 .show = *std::move(show)},
                                {},
                                {}},
                      .school = *std::move(school)};
}

std::vector<std::byte> encodeSchoolPart(const SchoolPart& school) {
    v1::SchoolPart message;
    writeSchool(school, message);
    return bytesIn(message.SerializeAsString());
}

std::optional<SchoolPart> readSchoolPart(std::span<const std::byte> blob) {
    v1::SchoolPart message;
    if (blob.size() > kMostPacketBytes ||
        !message.ParseFromArray(blob.data(), static_cast<int>(blob.size())))
        return std::nullopt;
    return readSchool(message);
}

}  // namespace aquarama::wire
