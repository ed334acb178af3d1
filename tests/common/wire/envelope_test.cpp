// SPDX-License-Identifier: Apache-2.0
#include "common/wire/envelope.h"

#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/common/wire/sample_envelopes.h"
#include "tests/support/count_memory.h"

namespace aquarama::wire {
namespace {

// decode(packet) and the memory that it took on the way.
std::size_t memoryToDecode(std::span<const std::byte> packet) {
    const std::size_t before = test::bytesTaken;
    const auto ignored = decode(packet);
    return test::bytesTaken - before;
}

std::string nameOf(const Envelope& envelope) {
    return "message kind " + std::to_string(envelope.message.index());
}

TEST(Envelope, everyKindComesBackToTheBit) {
    for (const Envelope& envelope : sampleEnvelopes()) {
        const Packet packet = encode(envelope);
        const auto decoded = decode(packet);
        ASSERT_TRUE(decoded) << nameOf(envelope);
        EXPECT_EQ(decoded->session, envelope.session);
        EXPECT_EQ(decoded->message.index(), envelope.message.index());
        EXPECT_EQ(encode(*decoded), packet) << nameOf(envelope);
    }
}

TEST(Envelope, aWelcomeKeepsItsFields) {
    const Welcome sent = sampleWelcome();
    const auto decoded = decode(encode({1, sent}));
    ASSERT_TRUE(decoded);
    const auto& welcome = std::get<Welcome>(decoded->message);
    EXPECT_EQ(welcome.rigText, sent.rigText);
    EXPECT_EQ(welcome.sceneText, sent.sceneText);
    EXPECT_EQ(welcome.stateAddress, sent.stateAddress);
    EXPECT_EQ(welcome.seed, sent.seed);
    EXPECT_EQ(welcome.pace, Pace::Lockstep);
    EXPECT_EQ(welcome.pattern, Pattern::Grey);
    ASSERT_EQ(welcome.cast.size(), 2U);
    EXPECT_EQ(welcome.cast[1].repertoire, sent.cast[1].repertoire);
    EXPECT_EQ(welcome.cast[1].fish, 1U);
    ASSERT_EQ(welcome.school.size(), 2U);
    EXPECT_EQ(welcome.school[1].id, 4000000000U);
    EXPECT_EQ(welcome.school[1].lengthMillimetres, 65535);
}

TEST(Envelope, aStateKeepsEveryBitOfEveryFish) {
    const StateFrame sent = sampleState(1000);
    const auto decoded = decode(encodeState(9, sent));
    ASSERT_TRUE(decoded);
    const auto& state = std::get<StateFrame>(decoded->message);
    EXPECT_EQ(state.before, sent.before);
    EXPECT_EQ(state.after, sent.after);
    EXPECT_EQ(state.frame, sent.frame);
    EXPECT_EQ(state.tick, sent.tick);
    EXPECT_EQ(state.fraction, sent.fraction);
    EXPECT_EQ(state.worldHash, sent.worldHash);
    EXPECT_EQ(state.eye.positionMetres, sent.eye.positionMetres);
    EXPECT_EQ(state.eye.worldFromWall, sent.eye.worldFromWall);
    EXPECT_EQ(state.foodOriginMetres, sent.foodOriginMetres);
    EXPECT_EQ(state.foodBefore, sent.foodBefore);
    EXPECT_EQ(state.foodAfter, sent.foodAfter);
    EXPECT_EQ(state.daylight, sent.daylight);
    EXPECT_EQ(state.quality, sent.quality);
}

// An empty sea between two ticks, and a school before any food has come.
TEST(Envelope, aStateWithoutFishOrFoodIsAState) {
    StateFrame state = sampleState(0);
    EXPECT_TRUE(decode(encodeState(1, state)));
    state.foodBefore.clear();
    state.foodAfter.clear();
    EXPECT_TRUE(decode(encodeState(1, state)));
}

TEST(FoodRecord, keepsAParticleToATenthOfAMillimetre) {
    for (const glm::vec3 place : {glm::vec3(0), glm::vec3(63.99F, -63.99F, 0.001F)}) {
        const FoodRecord record = foodRecord(FoodRecord::Kind::Pellet, place, 7);
        EXPECT_LT(glm::distance(record.offsetMetres(), place), 1e-4F);
        EXPECT_EQ(record.kind(), FoodRecord::Kind::Pellet);
        EXPECT_EQ(record.generation(), 3U);
        EXPECT_TRUE(record.isPossible());
    }
}

TEST(FoodRecord, whatIsOutOfReachIsNotThere) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3 place :
         {glm::vec3(65, 0, 0), glm::vec3(0, -1e30F, 0), glm::vec3(0, 0, nan)})
        EXPECT_EQ(foodRecord(FoodRecord::Kind::Plankton, place, 1), FoodRecord{});
    EXPECT_EQ(foodRecord(FoodRecord::Kind::None, {1, 2, 3}, 1), FoodRecord{});
}

TEST(Envelope, aFishCostsItsRecordAndLittleMore) {
    StateFrame state = sampleState(1000);
    state.before.clear();
    state.fraction = 1.0F;
    EXPECT_LT(encodeState(9, state).size(), 1000 * sizeof(motion::FishRecord) + 200);
}

TEST(Envelope, noPrefixOfAnEnvelopeIsAnEnvelope) {
    for (const Envelope& envelope : sampleEnvelopes()) {
        const Packet packet = encode(envelope);
        for (std::size_t size = 0; size < packet.size(); ++size) {
            EXPECT_FALSE(decode(std::span{packet}.first(size))) << nameOf(envelope) << " " << size;
        }
    }
}

TEST(Envelope, alteredBytesNeitherCrashNorCostMemory) {
    std::mt19937 random(20);
    for (const Envelope& envelope : sampleEnvelopes()) {
        const Packet packet = encode(envelope);
        for (int trial = 0; trial < 3000; ++trial) {
            Packet altered = packet;
            for (unsigned change = random() % 4 + 1; change > 0; --change) {
                altered[random() % altered.size()] = static_cast<std::byte>(random());
            }
            ASSERT_LT(memoryToDecode(altered), 64 * altered.size() + 4096) << nameOf(envelope);
        }
    }
}

TEST(Envelope, noiseIsRefused) {
    std::mt19937 random(21);
    int accepted = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Packet noise(random() % 200);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        accepted += decode(noise) ? 1 : 0;
    }
    EXPECT_EQ(accepted, 0);
}

TEST(Envelope, aLargePacketOfTinyObjectsIsRefusedUnread) {
    // session, then a status reply that holds a million empty nodes: two bytes each on the wire, an
    // object each in memory.
    Packet packet = encode({1, StatusRequest{}});
    packet.resize(9);
    const std::size_t nodes = 1'000'000;
    for (const unsigned byte : {0x92U, 0x01U}) packet.push_back(static_cast<std::byte>(byte));
    for (std::size_t size = 2 * nodes; size > 0; size >>= 7U) {
        packet.push_back(static_cast<std::byte>((size & 0x7FU) | (size > 0x7FU ? 0x80U : 0U)));
    }
    for (std::size_t i = 0; i < nodes; ++i) {
        packet.push_back(std::byte{0x52});
        packet.push_back(std::byte{0});
    }
    EXPECT_LT(memoryToDecode(packet), 4096U);
    EXPECT_FALSE(decode(packet));
}

// Each way in which a state can be well-formed protobuf and still lie.
TEST(Envelope, aStateThatLiesIsRefused) {
    const auto refused = [](auto alter) {
        StateFrame state = sampleState(4);
        alter(state);
        return !decode(encodeState(1, state));
    };
    const auto nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(refused([](StateFrame&) {}));
    EXPECT_TRUE(refused([](StateFrame& s) { s.before.pop_back(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.before.clear(); }));  // but the fraction is not 1
    EXPECT_TRUE(refused([](StateFrame& s) { s.fraction = 1.01F; }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.fraction = nan; }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.eye.positionMetres.y = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.after[3].segment = motion::kActions; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.before[0].fromSegment = 255; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.after[1].warpFrame = 9; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodBefore.pop_back(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodBefore.clear(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodAfter[0].bits |= 3ULL << 60U; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodAfter[1].bits = 5; }));  // nothing, somewhere
    EXPECT_TRUE(refused([&](StateFrame& s) { s.foodOriginMetres.z = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.daylight = -0.01F; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.quality = static_cast<config::QualityTier>(4); }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.daylight = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) {
        s.foodBefore.resize(kMostFood + 1);
        s.foodAfter.resize(kMostFood + 1);
    }));
}

// What a node sends may come from a broken one.
TEST(Envelope, foodIsDroppedAtAPlaceOrNotAtAll) {
    const auto accepted = [](glm::vec3 place) {
        return decode(encode({1, Input{InputKind::DropFood, place, {}}})).has_value();
    };
    EXPECT_TRUE(accepted({0, -6, -kMostInputMetres}));
    EXPECT_FALSE(accepted({0, -6, -2 * kMostInputMetres}));
    EXPECT_FALSE(accepted({std::numeric_limits<float>::quiet_NaN(), -6, 0}));
    EXPECT_FALSE(accepted({0, std::numeric_limits<float>::infinity(), 0}));
}

TEST(Envelope, aSteeringIsOfSharesNoneBeyondFull) {
    const Input held{InputKind::Steer, {}, {kFullSteering, -kFullSteering, 3, -1, 0}};
    const auto decoded = decode(encode({1, held}));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(std::get<Input>(decoded->message).steering, held.steering);
    EXPECT_FALSE(decode(encode({1, Input{InputKind::Steer, {}, {-128, 0, 0, 0, 0}}})));
}

// A node splits the school by the cast: both must have the same fish.
TEST(Envelope, aCastOfMoreOrFewerFishThanTheSchoolIsRefused) {
    const auto accepted = [](std::uint32_t fish) {
        Welcome welcome = sampleWelcome();
        welcome.cast.back().fish = fish;
        return decode(encode({1, welcome})).has_value();
    };
    EXPECT_TRUE(accepted(1));
    EXPECT_FALSE(accepted(0));
    EXPECT_FALSE(accepted(2));
    EXPECT_FALSE(accepted(0xFFFFFFFFU));
}

TEST(Envelope, namesAreBoundedAndPrintable) {
    const auto accepted = [](const std::string& name) {
        return decode(encode({0, Hello{name, kProtocolMajor, ""}})).has_value();
    };
    EXPECT_TRUE(accepted(std::string(kMostNameBytes, 'n')));
    EXPECT_FALSE(accepted(std::string(kMostNameBytes + 1, 'n')));
    EXPECT_FALSE(accepted(""));
    EXPECT_FALSE(accepted("left\nmaster: all is well"));
}

// What a master says of a mind is drawn over the picture and printed in terminals.
TEST(Envelope, anExplanationIsBoundedAndPrintable) {
    const auto accepted = [](std::size_t lines, const std::string& line, std::uint32_t school) {
        const std::vector<std::string> all(lines, line);
        return decode(encode({1, Explanation{0, school, {}, all}})).has_value();
    };
    EXPECT_TRUE(accepted(kMostExplanationLines, std::string(kMostExplanationLineBytes, '~'), 1));
    EXPECT_FALSE(accepted(kMostExplanationLines + 1, "", 1));
    EXPECT_FALSE(accepted(1, std::string(kMostExplanationLineBytes + 1, ' '), 1));
    EXPECT_FALSE(accepted(1, "\x1b[2J", 1));
    EXPECT_FALSE(accepted(1, "\xc3\xa9", 1));
    EXPECT_FALSE(accepted(1, "", kMostFish + 1));
}

TEST(Envelope, aChunkStaysInsideItsBlob) {
    const auto accepted = [](std::uint64_t offset, std::uint64_t total, std::size_t size) {
        return decode(encode({1, BlobChunk{{}, offset, total, Packet(size)}})).has_value();
    };
    EXPECT_TRUE(accepted(0, kBlobChunkBytes, kBlobChunkBytes));
    EXPECT_FALSE(accepted(1, kBlobChunkBytes, kBlobChunkBytes));
    EXPECT_FALSE(accepted(0, kMostBlobBytes, kBlobChunkBytes + 1));
    EXPECT_FALSE(accepted(0, kMostBlobBytes + 1, 1));
    EXPECT_FALSE(accepted(std::numeric_limits<std::uint64_t>::max(), 2, 1));
}

TEST(Envelope, aHelloOfAnotherMajorVersionIsReadSoThatItCanBeAnswered) {
    const auto decoded = decode(encode({0, Hello{"left", kProtocolMajor + 1, "9.0"}}));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(std::get<Hello>(decoded->message).major, kProtocolMajor + 1);
}

}  // namespace
}  // namespace aquarama::wire
