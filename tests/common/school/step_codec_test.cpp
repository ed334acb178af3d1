// SPDX-License-Identifier: Apache-2.0
// The code of steps: whatever is commanded comes back, and no bytes do harm.
#include "common/school/step_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "common/school/keyframe.h"

namespace aquarama::school {
namespace {

constexpr std::size_t kFish = 37;  // not a multiple of eight

// Any command that a motor can play, on a level or not.
void command(motion::MotorCommands& commands, std::size_t fish, std::mt19937& random) {
    const auto drawn = [&](int least, int most) {
        return std::uniform_int_distribution(least, most)(random);
    };
    constexpr int kMost = std::numeric_limits<std::int16_t>::max();
    commands.action[fish] = static_cast<std::uint8_t>(drawn(0, motion::kActions - 1));
    commands.phaseRate[fish] = static_cast<std::int16_t>(drawn(0, kMost));
    commands.brake[fish] = static_cast<std::uint8_t>(drawn(0, 255));
    commands.mouth[fish] = static_cast<std::uint8_t>(drawn(0, 255));
    commands.gaze[fish] = static_cast<std::uint8_t>(drawn(0, 255));
    commands.pitch[fish] = static_cast<std::int16_t>(drawn(0, 1) != 0 ? 1024 * drawn(-31, 31)
                                                                      : drawn(-kMost - 1, kMost));
    commands.yawRate[fish] = static_cast<std::int16_t>(drawn(-kMost - 1, kMost));
}

std::vector<RecordedRates> rates() {
    std::vector<RecordedRates> rates{{0, 20, {}}, {20, 20, {}}, {20, kFish, {}}};
    for (RecordedRates& kind : rates)
        for (std::size_t action = 0; action < kind.phaseRate.size(); ++action)
            kind.phaseRate[action] = static_cast<std::int16_t>(300 + 7 * action + kind.first);
    rates.front().phaseRate[3] = 0;
    rates.back().phaseRate[4] = std::numeric_limits<std::int16_t>::max();
    return rates;
}

motion::MotorCommands atRest() {
    motion::MotorCommands commands;
    commands.resize(kFish);
    return commands;
}

bool areSame(const motion::MotorCommands& a, const motion::MotorCommands& b) {
    return a.action == b.action && a.phaseRate == b.phaseRate && a.brake == b.brake &&
           a.mouth == b.mouth && a.gaze == b.gaze && a.pitch == b.pitch && a.yawRate == b.yawRate;
}

PlacedFish placedAt(std::uint32_t fish) {
    PlacedFish placed{fish, {}};
    placed.record.x = -123456789;
    placed.record.y = static_cast<std::int32_t>(fish);
    placed.record.skin = 77;
    return placed;
}

TEST(StepCodec, bringsBackWhateverIsCommanded) {
    for (const bool hasRates : {true, false}) {
        std::mt19937 random(7);
        StepMemory sender =
            makeStepMemory(hasRates ? rates() : std::vector<RecordedRates>{}, kFish);
        StepMemory receiver = sender;
        motion::MotorCommands wanted = atRest();
        motion::MotorCommands sent = wanted;
        motion::MotorCommands received = wanted;
        for (std::uint64_t tick = 1; tick < 600; ++tick) {
            for (std::size_t fish = 0; fish < kFish; ++fish)
                if (random() % 5 == 0) command(wanted, fish, random);
            std::vector<PlacedFish> placed;
            for (std::uint32_t fish = 0; tick % 50 == 0 && fish < tick % kFish; ++fish)
                placed.push_back(placedAt(fish));
            const auto code = encodeStep({tick}, wanted, placed, sent, sender);
            const auto back = decodeStep({tick}, code, received, receiver);
            ASSERT_TRUE(back) << tick;
            ASSERT_TRUE(areSame(received, wanted)) << tick;
            ASSERT_TRUE(areSame(sent, wanted)) << tick;
            ASSERT_EQ(back->size(), placed.size());
            for (std::size_t i = 0; i < placed.size(); ++i) {
                EXPECT_EQ((*back)[i].fish, placed[i].fish);
                EXPECT_EQ((*back)[i].record, placed[i].record);
            }
        }
    }
}

// More than 254 placed fish are counted apart.
TEST(StepCodec, aWholeSchoolMayBePlaced) {
    constexpr std::uint32_t kMany = 1000;
    StepMemory sender = makeStepMemory({}, kMany);
    StepMemory receiver = sender;
    motion::MotorCommands commands;
    commands.resize(kMany);
    motion::MotorCommands received = commands;
    std::vector<PlacedFish> placed;
    for (std::uint32_t fish = 0; fish < kMany; ++fish) placed.push_back(placedAt(fish));
    const motion::MotorCommands wanted = commands;
    const auto code = encodeStep({1}, wanted, placed, commands, sender);
    const auto back = decodeStep({1}, code, received, receiver);
    ASSERT_TRUE(back);
    ASSERT_EQ(back->size(), kMany);
    EXPECT_EQ(back->back().record, placed.back().record);
}

// A school that does nothing new costs nothing: its models learn that.
TEST(StepCodec, whatStaysTheSameCostsAlmostNothing) {
    constexpr std::size_t kMany = 400;
    StepMemory memory = makeStepMemory({}, kMany);
    motion::MotorCommands known;
    known.resize(kMany);
    const motion::MotorCommands same = known;
    std::size_t bytes = 0;
    for (std::uint64_t tick = 1; tick <= 600; ++tick) {
        const std::size_t size = encodeStep({tick}, same, {}, known, memory).size();
        if (tick > 300) bytes += size;
    }
    EXPECT_LT(static_cast<double>(8 * bytes) / (300 * kMany), 0.05) << "bits a fish and tick";
}

// A model that goes on learning pays for it: a fiftieth at even odds, a fifth where one bit of a
// hundred is a surprise.
TEST(RangeCoder, comesNearTheEntropy) {
    for (const auto& [ones, cost] :
         {std::pair{0.5, 1.02}, {0.2, 1.03}, {0.05, 1.08}, {0.01, 1.2}}) {
        std::mt19937 random(11);
        std::bernoulli_distribution bit(ones);
        BitModel model = kEven;
        RangeEncoder encoder;
        constexpr int kBits = 200'000;
        for (int i = 0; i < kBits; ++i) encoder.bit(model, bit(random));
        const double entropy = -ones * std::log2(ones) - (1 - ones) * std::log2(1 - ones);
        const double used = 8.0 * static_cast<double>(encoder.finish().size()) / kBits;
        EXPECT_GT(used, 0.97 * entropy) << ones;
        EXPECT_LT(used, cost * entropy) << ones;
    }
}

// Whatever is in the bytes: it ends, and what it yields can be played.
TEST(StepCodec, anyBytesEnd) {
    std::mt19937 random(13);
    for (int i = 0; i < 20'000; ++i) {
        std::vector<std::byte> bytes(random() % 60);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
        StepMemory memory = makeStepMemory(rates(), kFish);
        motion::MotorCommands commands = atRest();
        const auto placed = decodeStep({random()}, bytes, commands, memory);
        if (!placed) continue;
        EXPECT_LE(placed->size(), kFish);
        for (const std::uint8_t action : commands.action) ASSERT_LT(action, motion::kActions);
        for (const std::int16_t rate : commands.phaseRate) ASSERT_GE(rate, 0);
        for (const PlacedFish& one : *placed) {
            ASSERT_LT(one.fish, kFish);
            ASSERT_TRUE(motion::isPlayable(one.record));
        }
    }
}

class KeyframeOfFish : public testing::Test {
  protected:
    KeyframeOfFish() {
        std::mt19937 random(17);
        for (std::size_t fish = 0; fish < kFish; ++fish) {
            command(commands_, fish, random);
            records_.push_back(placedAt(static_cast<std::uint32_t>(fish)).record);
        }
        memory_.lastChanges[3] = 9;
        memory_.recentlyChanged[4] = 3;
        bytes_ = encodeKeyframe({99}, records_, commands_, memory_);
    }
    std::vector<motion::FishRecord> records_;
    motion::MotorCommands commands_ = atRest();
    StepMemory memory_ = makeStepMemory(rates(), kFish);
    std::vector<std::byte> bytes_;
};

TEST_F(KeyframeOfFish, bringsBackAll) {
    const auto back = decodeKeyframe(bytes_, kFish);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->school.tick, Tick{99});
    std::vector<motion::FishRecord> records;
    back->school.records(records);
    EXPECT_EQ(records, records_);
    EXPECT_TRUE(areSame(back->school.commands, commands_));
    EXPECT_EQ(encodeKeyframe({99}, records, back->school.commands, back->memory), bytes_);
}

TEST_F(KeyframeOfFish, isRefusedCutOrOfOtherFish) {
    EXPECT_FALSE(decodeKeyframe(bytes_, kFish + 1));
    for (std::size_t size = 0; size < bytes_.size(); size += 1 + size / 9)
        EXPECT_FALSE(decodeKeyframe(std::span{bytes_}.first(size), kFish)) << size;
    bytes_.push_back({});
    EXPECT_FALSE(decodeKeyframe(bytes_, kFish));
}

TEST_F(KeyframeOfFish, isRefusedWhereAFishCannotBePlayed) {
    const auto isRefused = [&](auto alter) {
        auto records = records_;
        auto commands = commands_;
        alter(records, commands);
        return !decodeKeyframe(encodeKeyframe({99}, records, commands, memory_), kFish);
    };
    EXPECT_FALSE(isRefused([](auto&, auto&) {}));
    EXPECT_TRUE(isRefused([](auto& fish, auto&) { fish[3].segment = motion::kSegments; }));
    EXPECT_TRUE(isRefused([](auto& fish, auto&) { fish[0].fromSegment = motion::kSegments; }));
    EXPECT_TRUE(isRefused([](auto& fish, auto&) { fish[1].warpFrame = 9; }));
    EXPECT_TRUE(isRefused([](auto&, auto& to) { to.action[2] = motion::kActions; }));
    EXPECT_TRUE(isRefused([](auto&, auto& to) { to.phaseRate[2] = -1; }));
}

// With any byte altered it is refused, or yields what can be played and followed.
TEST_F(KeyframeOfFish, alteredIsRefusedOrSound) {
    std::mt19937 random(19);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        auto bytes = bytes_;
        // Half of them behind the models, which are most of it.
        const std::size_t tail = kFish * 52;
        const std::size_t at =
            i % 2 == 0 ? bytes.size() - 1 - random() % tail : random() % bytes.size();
        bytes[at] = static_cast<std::byte>(random());
        auto back = decodeKeyframe(bytes, kFish);
        if (!back) {
            ++refused;
            continue;
        }
        std::vector<motion::FishRecord> records;
        back->school.records(records);
        ASSERT_TRUE(std::ranges::all_of(records, motion::isPlayable));
        const std::vector<std::byte> step(20, std::byte{0x5A});
        (void)decodeStep({100}, step, back->school.commands, back->memory);
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace aquarama::school
