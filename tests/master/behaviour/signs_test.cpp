// SPDX-License-Identifier: Apache-2.0
// What others see of a fish's mood.
#include <gtest/gtest.h>

#include "master/behaviour/intention_generator.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {
namespace {

struct ShownSign {
    std::uint8_t signs = 0;
    std::uint32_t partner = fish::kNobody;
    [[nodiscard]] bool shows(fish::MoodSign sign) const { return (signs & sign) != 0; }
};

ShownSign shown(config::Role role,
                const fish::Mind& mind,
                std::uint8_t before = 0,
                bool mates = true) {
    fish::SpeciesParameters parameters;
    parameters.habits.role = role;
    parameters.habits.libidoPerSecond = 0.003F;
    fish::FishView view;
    view.resize(1);
    view.signs[0] = before;
    fish::Minds minds;
    minds.resize(1);
    minds[0] = mind;
    view.partner[0] = 5;
    fish::showMood(parameters, minds, 0, mates, view);
    return {view.signs[0], view.partner[0]};
}

fish::Mind about(fish::Intention intention, std::uint32_t target = fish::kNobody) {
    fish::Mind mind;
    mind.eaten = 4;
    mind.sinceMeal = 0;
    mind.sinceSpawning = 0;
    mind.intention = intention;
    mind.target = target;
    return mind;
}

// The same, swerving from a fish.
fish::Mind interrupted(fish::Mind mind) {
    remember(mind, {fish::Intention::AvoidFish, 77});
    return mind;
}

TEST(Signs, aSchoolingFishShowsItAlsoWhileItSwerves) {
    EXPECT_TRUE(shown(config::Role::Prey, about(fish::Intention::School)).shows(fish::kSchooling));
    EXPECT_TRUE(shown(config::Role::Prey, interrupted(about(fish::Intention::School)))
                    .shows(fish::kSchooling));
    EXPECT_FALSE(shown(config::Role::Prey, about(fish::Intention::Eat, 3)).shows(fish::kSchooling));
}

TEST(Signs, aPredatorShowsThatItHunts) {
    EXPECT_TRUE(
        shown(config::Role::Predator, about(fish::Intention::Eat, 3)).shows(fish::kHunting));
    EXPECT_TRUE(shown(config::Role::Predator, interrupted(about(fish::Intention::Eat, 3)))
                    .shows(fish::kHunting));
    EXPECT_FALSE(
        shown(config::Role::Predator, about(fish::Intention::Wander)).shows(fish::kHunting));
    EXPECT_FALSE(
        shown(config::Role::Pacifist, about(fish::Intention::Eat, 3)).shows(fish::kHunting));
}

TEST(Signs, whoCourtsShowsWhom) {
    const ShownSign courting = shown(config::Role::Pacifist, about(fish::Intention::Mate, 9));
    EXPECT_EQ(courting.partner, 9U);
    EXPECT_TRUE(courting.shows(fish::kWilling));
    EXPECT_EQ(shown(config::Role::Pacifist, interrupted(about(fish::Intention::Mate, 9))).partner,
              9U);
    EXPECT_EQ(shown(config::Role::Pacifist, about(fish::Intention::Eat, 9)).partner, fish::kNobody);
}

TEST(Signs, libidoMakesAFishWillingWhenItsSpeciesMates) {
    for (const config::Role role :
         {config::Role::Prey, config::Role::Pacifist, config::Role::Predator}) {
        fish::Mind mind = about(fish::Intention::Wander);
        EXPECT_FALSE(shown(role, mind).shows(fish::kWilling)) << "it has just spawned";
        mind.sinceSpawning = fish::kLongAgo;
        EXPECT_TRUE(shown(role, mind).shows(fish::kWilling));
        EXPECT_FALSE(shown(role, mind, 0, false).shows(fish::kWilling)) << "not at this hour";
        mind.eaten = 0;
        EXPECT_EQ(shown(role, mind).shows(fish::kWilling), role == config::Role::Predator)
            << "it hungers: that stops all but hunters";
    }
}

TEST(Signs, preyShowsWhomItCourtsWhenItsSpeciesMates) {
    const fish::Mind courting = about(fish::Intention::Mate, 9);
    EXPECT_EQ(shown(config::Role::Prey, courting).partner, 9U);
    EXPECT_EQ(shown(config::Role::Prey, courting, 0, false).partner, fish::kNobody);
}

TEST(Signs, sexIsShownAndAnAbsentFishStaysAway) {
    fish::Mind mind = about(fish::Intention::Wander);
    EXPECT_FALSE(shown(config::Role::Prey, mind).shows(fish::kFemale));
    mind.likes = fish::kIsFemale;
    for (const config::Role role :
         {config::Role::Prey, config::Role::Pacifist, config::Role::Predator}) {
        EXPECT_TRUE(shown(role, mind, fish::kAway).shows(fish::kFemale));
        EXPECT_TRUE(shown(role, mind, fish::kAway).shows(fish::kAway));
        EXPECT_FALSE(shown(role, mind, fish::kHunting | fish::kWilling).shows(fish::kAway));
        EXPECT_FALSE(shown(role, mind, fish::kHunting | fish::kWilling).shows(fish::kHunting))
            << "moods pass";
    }
}

}  // namespace
}  // namespace aquarama::behaviour
