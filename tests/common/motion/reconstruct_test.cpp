// SPDX-License-Identifier: Apache-2.0
#include "common/motion/reconstruct.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

double travel(const body::NodalPoints& a, const body::NodalPoints& b) {
    double most = 0;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        most = std::max(most, static_cast<double>(glm::distance(a[i], b[i])));
    }
    return most;
}

// Eq. 12 of a fish between two ticks: world frame, metres.
body::NodalPoints nodesInWorld(const PresentedFish& fish) {
    body::NodalPoints nodes;
    nodalPose(sharedRepertoire(), fish, nodes);
    const glm::quat rotation(fish.rotation.w, fish.rotation.x, fish.rotation.y, fish.rotation.z);
    for (glm::vec3& node : nodes)
        node = fish.positionMetres + rotation * (fish.lengthMetres * node);
    return nodes;
}

// Eq. 12 with eq. 8 undone: n = o + R (alpha d), where d is what was captured. Of fish of two
// lengths, away from the origin and askew: the path of the captured fish is turned and moved as a
// whole.
TEST(NodalPoints, areThoseThatWereCaptured) {
    const auto rest = synthetic::restNodes();
    const auto gaits = synthetic::gaits();
    const glm::dquat turn = glm::normalize(glm::dquat(0.5, glm::dvec3(-0.3, 0.7, 0.4)));
    const glm::dvec3 away{40, -7, 25};
    School school(kCapturedActions);
    for (std::size_t action = 0; action < kCapturedActions; ++action) {
        school.states.segment[action] = firstSegmentOf(static_cast<Action>(action));
        school.traits[action].lengthMillimetres = action % 2 == 0 ? 300 : 2000;
    }
    std::array<body::NodalPoints, kCapturedActions> nodes;
    for (int k = 0; k < kPhases; k += 5) {
        const double phase = static_cast<double>(k) / kPhases;
        for (std::size_t action = 0; action < kCapturedActions; ++action) {
            const synthetic::Frame frame = synthetic::frameOf(gaits[action], phase);
            const double length = school.traits[action].lengthMillimetres * 1e-3;
            setBodyFrame(school.states,
                         action,
                         {.position = glm::vec3(away + turn * (length * frame.origin)),
                          .rotation = glm::quat(turn * glm::quat_cast(frame.axes))});
            school.states.phase[action] = static_cast<std::uint16_t>(k * (65536 / kPhases));
        }
        nodalPoints(*school.tables, school.traits, school.states, 0, nodes);
        for (std::size_t action = 0; action < kCapturedActions; ++action) {
            const double length = school.traits[action].lengthMillimetres * 1e-3;
            for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
                const glm::dvec3 captured =
                    away + turn * (length * synthetic::placed(gaits[action], phase, rest[i]));
                ASSERT_LT(glm::distance(glm::dvec3(nodes[action][i]), captured),
                          2e-5 + length * 5e-5)
                    << nameOf(static_cast<Action>(action)) << ", node " << i;
            }
        }
    }
}

// Between samples, in motion warps, and of any range: what nodalPose() gives for the same records,
// turned, scaled and placed; and the same bits on every instruction set.
TEST(NodalPoints, areThoseOfThePlainReconstructionOnEveryInstructionSet) {
    std::mt19937 random(15);
    School school(3000);
    scatter(school, random);
    for (int tick = 0; tick < 30; ++tick) {
        commandAtRandom(school, random);
        school.tick();
    }
    std::vector<body::NodalPoints> first;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::vector<body::NodalPoints> nodes(school.traits.size() - 7);
        nodalPoints(*school.tables, school.traits, school.states, 7, nodes);
        if (first.empty()) first = nodes;
        EXPECT_EQ(nodes, first);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    int warping = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const FishRecord record = recordOf(school.states, i + 7);
        warping += record.warpFrame != record.warpLength ? 1 : 0;
        const double length = school.traits[i + 7].lengthMillimetres * 1e-3;
        const double rounding = 1e-5 * length + 7e-5;  // of floats, some 500 m out
        EXPECT_LT(travel(first[i], nodesInWorld(present(record, record, 0, school.traits[i + 7]))),
                  rounding);
    }
    EXPECT_GT(warping, 30);
}

TEST(Reconstruct, aPresentedFishIsItsTicksAtBothEnds) {
    std::mt19937 random(6);
    School school(200);
    scatter(school, random);
    for (int tick = 0; tick < 100; ++tick) {
        commandAtRandom(school, random);
        const MotionStates before = school.states;
        school.tick();
        for (std::size_t i = 0; i < school.traits.size(); ++i) {
            const FishRecord a = recordOf(before, i);
            const FishRecord b = recordOf(school.states, i);
            const auto nodesOf = [&](const FishRecord& from, const FishRecord& to, float fraction) {
                return nodesInWorld(present(from, to, fraction, school.traits[i]));
            };
            const double length = school.traits[i].lengthMillimetres * 1e-3;
            const double rounding = 1e-5 * length + 7e-5;  // of floats, some 500 m out
            EXPECT_LT(travel(nodesOf(a, b, 0), nodesOf(a, a, 0)), rounding);
            EXPECT_LT(travel(nodesOf(a, b, 1), nodesOf(b, b, 0)), rounding);
        }
    }
}

// In ten frames a tick, a frame is never a jump: also where the phase wraps and where a warp
// starts.
TEST(Reconstruct, framesBetweenTicksFlow) {
    std::mt19937 random(7);
    School school(1);
    school.play(0, Action::ForwardMedium);
    body::NodalPoints last;
    bool first = true;
    for (int tick = 0; tick < 400; ++tick) {
        if (tick % 25 == 0) school.command(0, static_cast<Action>(random() % kActions));
        const FishRecord before = recordOf(school.states, 0);
        school.tick();
        const FishRecord after = recordOf(school.states, 0);
        for (int frame = 0; frame < 10; ++frame) {
            const float fraction = static_cast<float>(frame) / 10.0F;
            const body::NodalPoints nodes =
                nodesInWorld(present(before, after, fraction, school.traits[0]));
            // 0.2 m long, 2 body lengths a second, a tail that beats as fast again.
            ASSERT_TRUE(first || travel(nodes, last) < 0.2 * 0.1 / 10) << "tick " << tick;
            last = nodes;
            first = false;
        }
    }
}

TEST(Reconstruct, aFishThatJumpedIsShownWhereItLanded) {
    FishRecord before{.segment = 0};
    before.phase = 100;
    FishRecord after{.segment = 3};
    after.phase = 5000;
    after.fromSegment = 2;
    const PresentedFish fish = present(before, after, 0.25F, {.id = 7, .lengthMillimetres = 300});
    EXPECT_EQ(fish.action, 3U);
    EXPECT_EQ(fish.warpWeight, 1.0F);
    EXPECT_EQ(fish.phase, 5000.0F / 65536.0F);
    EXPECT_EQ(fish.id, 7U);
    EXPECT_FLOAT_EQ(fish.lengthMetres, 0.3F);
}

TEST(Reconstruct, aFishThatGoesOrComesIsAwayAndNotOnItsWay) {
    MotionStates states;
    states.resize(1);
    setBodyFrame(states, 0, {.position = {1, -5, -4}, .rotation = {1, 0, 0, 0}});
    const FishRecord there = recordOf(states, 0);
    setAway(states, 0);
    const FishRecord away = recordOf(states, 0);
    const FishTraits traits{.id = 7, .lengthMillimetres = 240};
    for (const float fraction : {0.0F, 0.3F, 1.0F}) {
        EXPECT_TRUE(isAway(present(there, away, fraction, traits)));
        EXPECT_TRUE(isAway(present(away, there, fraction, traits)));
        EXPECT_TRUE(isAway(present(away, away, fraction, traits)));
        EXPECT_FALSE(isAway(present(there, there, fraction, traits)));
    }
}

TEST(Reconstruct, aSegmentThatDoesNotExistIsNotReadBeyondTheLast) {
    PresentedFish fish;
    fish.action = 250;
    fish.phase = 7.5F;
    fish.lengthMetres = 1;
    const body::NodalPoints nodes = nodesInWorld(fish);
    for (const glm::vec3& node : nodes) EXPECT_LT(glm::length(node), 1.5F);
}

}  // namespace
}  // namespace aquarama::motion
