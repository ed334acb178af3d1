// SPDX-License-Identifier: Apache-2.0
#include "master/study/occupation.h"

#include <vector>

#include <gtest/gtest.h>

namespace aquarama::study {
namespace {

using fish::Intention;

// Two species: one fish of peace, and one predator, which shadows it.
class Two {
  public:
    Two() : species(2) {
        species[0].last = 1;
        species[1].kind = 1;
        species[1].first = 1;
        species[1].last = 2;
        species[1].shadows = 1;
        species[1].slow = 1;
        species[1].habits.role = config::Role::Predator;
        view.resize(2);
        minds.resize(2);
        view.kind[1] = 1;
        for (fish::VisibleFish& one : view.fish) one.length = 0.3F;
        view.fish[1].position = {3, 0, 0};
    }
    [[nodiscard]] Occupation does(std::uint32_t fish) const {
        return occupationOf({view, minds, species}, fish);
    }
    [[nodiscard]] Occupation predatorDoes() const { return does(1); }

    std::vector<fish::SpeciesParameters> species;
    fish::FishView view;
    fish::Minds minds;
};

TEST(Occupation, anIntentionIsOneByItsNumberAndName) {
    Two two;
    two.minds[0].intention = Intention::Graze;
    EXPECT_EQ(two.does(0), static_cast<Occupation>(Intention::Graze));
    EXPECT_STREQ(nameOf(two.does(0)), "graze");
    EXPECT_STREQ(nameOf(Occupation::Patrol), "patrol");
}

TEST(Occupation, whoMakesWayCountsAsWhatItGoesOnWithAndWhoFleesFlees) {
    Two two;
    two.minds[0].remembered = Intention::Graze;
    two.minds[0].intention = Intention::AvoidFish;
    EXPECT_STREQ(nameOf(two.does(0)), "graze");
    two.minds[0].intention = Intention::Escape;
    EXPECT_STREQ(nameOf(two.does(0)), "escape");
}

TEST(Occupation, aCleanerInspectsOnlyBesideItsClient) {
    Two two;
    two.minds[0].intention = Intention::Clean;
    EXPECT_STREQ(nameOf(two.does(0)), "clean");
    two.minds[0].target = 1;
    EXPECT_STREQ(nameOf(two.does(0)), "clean");
    two.view.fish[1].position = {0.2F, 0, 0};
    EXPECT_EQ(two.does(0), Occupation::Inspect);
}

TEST(Occupation, aPredatorAtEasePatrols) {
    Two two;
    EXPECT_EQ(two.predatorDoes(), Occupation::Patrol);
    two.minds[1].intention = Intention::AvoidObstacle;
    EXPECT_EQ(two.predatorDoes(), Occupation::Patrol);
    two.minds[1].intention = Intention::Eat;
    EXPECT_STREQ(nameOf(two.predatorDoes()), "eat");
    EXPECT_STREQ(nameOf(two.does(0)), "wander") << "no predator";
}

TEST(Occupation, oneFromAmbushLiesInWaitWhereItStandsOrHangsAndShadowsWhereItRides) {
    Two two;
    two.species[1].habits.hunt.ambush = config::Ambush{};
    fish::VisibleFish& own = two.view.fish[1];
    own.heading = {1, 0, 0};
    own.speed = 0.1F;
    EXPECT_EQ(two.predatorDoes(), Occupation::LieInWait) << "a third of a length a second";
    own.speed = 0.3F;
    EXPECT_EQ(two.predatorDoes(), Occupation::Patrol);
    own.heading = {0.6F, -0.8F, 0};
    EXPECT_EQ(two.predatorDoes(), Occupation::LieInWait) << "hangs";
    own = two.view.fish[0];
    own.heading = two.view.fish[0].heading = {1, 0, 0};
    own.speed = two.view.fish[0].speed = 0.3F;
    own.position = {0, 0.2F, 0};
    EXPECT_EQ(two.predatorDoes(), Occupation::Shadow);
    own.heading = {0, 0, 1};
    EXPECT_EQ(two.predatorDoes(), Occupation::Patrol) << "it crosses";
    own.heading = {1, 0, 0};
    two.view.signs[0] = fish::kAway;
    EXPECT_EQ(two.predatorDoes(), Occupation::Patrol) << "nobody is there";
}

}  // namespace
}  // namespace aquarama::study
