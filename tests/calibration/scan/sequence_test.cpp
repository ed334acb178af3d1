// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <filesystem>

#include <gmock/gmock.h>

#include "calibration/scan/pictures.h"

namespace aquarama::scan {
namespace {

using Kind = config::ScanPattern::Kind;

config::Rig rigOf(const std::string& name) {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

std::vector<std::uint64_t> roundsOf(const std::vector<config::ScanPattern>& sequence) {
    std::vector<std::uint64_t> rounds;
    for (const config::ScanPattern& pattern : sequence)
        if (pattern.kind == Kind::PhaseRows && pattern.step == 0) rounds.push_back(pattern.lit);
    return rounds;
}

TEST(SequenceTest, ThreeProjectorsInARowTakeSixtyPictures) {
    const std::vector<config::ScanPattern> sequence = sequenceOf(rigOf("touring"));
    EXPECT_EQ(sequence.size(), 60U);
    EXPECT_THAT(roundsOf(sequence), testing::ElementsAre(0b101U, 0b010U));
}

TEST(SequenceTest, NumbersArePlacesFromOne) {
    const std::vector<config::ScanPattern> sequence = sequenceOf(rigOf("touring"));
    for (std::size_t i = 0; i < sequence.size(); ++i) EXPECT_EQ(sequence[i].number, i + 1);
}

TEST(SequenceTest, EveryChannelIsInOneRound) {
    for (const std::string name : {"touring", "flat_3", "dome_5", "cave_4", "wall_2x2"}) {
        const config::Rig rig = rigOf(name);
        std::uint64_t seen = 0;
        int channels = 0;
        for (const std::uint64_t round : roundsOf(sequenceOf(rig))) {
            seen |= round;
            channels += std::popcount(round);
        }
        EXPECT_EQ(channels, static_cast<int>(rig.channels.size())) << name;
        EXPECT_EQ(std::popcount(seen), channels) << name;
    }
}

TEST(SequenceTest, EachChannelShowsStripesOfBothAxesAtTheEnd) {
    for (const std::string name : {"touring", "flat_3", "dome_5", "cave_4", "wall_2x2"}) {
        const std::vector<config::ScanPattern> sequence = sequenceOf(rigOf(name));
        const std::size_t late = 2 * roundsOf(sequence).size();
        std::uint64_t columns = 0, rows = 0;
        for (std::size_t i = sequence.size() - late; i < sequence.size(); ++i)
            (sequence[i].kind == Kind::GrayColumns ? columns : rows) |= sequence[i].lit;
        EXPECT_EQ(columns, rows) << name;
        EXPECT_EQ(std::popcount(columns), static_cast<int>(rigOf(name).channels.size())) << name;
        EXPECT_EQ(sequence[sequence.size() - late - 1].light, glm::vec3(0)) << name;  // black again
    }
}

}  // namespace
}  // namespace aquarama::scan
