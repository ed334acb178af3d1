// SPDX-License-Identifier: Apache-2.0
// Food is eaten, hunger falls, and a school that feeds stays one.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "common/motion/reconstruct.h"
#include "common/place/place.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr glm::vec3 kMiddle{0, -5.5F, -5};

WorldSpecies hungry(WorldSpecies species, double radiusMetres) {
    species.start = config::Start{.centre = kMiddle, .radiusMetres = radiusMetres, .hunger = 0.8};
    return species;
}

float hungerOf(const World& world, std::uint32_t fish) {
    return fish::innerHunger(world.speciesParameters()[world.view().kind[fish]],
                             world.minds()[fish]);
}

glm::vec3 middleOf(const World& world) {
    glm::vec3 sum{};
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        sum += world.view().position(fish);
    return sum / static_cast<float>(world.view().size());
}

float polarisation(const World& world) {
    glm::vec3 sum{};
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        sum += world.view().heading(fish);
    return place::lengthOf(sum) / static_cast<float>(world.view().size());
}

TEST(Eat, ASchoolEatsAPinchOfPelletsWithinAMinuteAndFormsAgain) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        WorldOptions options = openWater(seed, {hungry(scads(51), 1)});
        options.scene.gathering = config::Gathering::None;
        World world(options);
        for (int i = 0; i < 300; ++i) world.advance();
        world.apply(DropFood{middleOf(world) + glm::vec3{0.5F, 0.5F, 0}, 12});
        for (int i = 0; i < 3600; ++i) world.advance();
        EXPECT_EQ(world.counts().meals, 12U) << "seed " << seed;
        float best = 0;
        for (int i = 0; i < 1800; ++i) {
            world.advance();
            best = std::max(best, polarisation(world));
        }
        EXPECT_GT(best, 0.8F) << "seed " << seed;
    }
}

TEST(Eat, AMealIsInOneStomachAndHungerFalls) {
    World world(openWater(1, {hungry(scads(20), 0.6)}));
    world.apply(DropFood{kMiddle + glm::vec3{0.5F, 0, 0}, 60});
    float before = 0;
    for (std::uint32_t fish = 0; fish < 20; ++fish) before += hungerOf(world, fish);
    const auto eatenByEach = [&] {
        std::vector<std::uint16_t> eaten;
        for (std::uint32_t fish = 0; fish < 20; ++fish) eaten.push_back(world.minds()[fish].eaten);
        return eaten;
    };
    std::vector<std::uint16_t> eaten = eatenByEach();
    std::uint64_t fed = 0;
    std::uint64_t meals = 0;
    for (int i = 0; i < 1800; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 20; ++fish)
            if (world.minds()[fish].eaten > eaten[fish]) {
                ++fed;
                EXPECT_LT(world.minds()[fish].sinceMeal, fish::kTicksBetweenThoughts);
            }
        eaten = eatenByEach();
        meals = world.counts().meals;
        ASSERT_EQ(fed, meals) << "two fish were fed by one particle, or none";
    }
    EXPECT_GT(meals, 20U);
    float after = 0;
    for (std::uint32_t fish = 0; fish < 20; ++fish) after += hungerOf(world, fish);
    EXPECT_LT(after, 0.6F * before);
}

// The ticks of a world, with what the faces of its fish do in them.
class Faces {
  public:
    explicit Faces(World& world)
        : world_(world), fish_(world.traits().size()), ate_(fish_, kNever) {
        for (std::size_t fish = 0; fish < fish_; ++fish)
            eaten_.push_back(world.minds()[fish].eaten);
    }

    void advance() {
        const std::vector<std::uint8_t> mouth = world_.states().mouth, gaze = world_.states().gaze;
        world_.advance();
        ++ticks_;
        for (std::size_t fish = 0; fish < fish_; ++fish) {
            changes += world_.states().mouth[fish] != mouth[fish] ? 1U : 0U;
            changes += world_.states().gaze[fish] != gaze[fish] ? 1U : 0U;
            observe(fish);
        }
    }
    [[nodiscard]] double changesPerFishAndSecond() const {
        return static_cast<double>(changes) * 60 / static_cast<double>(fish_ * ticks_);
    }

    std::uint64_t changes = 0;  // bytes of records
    std::vector<int> atMeals;   // mouths, some ticks after each
    std::vector<int> idle;      // of fish that have eaten nothing for a second

  private:
    static constexpr std::uint64_t kNever = 1U << 30U;

    void observe(std::size_t fish) {
        const std::uint16_t eaten = world_.minds()[fish].eaten;
        ate_[fish] = eaten > eaten_[fish] ? 0 : ate_[fish] + 1;
        eaten_[fish] = eaten;
        const int mouth = world_.states().mouth[fish];
        if (ate_[fish] == 5) atMeals.push_back(mouth);
        if (ate_[fish] > 60 && ate_[fish] % 60 == 0) idle.push_back(mouth);
    }

    World& world_;
    std::size_t fish_;
    std::vector<std::uint16_t> eaten_;
    std::vector<std::uint64_t> ate_;
    std::uint64_t ticks_ = 0;
};

TEST(Eat, aFishSnapsAtEachMorselAndShutsItsMouthAgain) {
    World world(openWater(1, {hungry(scads(20), 0.6)}));
    world.apply(DropFood{kMiddle + glm::vec3{0.5F, 0, 0}, 60});
    Faces faces(world);
    for (int i = 0; i < 1800; ++i) faces.advance();
    ASSERT_GT(faces.atMeals.size(), 20U);
    for (const int mouth : faces.atMeals) EXPECT_GT(mouth, 100);
    const auto open = std::ranges::count_if(faces.idle, [](int mouth) { return mouth > 0; });
    EXPECT_LT(open * 20, std::ssize(faces.idle)) << "a snap that found nothing";
    std::cout << faces.changesPerFishAndSecond() << " bytes of mouth and gaze change a second\n";
    EXPECT_LT(faces.changesPerFishAndSecond(), 12) << "of 2400 that a record has in that time";
}

// The nose of fish 0, a scad, as it is seen: eq. 12 by the plain functions of the reconstruction.
glm::dvec3 noseOf(const World& world) {
    const motion::FishRecord record = motion::recordOf(world.states(), 0);
    const motion::PresentedFish seen = motion::present(record, record, 0, world.traits()[0]);
    body::NodalPoints nodes;
    motion::nodalPose(capturedRepertoire("bigeye_scad"), seen, nodes);
    const motion::BodyFrame frame = motion::bodyFrameOf(record);
    return glm::dvec3(frame.position) + glm::dquat(frame.rotation) * glm::dvec3(nodes[0]) *
                                            static_cast<double>(seen.lengthMetres);
}

// In a tenth of a second it comes by equal shares of the rest to the nose, which moves meanwhile.
TEST(Eat, AParticleIsDrawnToTheNoseInSightOfAll) {
    World world(openWater(1, {hungry(scads(1), 0.1)}));
    world.apply(DropFood{world.view().position(0) + glm::vec3{0.6F, 0, 0}, 60});
    const surroundings::Food& food = world.surroundings().food;
    const auto isTaken = [](std::uint8_t taken) { return taken != 0; };
    int drawn = 0;
    for (int i = 0; i < 3600; ++i) {
        world.advance();
        const auto one = std::ranges::find_if(food.taken, isTaken);
        if (one == food.taken.end()) continue;
        const auto particle = static_cast<std::size_t>(one - food.taken.begin());
        glm::dvec3 before(food.position(particle));
        EXPECT_LT(glm::distance(before, noseOf(world)), 0.4F * world.view().fish[0].length);
        for (int left = 6; left > 0; --left) {
            ASSERT_TRUE(food.isThere(particle));
            const glm::dvec3 towards = before + (noseOf(world) - before) / double(left);
            world.advance();
            if (left == 1) break;
            before = glm::dvec3(food.position(particle));
            EXPECT_LT(glm::distance(before, towards), 2e-6) << left << " ticks left";
            ++drawn;
        }
        EXPECT_FALSE(food.isThere(particle));
    }
    EXPECT_GE(drawn, 5) << "it ate nothing";
}

// Tangs on their own live on plankton.
TEST(Eat, ThoseWhoLiveAloneFindPlankton) {
    WorldOptions options = openWater(2, {hungry(pacifists(4), 1)});
    options.scene.plankton = 300;
    World world(options);
    for (int i = 0; i < 2 * 3600; ++i) world.advance();
    EXPECT_GE(world.counts().meals, 8U);
    for (std::uint32_t fish = 0; fish < 4; ++fish) EXPECT_LT(hungerOf(world, fish), 0.5F);
}

}  // namespace
}  // namespace aquarama::world
