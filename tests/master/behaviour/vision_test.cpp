// SPDX-License-Identifier: Apache-2.0
// What is seen, what is hidden, what is smelt.
#include "master/behaviour/vision.h"

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/perceive.h"
#include "tests/master/behaviour/aquarium.h"

namespace aquarama::behaviour {
namespace {

constexpr std::uint8_t kScad = 0;
constexpr std::uint8_t kShark = 1;
constexpr float kSharkLength = 1.3F;

// One scad at the centre that heads along +x, and what a test adds.
struct Sea : Aquarium {
    Sea() {
        speciesParameters[kScad].huntedBy = 1U << kShark;
        fish::SpeciesParameters shark;
        shark.habits.role = config::Role::Predator;
        shark.kind = kShark;
        shark.hunts = 1U << kScad;
        shark.habits.visionBodyLengths = 10;
        speciesParameters.push_back(shark);
        addFish({});
    }
    std::uint32_t addShark(glm::vec3 offset) {
        const std::uint32_t shark = addFish(offset, kShark, kSharkLength);
        fish::Mind hungry;
        minds[shark] = hungry;
        return shark;
    }
    void feed(std::initializer_list<glm::vec3> offsets) {
        for (const glm::vec3 offset : offsets) {
            surroundings::Food& food = surroundings.food;
            food.x.push_back(kCentre.x + offset.x);
            food.y.push_back(kCentre.y + offset.y);
            food.z.push_back(kCentre.z + offset.z);
            food.lowest.push_back(-100);
            food.kind.push_back(surroundings::FoodKind::Plankton);
            food.taken.push_back(0);
            food.generation.push_back(0);
            food.absentUntil.push_back(0);
        }
    }
    void alter(std::uint32_t fish, auto change) {
        fish::Mind mind = minds[fish];
        change(mind);
        minds[fish] = mind;
    }
    [[nodiscard]] Senses perceived(std::uint32_t fish) const {
        Grids grids = freshGrids();
        return perceive(environment(grids), speciesParameters[view.kind[fish]], fish, minds[fish]);
    }
};

TEST(Sight, endsWhereTheWaterOrTheEyeDoes) {
    const fish::SpeciesParameters parameters;  // 14 body lengths
    EXPECT_FLOAT_EQ(sightMetres(parameters, 0.24F, 1, 12), 14 * 0.24F);
    EXPECT_FLOAT_EQ(sightMetres(parameters, 0.24F, 1, 2), 2);
    EXPECT_FLOAT_EQ(sightMetres(parameters, 0.24F, conspicuousness(kSharkLength), 12),
                    14 * 0.24F * kSharkLength / kLargeBodyMetres);
    EXPECT_FLOAT_EQ(conspicuousness(0.2F), 1);
    EXPECT_FLOAT_EQ(conspicuousness(9), kMostConspicuous);
}

TEST(Sight, aPredatorIsSeenFromFartherOffThanASmallFishWouldBe) {
    for (const float metres : {3.0F, 7.0F, 7.6F}) {
        Sea sea;
        sea.addShark({-0.5F * metres, 0, 0.866F * metres});  // 120 degrees aside
        EXPECT_EQ(sea.perceived(0).predatorCount, metres < 7.28F ? 1U : 0U) << metres;
    }
}

TEST(Sight, clarityBoundsIt) {
    Sea sea;
    sea.addShark({3, 0, 0});
    sea.surroundings.clarityMetres = 2.5F;
    EXPECT_EQ(sea.perceived(0).predatorCount, 0U);
}

TEST(Sight, isBlindStraightBehindUnlessAlarmed) {
    Sea sea;
    sea.addShark({-3, 0, 0.5F});
    EXPECT_EQ(sea.perceived(0).predatorCount, 0U);
    sea.alter(0, [](fish::Mind& mind) { mind.alarm = fish::Alarm::Alone; });
    EXPECT_EQ(sea.perceived(0).predatorCount, 1U) << "who flees looks back";
}

TEST(Sight, keepsTheFourNearestPredatorsNearestFirst) {
    Sea sea;
    for (const float metres : {5.0F, 3.0F, 4.0F, 2.0F, 6.0F})
        sea.addShark({0.2F * metres, 0.5F * (metres - 4), 0.9F * metres});
    const Senses senses = sea.perceived(0);
    ASSERT_EQ(senses.predatorCount, 4U);
    EXPECT_EQ(senses.predators[0].object, 4U);
    EXPECT_EQ(senses.predators[1].object, 2U);
    EXPECT_EQ(senses.predators[2].object, 3U);
    EXPECT_EQ(senses.predators[3].object, 1U);
    EXPECT_NEAR(senses.predators[0].distance, place::lengthOf(senses.predators[0].offset), 1e-5F);
}

TEST(Sight, rocksHide) {
    Sea sea;
    sea.addShark({4, 0, 0});
    EXPECT_EQ(sea.perceived(0).predatorCount, 1U);
    sea.surroundings.obstacles.rocks = {{Aquarium::kCentre + glm::vec3{2, 0, 0}, 0.5F, 0}};
    EXPECT_EQ(sea.perceived(0).predatorCount, 0U);
    sea.surroundings.obstacles.rocks = {{Aquarium::kCentre + glm::vec3{2, 0, 0.6F}, 0.5F, 0}};
    EXPECT_EQ(sea.perceived(0).predatorCount, 1U) << "past it";
}

TEST(Sight, aLargeBodyHides) {
    Sea sea;
    const std::uint32_t near = sea.addShark({2, 0, 0});
    sea.addShark({5, 0, 0});
    sea.head(near, {0, 0, 1});
    const Senses senses = sea.perceived(0);
    ASSERT_EQ(senses.predatorCount, 1U);
    EXPECT_EQ(senses.predators[0].object, near);
    sea.put(near, {2, 0.5F, 0});
    EXPECT_EQ(sea.perceived(0).predatorCount, 2U) << "above the line of sight";
}

TEST(Sight, aDuneHides) {
    Sea sea;
    Environment environment;
    Grids grids = sea.freshGrids();
    environment = sea.environment(grids);
    // Between two points just over the sand, with the sand higher in between.
    const place::PlaceKey& place = sea.surroundings.obstacles.place;
    bool hidden = false;
    bool open = true;
    for (float x = -6; x < 6; x += 0.5F) {
        const glm::vec3 from{x, place::floorHeight(place, {x, -5}) + 0.02F, -5};
        const glm::vec3 to{x + 4, place::floorHeight(place, {x + 4, -5}) + 0.02F, -5};
        hidden = hidden || isHidden(environment, 0, 1, {from, to - from});
        const glm::vec3 above{0, 1.5F, 0};
        open = open && !isHidden(environment, 0, 1, {from + above, to - from});
    }
    EXPECT_TRUE(hidden);
    EXPECT_TRUE(open);
}

TEST(Prey, isTheOneOfLeastCost) {
    Sea sea;
    const std::uint32_t shark = sea.addShark({3, 0, 0});
    sea.head(shark, {-1, 0, 0});
    sea.put(0, {0, 0, 0});  // 3 m straight ahead
    const std::uint32_t aside = sea.addFish({3, 0, 2.9F});
    sea.speciesParameters[kScad].last = aside + 1;
    // d (1 + b2 E / pi): 2.9 (1 + 0.2 / 2) = 3.19 against 3.
    EXPECT_EQ(sea.perceived(shark).prey.object, 0U);
    sea.view.signs[0] = fish::kSchooling;  // 3 (1 + 0.5)
    EXPECT_EQ(sea.perceived(shark).prey.object, aside);
    sea.view.signs[aside] = fish::kAway;
    EXPECT_EQ(sea.perceived(shark).prey.object, 0U);
}

TEST(Prey, isKeptUnlessAnotherIsBetterByThePersistence) {
    Sea sea;
    const std::uint32_t shark = sea.addShark({3, 0, 0});
    sea.head(shark, {-1, 0, 0});
    const std::uint32_t other = sea.addFish({0.6F, 0, 0});
    sea.speciesParameters[kShark].habits.persistence = 0.3F;
    EXPECT_EQ(sea.perceived(shark).prey.object, other);
    sea.alter(shark, [](fish::Mind& mind) {
        mind.intention = fish::Intention::Eat;
        mind.target = 0;
    });
    EXPECT_EQ(sea.perceived(shark).prey.object, 0U) << "2.4 is not 0.3 better than 3";
    sea.put(other, {1.2F, 0, 0});
    EXPECT_EQ(sea.perceived(shark).prey.object, other);
}

TEST(Prey, isNotSoughtByTheSatedNorBeyondTheDistanceOfGivingUp) {
    Sea sea;
    const std::uint32_t shark = sea.addShark({3, 0, 0});
    sea.head(shark, {-1, 0, 0});
    EXPECT_TRUE(sea.perceived(shark).prey.seen());
    sea.speciesParameters[kShark].habits.hunt.giveUpMetres = 2.5;
    EXPECT_FALSE(sea.perceived(shark).prey.seen());
    sea.speciesParameters[kShark].habits.hunt.giveUpMetres = 6;
    sea.alter(shark, [](fish::Mind& mind) {
        mind.eaten = 4;
        mind.sinceMeal = 0;
    });
    EXPECT_FALSE(sea.perceived(shark).prey.seen());
}

TEST(Food, isSmeltInEveryDirectionByTheHungry) {
    Sea sea;
    sea.feed({{-2, 0, 0}, {2.5F, 0, 0}});
    EXPECT_FALSE(sea.perceived(0).food.seen()) << "gorged";
    sea.alter(0, [](fish::Mind& mind) { mind.eaten = 0; });
    const Senses senses = sea.perceived(0);
    EXPECT_EQ(senses.food.object, 0U) << "behind it, but nearer";
    EXPECT_NEAR(senses.food.distance, 2, 1e-5F);
}

// What is too far off to make a fed fish hungry is not looked for.
TEST(Food, temptsTheFedFromNearbyAlone) {
    Sea sea;
    sea.alter(0, [](fish::Mind& mind) { mind.eaten = 4; });
    sea.feed({{1.5F, 0, 0}});
    EXPECT_FALSE(sea.perceived(0).food.seen());
    sea.feed({{0.5F, 0, 0}});
    EXPECT_TRUE(sea.perceived(0).food.seen());
}

TEST(Food, thatIsPursuedIsKeptWhileItIsThere) {
    Sea sea;
    sea.alter(0, [](fish::Mind& mind) {
        mind.eaten = 0;
        mind.intention = fish::Intention::Eat;
        mind.target = 0;
    });
    sea.feed({{1.0F, 0, 0}, {0, 0, 0.8F}});
    EXPECT_EQ(sea.perceived(0).food.object, 0U);
    sea.surroundings.food.kind[0] = surroundings::FoodKind::None;
    EXPECT_EQ(sea.perceived(0).food.object, 1U);
}

TEST(Submarine, isFelt) {
    Sea sea;
    sea.surroundings.submarine.position = Aquarium::kCentre + glm::vec3{0, 0, 4};
    EXPECT_NEAR(sea.perceived(0).submarineMetres, 4, 1e-5F);
}

// Two and a half metres off no fish minds one that stands; one that comes on it does, from behind.
TEST(Submarine, isFeltFromFartherWhereItComesOn) {
    Sea sea;
    surroundings::Submarine& submarine = sea.surroundings.submarine;
    const glm::vec3 heading = sea.perceived(0).heading;
    submarine.position = sea.perceived(0).position - heading * 2.5F;
    EXPECT_EQ(sea.perceived(0).urgency, 0);
    submarine.velocityMetresPerSecond = heading * 1.2F;
    EXPECT_GT(sea.perceived(0).urgency, 0);
    EXPECT_GT(place::dot(sea.perceived(0).push, heading), 0) << "ahead of it";
    submarine.velocityMetresPerSecond = heading * -1.2F;
    EXPECT_EQ(sea.perceived(0).urgency, 0) << "it goes away";
}

}  // namespace
}  // namespace aquarama::behaviour
