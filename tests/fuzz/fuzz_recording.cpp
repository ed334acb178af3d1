// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <span>

#include <zlib.h>

#include "common/base/log.h"
#include "common/wire/recording.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {
namespace {

// What happened, written once more.
wire::Packet inputsOf(const wire::Recording& recording) {
    wire::Packet bytes;
    for (const wire::RecordedInput& input : recording.inputs) {
        const wire::Packet entry = wire::entryOf(input);
        bytes.insert(bytes.end(), entry.begin(), entry.end());
    }
    return bytes;
}

// The bytes with the checksum of each entry set right, so that what is in the entries is read.
wire::Packet stamped(wire::Packet bytes) {
    constexpr std::size_t kChecksumBytes = 5;
    std::size_t at = 0;
    while (at < bytes.size()) {
        std::size_t length = 0;
        for (unsigned shift = 0; at < bytes.size() && shift < 35; shift += 7) {
            const auto byte = std::to_integer<std::size_t>(bytes[at++]);
            length |= (byte & 0x7FU) << shift;
            if (byte < 0x80) break;
        }
        if (length < kChecksumBytes || length > bytes.size() - at) break;
        const std::size_t body = length - kChecksumBytes;
        const auto checksum = static_cast<std::uint32_t>(
            crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + at), body));
        bytes[at + body] = std::byte{15U << 3U | 5U};
        std::memcpy(bytes.data() + at + body + 1, &checksum, sizeof checksum);
        at += length;
    }
    return bytes;
}

void read(const wire::Packet& bytes);

}  // namespace

// What is read is bounded and in order, and can be written and read again.
int fuzzRecording(const std::uint8_t* bytes, std::size_t size) {
    const auto given = std::as_bytes(std::span(bytes, size));
    const wire::Packet packet(given.begin(), given.end());
    read(packet);
    read(stamped(packet));
    return 0;
}

namespace {

void read(const wire::Packet& bytes) {
    try {
        const wire::Recording recording = wire::decodeRecording(bytes, "fuzzed");
        std::size_t fish = 0;
        for (const wire::SpeciesAssets& species : recording.assets.cast) fish += species.fish;
        promise(fish <= kMostFish, "the fish of a recording are bounded");
        for (const wire::RecordedInput& input : recording.inputs)
            promise(input.tick <= recording.lastTick(), "nothing comes after the last tick");
        wire::Packet again = wire::beginningOf(recording.assets);
        const wire::Packet events = inputsOf(recording);
        again.insert(again.end(), events.begin(), events.end());
        promise(inputsOf(wire::decodeRecording(again, "again")) == events,
                "what was read can be written and read");
    } catch (const Error& error) {
        promise(*error.what() != '\0', "an error says what is wrong");
    }
}

}  // namespace

}  // namespace aquarama
