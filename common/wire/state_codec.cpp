// SPDX-License-Identifier: Apache-2.0
#include "common/wire/state_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "common/wire/aquarama.pb.h"
#include "common/wire/envelope.h"

namespace aquarama {
namespace {

// The records are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kLayoutVersion = 2;
constexpr std::size_t kStride = sizeof(FishRecord);
constexpr int kEyeNumbers = 7;

void writeRecords(const std::vector<FishRecord>& records, std::string& bytes) {
    bytes.resize(records.size() * kStride);
    if (!records.empty()) std::memcpy(bytes.data(), records.data(), bytes.size());
}

std::optional<std::vector<FishRecord>> readRecords(const std::string& bytes) {
    if (bytes.size() % kStride != 0 || bytes.size() / kStride > kMaxFish) return std::nullopt;
    std::vector<FishRecord> records(bytes.size() / kStride);
    if (!records.empty()) std::memcpy(records.data(), bytes.data(), bytes.size());
    if (!std::ranges::all_of(records, isPlayable)) return std::nullopt;
    return records;
}

std::optional<Eye> readEye(const v1::State& message) {
    if (message.eye_size() != kEyeNumbers) return std::nullopt;
    const auto& e = message.eye();
    if (!std::ranges::all_of(e, [](float number) { return std::isfinite(number); })) {
        return std::nullopt;
    }
    return Eye{{e[0], e[1], e[2]}, {e[3], e[4], e[5], e[6]}};
}

bool hasAllScalars(const v1::State& message) {
    return message.has_frame() && message.has_tick() && message.has_fraction() &&
           message.has_world_hash() && message.has_before() && message.has_after() &&
           message.layout_version() == kLayoutVersion && message.stride() == kStride;
}

}  // namespace

void writeState(const StateFrame& state, v1::State& message) {
    message.set_frame(state.frame.value);
    message.set_tick(state.tick.value);
    message.set_fraction(state.fraction);
    message.set_world_hash(state.worldHash);
    const auto& position = state.eye.positionMetres;
    const auto& rotation = state.eye.worldFromWall;
    for (const float number : {position.x, position.y, position.z}) message.add_eye(number);
    for (const float number : {rotation.w, rotation.x, rotation.y, rotation.z}) {
        message.add_eye(number);
    }
    message.set_layout_version(kLayoutVersion);
    message.set_stride(kStride);
    writeRecords(state.before, *message.mutable_before());
    writeRecords(state.after, *message.mutable_after());
}

std::optional<StateFrame> readState(const v1::State& message) {
    if (!hasAllScalars(message)) return std::nullopt;
    const auto eye = readEye(message);
    auto before = readRecords(message.before());
    auto after = readRecords(message.after());
    if (!eye || !before || !after) return std::nullopt;
    const float fraction = message.fraction();
    const bool showsTheTick = before->empty();
    if (!(fraction >= 0.0F && fraction <= 1.0F)) return std::nullopt;
    if (showsTheTick ? fraction != 1.0F : before->size() != after->size()) return std::nullopt;
    return StateFrame{{message.frame()},
                      {message.tick()},
                      fraction,
                      *eye,
                      message.world_hash(),
                      std::move(*before),
                      std::move(*after)};
}

}  // namespace aquarama
