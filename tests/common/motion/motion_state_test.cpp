// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motion_state.h"

#include <cmath>
#include <cstddef>
#include <random>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "common/motion/gaze.h"

namespace aquarama::motion {
namespace {

glm::quat randomRotation(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(
        glm::quat(normal(random), normal(random), normal(random), normal(random)));
}

// Angle between two rotations; the sine keeps its precision near zero.
float angleBetween(const glm::quat& a, const glm::quat& b) {
    const glm::quat d = glm::conjugate(a) * b;
    return 2 * std::asin(std::min(1.0F, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

MotionStates randomStates(std::size_t fish, unsigned seed) {
    std::mt19937 random(seed);
    MotionStates states;
    states.resize(fish);
    for (std::size_t i = 0; i < fish; ++i) {
        setBodyFrame(states, i, {glm::vec3(0), randomRotation(random)});
        states.x[i] = static_cast<std::int32_t>(random());
        states.y[i] = static_cast<std::int32_t>(random());
        states.z[i] = static_cast<std::int32_t>(random());
        states.phase[i] = static_cast<std::uint16_t>(random());
        states.fromPhase[i] = static_cast<std::uint16_t>(random());
        states.speed[i] =
            static_cast<std::int32_t>(random() % (2U * kFastestUnits)) - kFastestUnits;
        states.segment[i] = static_cast<std::uint8_t>(random() % kSegments);
        states.fromSegment[i] = static_cast<std::uint8_t>(random() % kSegments);
        states.warpLength[i] = static_cast<std::uint8_t>(random());
        states.warpFrame[i] = static_cast<std::uint8_t>(random() % (states.warpLength[i] + 1U));
        states.spread[i] = static_cast<std::uint8_t>(random());
        states.mouth[i] = static_cast<std::uint8_t>(random());
        states.gaze[i] = static_cast<std::uint8_t>(random());
    }
    return states;
}

TEST(MotionState, aRecordHoldsEveryBit) {
    const MotionStates states = randomStates(5000, 1);
    MotionStates copy;
    copy.resize(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const FishRecord record = recordOf(states, i);
        EXPECT_TRUE(isPlayable(record));
        setFromRecord(copy, i, record);
        EXPECT_EQ(recordOf(copy, i), record);
    }
    EXPECT_EQ(hashOf(copy), hashOf(states));
    std::vector<FishRecord> records;
    for (std::size_t i = 0; i < states.size(); ++i) records.push_back(recordOf(states, i));
    EXPECT_EQ(hashOf(records), hashOf(states));
}

TEST(MotionState, anOrientationSurvivesToAFewMillionthsOfARadian) {
    std::mt19937 random(2);
    MotionStates states;
    states.resize(1);
    float worst = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const glm::quat rotation = randomRotation(random);
        setBodyFrame(states, 0, {glm::vec3(0), rotation});
        worst = std::max(worst, angleBetween(bodyFrameOf(states, 0).rotation, rotation));
    }
    // Half a unit of 2^-19 / sqrt 2 in each of three components, doubled where the largest
    // component makes up for them.
    EXPECT_LT(worst, 4 * 1.35e-6F);
}

TEST(MotionState, theLargestComponentIsLeftOutInEveryDirection) {
    MotionStates states;
    states.resize(1);
    const float half = std::sqrt(0.5F);
    for (const glm::quat& rotation : {glm::quat(1, 0, 0, 0),
                                      glm::quat(0, 1, 0, 0),
                                      glm::quat(0, 0, 1, 0),
                                      glm::quat(0, 0, 0, -1),
                                      glm::quat(half, half, 0, 0),
                                      glm::quat(half, 0, -half, 0),
                                      glm::quat(0, 0, -half, half),
                                      glm::quat(0.5F, -0.5F, 0.5F, -0.5F)}) {
        setBodyFrame(states, 0, {glm::vec3(0), rotation});
        const FishRecord record = recordOf(states, 0);
        EXPECT_LT(angleBetween(bodyFrameOf(record).rotation, rotation), 4e-6F);
        EXPECT_EQ(bodyFrameOf(record).rotation, bodyFrameOf(states, 0).rotation);
    }
}

TEST(MotionState, positionsRoundToTheNearestUnitAndHalvesToTheEvenOne) {
    MotionStates states;
    states.resize(1);
    const auto unitsOf = [&](float units) {
        setBodyFrame(states, 0, {glm::vec3(units * kPositionUnitMetres, 0, 0), {1, 0, 0, 0}});
        return states.x[0];
    };
    EXPECT_EQ(unitsOf(2.4F), 2);
    EXPECT_EQ(unitsOf(2.5F), 2);
    EXPECT_EQ(unitsOf(3.5F), 4);
    EXPECT_EQ(unitsOf(-2.5F), -2);
    EXPECT_EQ(unitsOf(-2.6F), -3);
    EXPECT_EQ(unitsOf(1e12F), 2147483647);  // kept in the world rather than wrapped
}

TEST(MotionState, theHashSeesEveryBitOfEveryFish) {
    const MotionStates states = randomStates(3, 4);
    const std::uint64_t hash = hashOf(states);
    for (std::size_t fish = 0; fish < states.size(); ++fish) {
        // Mouth, gaze and skin are no motion.
        for (unsigned bit = 0; bit < 8 * offsetof(FishRecord, mouth); ++bit) {
            if (bit == 159 || bit == 158) continue;  // the two spare bits of the orientation
            FishRecord record = recordOf(states, fish);
            reinterpret_cast<unsigned char*>(&record)[bit / 8] ^=
                static_cast<unsigned char>(1U << bit % 8);
            MotionStates altered = states;
            setFromRecord(altered, fish, record);
            EXPECT_NE(hashOf(altered), hash) << "fish " << fish << " bit " << bit;
        }
    }
    MotionStates swapped = states;
    setFromRecord(swapped, 0, recordOf(states, 1));
    setFromRecord(swapped, 1, recordOf(states, 0));
    EXPECT_NE(hashOf(swapped), hash);
}

// Worlds that move alike have one hash, however their faces look: so a recording of before there
// were faces still proves its replay.
TEST(MotionState, theHashIsNotOfMouthAndGaze) {
    MotionStates states = randomStates(3, 6);
    const std::uint64_t hash = hashOf(states);
    states.mouth[1] ^= 0x5AU;
    states.gaze[2] ^= 0xA5U;
    EXPECT_EQ(hashOf(states), hash);
}

TEST(Gaze, everyByteIsADirectionAndItsOwnAgain) {
    for (unsigned gaze = 0; gaze < 256; ++gaze) {
        if (gaze >> 4U == 8U) continue;  // straight down there is no other
        const glm::vec3 direction = directionOf(static_cast<std::uint8_t>(gaze));
        EXPECT_NEAR(glm::length(direction), 1, 1e-6F);
        EXPECT_EQ(gazeTowards(3.0F * direction), gaze);
    }
    EXPECT_EQ(directionOf(0), glm::vec3(1, 0, 0));
    EXPECT_GT(directionOf(gazeTowards({0, 0.2F, 1})).z, 0.9F) << "right is positive z";
}

TEST(Gaze, isWithinHalfAStepOfWhatIsLookedAt) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 to =
            glm::normalize(glm::vec3(normal(random), 0.5F * normal(random), normal(random)));
        EXPECT_GT(glm::dot(directionOf(gazeTowards(to)), to), std::cos(0.23F));
    }
}

TEST(Gaze, turnsByTheShorterWayWithinEightTicks) {
    for (unsigned from = 0; from < 256; ++from)
        for (unsigned to = 0; to < 256; ++to) {
            std::uint8_t gaze = static_cast<std::uint8_t>(from);
            for (int tick = 0; tick < 16 && gaze != to; ++tick) {
                const glm::vec3 before = directionOf(gaze);
                gaze = gazeAfter(gaze, to);
                ASSERT_GT(glm::dot(before, directionOf(gaze)), std::cos(0.45F));
            }
            ASSERT_EQ(gaze, to) << from;
        }
    EXPECT_EQ(gazeAfter(7, 8), 8) << "round behind it";
}

TEST(MotionState, anImpossibleRecordIsNotPlayable) {
    const FishRecord good = recordOf(randomStates(1, 5), 0);
    const auto with = [&](auto&& damage) {
        FishRecord record = good;
        damage(record);
        return isPlayable(record);
    };
    EXPECT_TRUE(with([](auto&) {}));
    EXPECT_FALSE(with([](auto& r) { r.segment = kSegments; }));
    EXPECT_FALSE(with([](auto& r) { r.fromSegment = kSegments; }));
    EXPECT_TRUE(with([](auto& r) { r.mouth = 255, r.gaze = 255; })) << "all of them are possible";
    EXPECT_TRUE(with([](auto& r) { r.skin = motion::kMostSkin; }));
    EXPECT_FALSE(with([](auto& r) { r.skin = motion::kMostSkin + 1; }));
    EXPECT_FALSE(with([](auto& r) { r.warpLength = 3, r.warpFrame = 4; }));
    EXPECT_FALSE(with([](auto& r) { r.orientationHigh |= 1U << 31U; }));
    EXPECT_FALSE(
        with([](auto& r) { r.speedAndSpread = packedSpeedAndSpread(kFastestUnits + 1, 0); }));
    EXPECT_FALSE(
        with([](auto& r) { r.speedAndSpread = packedSpeedAndSpread(-kFastestUnits - 1, 0); }));
}

TEST(MotionState, anAbsentFishIsNeitherRefusedNorLost) {
    MotionStates states;
    states.resize(2);
    setBodyFrame(states, 0, {.position = {1, -60, -4}, .rotation = {1, 0, 0, 0}});
    setBodyFrame(states, 1, {.position = {1, -5, -4}, .rotation = {1, 0, 0, 0}});
    EXPECT_FALSE(isAway(states, 0)) << "the deepest sea floor";
    setAway(states, 1);
    EXPECT_TRUE(isAway(states, 1));
    const FishRecord record = recordOf(states, 1);
    EXPECT_TRUE(isPlayable(record));
    EXPECT_TRUE(isAway(record));
    MotionStates received;
    received.resize(1);
    setFromRecord(received, 0, record);
    EXPECT_TRUE(isAway(received, 0));
    EXPECT_EQ(received.x[0], states.x[1]) << "it keeps all but its height";
}

}  // namespace
}  // namespace aquarama::motion
