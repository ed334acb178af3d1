// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "master/behaviour/intention_generator.h"
#include "tests/master/behaviour/aquarium.h"

namespace aquarama::behaviour {
namespace {

// A fish of 0.24 m in the open, with one intention.
struct Moment {
    explicit Moment(fish::Intention intention) {
        mind.intention = intention;
        senses.length = 0.24F;
    }
    [[nodiscard]] bool accepts() const {
        return acceptsRecommendation(parameters, mind, senses, feelings);
    }
    fish::SpeciesParameters parameters;
    fish::Mind mind;
    Senses senses;
    fish::Feelings feelings;
};

TEST(Recommendation, isWelcomeAtEase) {
    for (const fish::Intention at :
         {fish::Intention::Wander, fish::Intention::School, fish::Intention::Leave})
        EXPECT_TRUE(Moment(at).accepts()) << static_cast<int>(at);
}

TEST(Recommendation, isRefusedWhereEveryStrokeCounts) {
    for (const fish::Intention at : {fish::Intention::Escape,
                                     fish::Intention::AvoidFish,
                                     fish::Intention::AvoidObstacle,
                                     fish::Intention::Mate})
        EXPECT_FALSE(Moment(at).accepts()) << static_cast<int>(at);
}

TEST(Recommendation, isRefusedNearAnObstacle) {
    Moment moment(fish::Intention::School);
    moment.senses.urgency = 0.5F;
    EXPECT_FALSE(moment.accepts());
}

TEST(Recommendation, isRefusedByASchoolInFear) {
    Moment moment(fish::Intention::School);
    moment.feelings.fear = moment.parameters.habits.fear.from + 0.1F;
    EXPECT_FALSE(moment.accepts());
}

TEST(Recommendation, isRefusedNearAMealButNotOnTheLongWayThere) {
    for (const config::Role role : {config::Role::Pacifist, config::Role::Predator}) {
        Moment moment(fish::Intention::Eat);
        moment.parameters.habits.role = role;
        Sighting& meal = role == config::Role::Predator ? moment.senses.prey : moment.senses.food;
        meal = {0, {0.3F, 0, 0}, 0.3F};
        EXPECT_FALSE(moment.accepts());
        meal = {0, {3, 0, 0}, 3};
        EXPECT_TRUE(moment.accepts());
    }
}

TEST(Recommendation, isHeededByNobodyWhereTheAdaptationIsOff) {
    Aquarium aquarium({glm::vec3{}});
    aquarium.think();
    EXPECT_TRUE(aquarium.courses[0].openToChange);
    Grids grids = aquarium.freshGrids();
    Environment environment = aquarium.environment(grids);
    environment.adaptation.recommendations = false;
    think(environment, 0, aquarium.minds, aquarium.courses, aquarium.events);
    EXPECT_FALSE(aquarium.courses[0].openToChange);
}

}  // namespace
}  // namespace aquarama::behaviour
