// SPDX-License-Identifier: Apache-2.0
// One envelope of every kind, with something to lose in each field.
#pragma once

#include <vector>

#include "common/wire/envelope.h"

namespace aquarama::wire {

inline std::vector<motion::FishRecord> sampleRecords(std::uint32_t fish) {
    std::vector<motion::FishRecord> records;
    for (std::uint32_t i = 0; i < fish; ++i) {
        const auto n = static_cast<std::int32_t>(i);
        records.push_back({n,
                           -n * 7919,
                           n << 8,
                           i * 2654435761U,
                           ~i >> 2U,
                           static_cast<std::uint16_t>(i * 31),
                           static_cast<std::uint16_t>(i * 57),
                           static_cast<std::uint8_t>(i % motion::kActions),
                           static_cast<std::uint8_t>((i + 3) % motion::kActions),
                           static_cast<std::uint8_t>(i % 8),
                           8,
                           1000 - n * 77});
    }
    return records;
}

inline std::vector<FoodRecord> sampleFood() {
    return {foodRecord(FoodRecord::Kind::Plankton, {1.5F, -2.25F, 60.0F}, 3),
            {},
            foodRecord(FoodRecord::Kind::Pellet, {-63.0F, 0.125F, -1.0F}, 1)};
}

inline StateFrame sampleState(std::uint32_t fish) {
    StateFrame state;
    state.frame = {1U << 20U};
    state.tick = {(std::uint64_t{1} << 40U) + 7};
    state.fraction = 0.25F;
    state.eye = {{1.5F, -2.0F, 30.25F}, {0.5F, 0.5F, -0.5F, 0.5F}};
    state.worldHash = 0xFEDCBA9876543210U;
    state.before = sampleRecords(fish);
    state.after = sampleRecords(fish);
    state.foodOriginMetres = {-3.5F, -6.0F, 0.25F};
    state.foodBefore = sampleFood();
    state.foodAfter = sampleFood();
    state.daylight = 0.75F;
    state.quality = config::QualityTier::Medium;
    return state;
}

inline Welcome sampleWelcome() {
    Welcome welcome;
    welcome.rigText = "name: \"desk\"\n# a comment\n";
    welcome.sceneText = "name: \"reef\"\n";
    welcome.stateAddress = "tcp://127.0.0.1:7401";
    welcome.seed = 4000000000U;
    welcome.pace = Pace::Lockstep;
    welcome.pattern = Pattern::Grey;
    welcome.school = {{7, 230}, {4000000000U, 65535}};
    welcome.cast = {{digestOf("species"), digestOf("repertoire"), 1},
                    {digestOf("other species"), digestOf("other repertoire"), 1}};
    welcome.quality = config::QualityTier::Ultra;
    return welcome;
}

inline std::vector<Envelope> sampleEnvelopes() {
    const auto chunk = std::vector<std::byte>(100, std::byte{0xA5});
    StatusReply reply;
    reply.pace = Pace::Lockstep;
    reply.paused = true;
    reply.frame = {99};
    reply.tick = {98};
    reply.frameMedianMs = 16.5F;
    reply.skewP99Ms = 0.75F;
    reply.refusedPackets = 3;
    reply.eye = {{1, -6, 2.5F}, {0.5F, 0.5F, 0.5F, -0.5F}};
    reply.speedMetresPerSecond = 0.375F;
    reply.pilot = "middle";
    reply.nodes = {{"left", NodeCondition::Late, 4, 1}, {"right", NodeCondition::Absent, 0, 2}};
    std::vector<Message> messages = {Hello{"left", 3, "0.1.0"},
                                     Refusal{"no"},
                                     sampleWelcome(),
                                     BlobRequest{digestOf("x"), 1U << 18U},
                                     BlobChunk{digestOf("x"), 50, 200, chunk},
                                     Prepared{config::QualityTier::High},
                                     Joined{{65}},
                                     sampleState(5),
                                     Beacon{},
                                     Ready{{12}, ReleaseReport{{11}, -5}},
                                     Ready{{13}, {}},
                                     Present{{12}, 123456789012345},
                                     Dismissed{"silent"},
                                     Farewell{},
                                     Ping{-1},
                                     Pong{-1, 77},
                                     Input{InputKind::TogglePause, {}, {}},
                                     Input{InputKind::DropFood, {0.5F, -6.25F, -2.5F}, {}},
                                     Input{InputKind::Steer, {}, {127, -127, 0, 1, -64}},
                                     StatusRequest{},
                                     reply,
                                     ExplainRequest{59},
                                     Explanation{59, 60, {7200}, {"59  bigeye_scad", "", "~"}}};
    std::vector<Envelope> envelopes;
    for (Message& message : messages) envelopes.push_back({0x0123456789ABCDEFU, message});
    return envelopes;
}

}  // namespace aquarama::wire
