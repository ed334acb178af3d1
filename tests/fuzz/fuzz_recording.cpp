// SPDX-License-Identifier: Apache-2.0
#include <span>

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

}  // namespace

// What is read is bounded and in order, and can be written and read again.
int fuzzRecording(const std::uint8_t* bytes, std::size_t size) {
    try {
        const wire::Recording recording =
            wire::decodeRecording(std::as_bytes(std::span(bytes, size)), "fuzzed");
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
    return 0;
}

}  // namespace aquarama
