// SPDX-License-Identifier: Apache-2.0
// One world on every machine: the vectorised step against the plain one, bit for bit.
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "common/motion/headings.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

constexpr std::size_t kFish = 3001;  // no multiple of any vector
constexpr int kTicks = 600;

School randomSchool() {
    std::mt19937 random(11);
    School school(kFish);
    scatter(school, random);
    for (std::size_t i = 0; i < kFish; ++i) {
        school.commands.action[i] = static_cast<std::uint8_t>(actionOf(school.states.segment[i]));
        school.commands.phaseRate[i] = static_cast<std::int16_t>(random() % 6000);
    }
    return school;
}

// One hash for each half second of the same commands.
template <class Step>
std::vector<std::uint64_t> historyOf(Step&& step) {
    School school = randomSchool();
    std::mt19937 random(12);
    std::vector<std::uint64_t> hashes;
    for (int tick = 0; tick < kTicks; ++tick) {
        commandAtRandom(school, random);
        step(school.step());
        if (tick % 30 == 29) hashes.push_back(hashOf(school.states));
    }
    return hashes;
}

const std::vector<std::uint64_t>& referenceHistory() {
    static const auto kHistory = historyOf([](const MotorStep& step) { step.runReference(); });
    return kHistory;
}

TEST(MotorStep, everyInstructionSetComputesTheBitsOfThePlainStep) {
    int compared = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_EQ(historyOf([](const MotorStep& step) { step.run(); }), referenceHistory())
            << hwy::TargetName(target);
        ++compared;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(compared, 0);
}

// The hash does not see mouth and gaze.
TEST(MotorStep, everyInstructionSetMovesFacesAsThePlainStepDoes) {
    const auto faces = [](auto&& step) {
        School school = randomSchool();
        std::mt19937 random(15);
        for (int tick = 0; tick < 60; ++tick) {
            for (std::size_t i = tick % 7; i < kFish; i += 7) {
                school.commands.mouth[i] = static_cast<std::uint8_t>(random());
                school.commands.gaze[i] = static_cast<std::uint8_t>(random());
            }
            step(school.step());
        }
        return std::pair{school.states.mouth, school.states.gaze};
    };
    const auto plain = faces([](const MotorStep& step) { step.runReference(); });
    EXPECT_NE(plain.first, std::vector<std::uint8_t>(kFish));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_EQ(faces([](const MotorStep& step) { step.run(); }), plain)
            << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// What nodes are admitted by (Hello): the same on every machine.
TEST(MotorStep, theSelfTestIsTheSameOnEveryInstructionSet) {
    std::set<std::uint64_t> hashes;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        hashes.insert(motorSelfTest());
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(hashes, std::set{motorSelfTest()});
}

TEST(MeanHeadings, everyInstructionSetComputesTheBitsOfPlainCode) {
    School school = randomSchool();
    std::mt19937 random(14);
    for (int tick = 0; tick < 60; ++tick) {  // some are in a warp then
        commandAtRandom(school, random);
        school.tick();
    }
    const MotorTables& tables = *school.step().tables;
    std::vector<float> x(kFish);
    std::vector<float> y(kFish);
    std::vector<float> z(kFish);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        meanHeadings(tables, school.states, 5, kFish, {x.data(), y.data(), z.data()});
        for (std::size_t fish = 5; fish < kFish; ++fish)
            ASSERT_EQ(glm::vec3(x[fish - 5], y[fish - 5], z[fish - 5]),
                      meanHeadingReference(tables, school.states, fish))
                << fish;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(MotorStep, anySplitIntoRangesComputesTheSameBits) {
    std::mt19937 random(13);
    const auto inPieces = [&](const MotorStep& whole) {
        MotorStep piece = whole;
        while (piece.first < whole.last) {
            piece.last = std::min<std::size_t>(whole.last, piece.first + random() % 700);
            piece.run();
            piece.first = piece.last;
        }
    };
    EXPECT_EQ(historyOf(inPieces), referenceHistory());
}

TEST(MotorStep, theTestsWorldIsOneInWhichThingsHappen) {
    School school = randomSchool();
    std::mt19937 random(12);
    std::array<int, kActions> seen{};
    int warping = 0;
    for (int tick = 0; tick < kTicks; ++tick) {
        commandAtRandom(school, random);
        school.tick();
        for (std::size_t i = 0; i < kFish; ++i) {
            ++seen[indexOf(actionOf(school.states.segment[i]))];
            warping += school.states.warpFrame[i] != school.states.warpLength[i] ? 1 : 0;
        }
    }
    for (const int count : seen) EXPECT_GT(count, 10000);
    EXPECT_GT(warping, 10000);
}

}  // namespace
}  // namespace aquarama::motion
