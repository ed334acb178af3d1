// SPDX-License-Identifier: Apache-2.0
// What others see of a fish's mood.
#include "master/fish/signs.h"

#include <gtest/gtest.h>

#include "master/behaviour/decide/intention_generator.h"

namespace aquarama {
namespace {

struct Shown {
    std::uint8_t signs = 0;
    std::uint32_t partner = kNobody;
    [[nodiscard]] bool shows(Sign sign) const { return (signs & sign) != 0; }
};

Shown shown(Role role, const Mind& mind, std::uint8_t before = 0) {
    Nature nature;
    nature.role = role;
    nature.libido = 0.003F;
    FishView view;
    view.resize(1);
    view.signs[0] = before;
    Minds minds;
    minds.resize(1);
    minds[0] = mind;
    showMood(nature, minds, 0, view);
    return {view.signs[0], view.partner[0]};
}

Mind about(Intention intention, std::uint32_t target = kNobody) {
    Mind mind;
    mind.eaten = 4;
    mind.sinceMeal = 0;
    mind.sinceSpawning = 0;
    mind.intention = intention;
    mind.target = target;
    return mind;
}

// The same, swerving from a fish.
Mind interrupted(Mind mind) {
    remember(mind, {Intention::AvoidFish, 77});
    return mind;
}

TEST(Signs, aSchoolingFishShowsItAlsoWhileItSwerves) {
    EXPECT_TRUE(shown(Role::Prey, about(Intention::School)).shows(kSchooling));
    EXPECT_TRUE(shown(Role::Prey, interrupted(about(Intention::School))).shows(kSchooling));
    EXPECT_FALSE(shown(Role::Prey, about(Intention::Eat, 3)).shows(kSchooling));
}

TEST(Signs, aPredatorShowsThatItHunts) {
    EXPECT_TRUE(shown(Role::Predator, about(Intention::Eat, 3)).shows(kHunting));
    EXPECT_TRUE(shown(Role::Predator, interrupted(about(Intention::Eat, 3))).shows(kHunting));
    EXPECT_FALSE(shown(Role::Predator, about(Intention::Wander)).shows(kHunting));
    EXPECT_FALSE(shown(Role::Pacifist, about(Intention::Eat, 3)).shows(kHunting));
}

TEST(Signs, whoCourtsShowsWhom) {
    const Shown courting = shown(Role::Pacifist, about(Intention::Mate, 9));
    EXPECT_EQ(courting.partner, 9U);
    EXPECT_TRUE(courting.shows(kWilling));
    EXPECT_EQ(shown(Role::Pacifist, interrupted(about(Intention::Mate, 9))).partner, 9U);
    EXPECT_EQ(shown(Role::Pacifist, about(Intention::Eat, 9)).partner, kNobody);
}

TEST(Signs, libidoMakesAPacifistWillingAndNobodyElse) {
    Mind mind = about(Intention::Wander);
    EXPECT_FALSE(shown(Role::Pacifist, mind).shows(kWilling)) << "it has just spawned";
    mind.sinceSpawning = kLongAgo;
    EXPECT_TRUE(shown(Role::Pacifist, mind).shows(kWilling));
    EXPECT_FALSE(shown(Role::Prey, mind).shows(kWilling));
    EXPECT_FALSE(shown(Role::Predator, mind).shows(kWilling));
    mind.eaten = 0;
    EXPECT_FALSE(shown(Role::Pacifist, mind).shows(kWilling)) << "it hungers";
}

TEST(Signs, sexIsShownAndAnAbsentFishStaysAway) {
    Mind mind = about(Intention::Wander);
    EXPECT_FALSE(shown(Role::Prey, mind).shows(kFemale));
    mind.likes = kIsFemale;
    for (const Role role : {Role::Prey, Role::Pacifist, Role::Predator}) {
        EXPECT_TRUE(shown(role, mind, kAway).shows(kFemale));
        EXPECT_TRUE(shown(role, mind, kAway).shows(kAway));
        EXPECT_FALSE(shown(role, mind, kHunting | kWilling).shows(kAway));
        EXPECT_FALSE(shown(role, mind, kHunting | kWilling).shows(kHunting)) << "moods pass";
    }
}

}  // namespace
}  // namespace aquarama
