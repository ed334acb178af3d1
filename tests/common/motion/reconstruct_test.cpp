// SPDX-License-Identifier: Apache-2.0
#include "common/motion/reconstruct.h"

#include <gtest/gtest.h>

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

// World frame, metres: n = o + R (alpha d).
body::NodalPoints nodesInWorld(const PresentedFish& fish) {
    body::NodalPoints nodes;
    nodalPose(sharedRepertoire(), fish, nodes);
    const glm::quat rotation(fish.rotation.w, fish.rotation.x, fish.rotation.y, fish.rotation.z);
    for (glm::vec3& node : nodes)
        node = fish.positionMetres + rotation * (fish.lengthMetres * node);
    return nodes;
}

// Eq. 12 with eq. 8 undone: n = o + R (alpha d), where d is what was captured.
TEST(Reconstruct, nodalPointsAreThoseThatWereCaptured) {
    const auto rest = synthetic::restNodes();
    for (std::size_t action = 0; action < kCapturedActions; ++action) {
        const synthetic::Gait gait = synthetic::gaits()[action];
        for (int k = 0; k < kPhases; k += 5) {
            const double phase = static_cast<double>(k) / kPhases;
            const synthetic::Frame frame = synthetic::frameOf(gait, phase);
            const glm::dquat rotation = glm::quat_cast(frame.axes);
            constexpr double kLength = 0.5;
            PresentedFish fish;
            fish.positionMetres = glm::vec3(kLength * frame.origin);
            fish.lengthMetres = static_cast<float>(kLength);
            fish.rotation = glm::vec4(rotation.x, rotation.y, rotation.z, rotation.w);
            fish.phase = static_cast<float>(phase);
            fish.action = static_cast<std::uint32_t>(action);
            const body::NodalPoints nodes = nodesInWorld(fish);
            for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
                const glm::dvec3 captured = kLength * synthetic::placed(gait, phase, rest[i]);
                EXPECT_LT(glm::distance(glm::dvec3(nodes[i]), captured), kLength * 5e-5);
            }
        }
    }
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
