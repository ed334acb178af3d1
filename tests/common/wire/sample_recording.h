// SPDX-License-Identifier: Apache-2.0
// A recording with something to lose in each entry.
#pragma once

#include <cstddef>
#include <vector>

#include "common/wire/recording.h"

namespace aquarama::wire {

inline AssetBundle sampleAssets() {
    const std::vector<std::byte> repertoire(300, std::byte{0x5A});
    return {4000000000U,
            "scene.txtpb",
            "name: \"reef\"\n",
            {{"config/species/scad.txtpb", "name: \"scad\"", repertoire, 51},
             {"tang.txtpb", "", {}, 0}}};
}

inline std::vector<std::byte> sampleState() {
    return std::vector<std::byte>(70, std::byte{0xA5});
}

// Its entries one by one, the header and the species first.
inline std::vector<Packet> sampleEntries() {
    return {beginningOf(sampleAssets()),
            entryOf(RecordedHash{{0}, 0xFEDCBA9876543210U}),
            entryOf(RecordedInput{{17}, RecordedFood{{1.5F, -2.0F, 30.25F}, 12}}),
            entryOf(RecordedInput{{17}, Steering{127, -127, 0, 5, -1}}),
            entryOf(RecordedInput{{17}, RecordedSubmarine{{0, -6, 0}, {0.5F, 0, -0.25F}}}),
            entryOf(RecordedInput{{18}, RecordedClock{0.75, 43'200}}),
            entryOf(RecordedInput{{18}, WallHands{{7, {0.5F, 0, -3}}, {8, {-2.5F, 1, -2}}}}),
            entryOf(RecordedInput{{19}, RecordedDrawing{40, 7, digestOf("png"), -1}}),
            entryOf(RecordedInput{{19}, RecordedDeparture{40}}),
            entryOf(RecordedInput{{20}, RecordedDay{0.85, 40}}),
            entryOf(RecordedInput{{21}, RecordedDay{std::nullopt, 0}}),
            entryOf(RecordedInput{{22}, RecordedRelease{1}}),
            entryOf(RecordedHash{{600}, 1}),
            entryOf(Tick{600}, sampleState()),
            entryOf(RecordedMoment{{660}, 123'456'789'000, "a boot", 1'795'000'000}),
            endOf({{(std::uint64_t{1} << 31U) + 7}, 2})};
}

inline Packet joined(const std::vector<Packet>& entries) {
    Packet file;
    for (const Packet& entry : entries) file.insert(file.end(), entry.begin(), entry.end());
    return file;
}

}  // namespace aquarama::wire
