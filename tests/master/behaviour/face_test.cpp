// SPDX-License-Identifier: Apache-2.0
// What a face shows of a thought.
#include "master/behaviour/face.h"

#include <vector>

#include <gtest/gtest.h>

#include "common/motion/gaze.h"
#include "tests/master/behaviour/fish_in_mind.h"

namespace aquarama::behaviour {
namespace {

struct Shown : FishInMind {
    using FishInMind::FishInMind;

    fish::Face face(const std::vector<fish::DeferredEvent>& own = {}) {
        Environment environment;
        environment.view = &view;
        environment.surroundings = &around;
        return faceOf({environment, parameters, 0, senses, feelings}, mind, own);
    }
    fish::FishView view;
    surroundings::Surroundings around{};
};

Sighting at(glm::vec3 offset) {
    return {.object = 3, .offset = offset, .distance = glm::length(offset)};
}

TEST(Face, isAtRestWhereNothingHappens) {
    Shown fish;
    EXPECT_EQ(fish.face().mouth, 0);
    EXPECT_EQ(fish.face().gaze, 0);
}

TEST(Face, aMouthIsWideOpenInTheThoughtThatSnapsAndNoLonger) {
    Shown fish;
    fish.mind.intention = fish::Intention::Eat;
    EXPECT_EQ(fish.face({{fish::DeferredEventKind::EatParticle, 0, 3}}).mouth, 255);
    EXPECT_EQ(fish.face().mouth, 0);
}

TEST(Face, aPredatorOpensItsJawsAsItRushesMoreSoNearItsPrey) {
    Shown fish(config::Role::Predator);
    fish.mind.intention = fish::Intention::Eat;
    fish.senses.length = 1;
    fish.senses.prey = at({3, 0, 0});
    EXPECT_EQ(fish.face().mouth, 0) << "it stalks";
    fish.mind.stage = static_cast<std::uint8_t>(HuntStage::Rush);
    const int far = fish.face().mouth;
    fish.senses.prey = at({0.5F, 0, 0});
    EXPECT_GT(far, 0);
    EXPECT_GT(fish.face().mouth, far);
}

TEST(Face, whoThreatensGapesAndWhoPosesForACleanerHoldsStill) {
    Shown fish;
    fish.mind.intention = fish::Intention::Charge;
    EXPECT_GT(fish.face().mouth, 0);
    fish.mind.intention = fish::Intention::Visit;
    EXPECT_EQ(fish.face().mouth, 0) << "on its way";
    fish.mind.stage = static_cast<std::uint8_t>(VisitStage::Pose);
    const int posing = fish.face().mouth;
    fish.senses.cleaning.cleaned = true;
    EXPECT_GT(posing, 0);
    EXPECT_GT(fish.face().mouth, posing);
}

TEST(Face, looksAtWhatItsIntentionIsAbout) {
    Shown fish;
    fish.senses.heading = {0, 0, -1};  // its right is +x
    fish.senses.food = at({2, 0, 0});
    fish.senses.mate = at({-2, 0, 0});
    fish.mind.intention = fish::Intention::Eat;
    EXPECT_EQ(fish.face().gaze, motion::gazeTowards({0, 0, 1}));
    fish.mind.intention = fish::Intention::Mate;
    EXPECT_EQ(fish.face().gaze, motion::gazeTowards({0, 0, -1}));
    fish.mind.intention = fish::Intention::School;
    EXPECT_EQ(fish.face().gaze, 0) << "ahead";
    fish.frighten(0.5F, 0.5F);
    EXPECT_EQ(fish.face().gaze, motion::gazeTowards({0, 0, 1})) << "at the predator";
}

TEST(Face, looksAtAHandBeforeTheWallWhereNothingElseIsOfInterest) {
    Shown fish;
    fish.around.hands.hands.emplace_back().place = {0, 0, 3};
    const std::uint8_t gaze = fish.face().gaze;
    EXPECT_NE(gaze, 0);
    fish.mind.intention = fish::Intention::Mate;
    fish.senses.mate = at({3, 0, 0});
    EXPECT_NE(fish.face().gaze, gaze) << "at its mate";
}

}  // namespace
}  // namespace aquarama::behaviour
