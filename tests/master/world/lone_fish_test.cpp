// SPDX-License-Identifier: Apache-2.0
// A single fish that is lured to where it may not go.
#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/think.h"
#include "master/fish/secondary_controller.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

class LoneFish {
  public:
    LoneFish(const place::Obstacles& obstacles, glm::vec3 start, glm::vec3 lure)
        : grids_(obstacles.water, 1, 0), goal_{lure, {}} {
        surroundings_.obstacles = obstacles;
        surroundings_.submarine.position = {100, 0, 0};
        nature_.habits.shares.schooling = 1;
        nature_.last = 1;
        minds_.resize(1);
        minds_[0].likes = fish::kLikesSchooling;
        minds_[0].eaten = 1000;
        minds_[0].sinceMeal = 0;
        view_.resize(1);
        states_.resize(1);
        commands_.resize(1);
        courses_.resize(1);
        memory_.resize(1);
        view_.fish[0].length = 0.24F;
        motion::setBodyFrame(states_, 0, {start, {1, 0, 0, 0}});  // heads along +x
        states_.segment[0] = static_cast<std::uint8_t>(motion::Action::ForwardMedium);
        fish::startCommands(gaits_, 1, 0, 1, commands_, memory_);
    }

    glm::vec3 swim() {
        const glm::vec3 position = motion::bodyFrameOf(states_, 0).position;
        const glm::vec3 heading = motion::meanRotation(*tables_, states_, 0) * glm::vec3{1, 0, 0};
        view_.fish[0].position = position;
        view_.fish[0].heading = heading;
        view_.fish[0].speed = 2 * view_.fish[0].length;
        grids_.rebuild(view_, surroundings_.food, {&nature_, 1});
        if (fish::thinksAt(tick_, 0)) {
            behaviour::think(environment(), 0, minds_, courses_, events_);
            thought_[0] = 1;
        }
        fish::SecondaryController{
            &gaits_, &view_, &courses_, &states_, &thought_, 1, tick_, &commands_, &memory_}
            .run(0, 1);
        motion::MotorStep{tables_.get(), traits_, &commands_, &states_, 0, 1}.run();
        ++tick_.value;
        return motion::bodyFrameOf(states_, 0).position;
    }

  private:
    [[nodiscard]] behaviour::Environment environment() const {
        return {.view = &view_,
                .grids = &grids_,
                .surroundings = &surroundings_,
                .speciesParameters = {&nature_, 1},
                .gathering = config::Gathering::None,
                .goal = goal_,
                .schoolRadiusMetres = 0.3F,
                .seed = 1,
                .tick = tick_,
                .adaptation = {}};
    }

    std::shared_ptr<const motion::MotorTables> tables_ = capturedTables("bigeye_scad");
    fish::Gaits gaits_ = fish::gaitsOf(*tables_);
    std::array<motion::FishTraits, 1> traits_{{{0, 240}}};
    surroundings::Surroundings surroundings_;
    fish::SpeciesParameters nature_;
    behaviour::Grids grids_;
    fish::Minds minds_;
    std::vector<std::uint8_t> thought_{0};
    behaviour::DeferredEvents events_;
    surroundings::Goal goal_;
    fish::FishView view_;
    motion::MotionStates states_;
    motion::MotorCommands commands_;
    fish::Courses courses_;
    fish::ControllerMemory memory_;
    Tick tick_;
};

const place::Obstacles kOpenWater{{3}, {{0, -5, -5}, {4, 2.5F, 3}}, {}};

TEST(LoneFish, turnsInTimeBeforeEveryWall) {
    for (const glm::vec3 lure : {glm::vec3{20, -5, -5},
                                 glm::vec3{-20, -5, -5},
                                 glm::vec3{0, -5, 15},
                                 glm::vec3{0, -5, -25},
                                 glm::vec3{0, 5, -5},
                                 glm::vec3{0, -15, -5}}) {
        LoneFish fish(kOpenWater, kOpenWater.water.centre, lure);
        for (int tick = 0; tick < 60 * 60; ++tick) {
            const glm::vec3 out =
                glm::abs(fish.swim() - kOpenWater.water.centre) - kOpenWater.water.halfExtent;
            ASSERT_LT(std::max({out.x, out.y, out.z}), 0.25F)
                << "lured to " << lure.x << " " << lure.y << " " << lure.z << ", tick " << tick;
        }
    }
}

TEST(LoneFish, goesRoundARockOnItsWay) {
    for (const float aside : {-0.4F, -0.1F, 0.0F, 0.2F, 0.5F}) {
        place::Obstacles obstacles = kOpenWater;
        obstacles.rocks = {{{0.5F, -5, -5 + aside}, 0.6F, 1}};
        LoneFish fish(obstacles, {-2.5F, -5, -5}, {2.5F, -5, -5});
        float nearest = 99;
        float farthest = -99;
        for (int tick = 0; tick < 30 * 60; ++tick) {
            const glm::vec3 position = fish.swim();
            nearest = std::min(nearest, place::lengthOf(position - obstacles.rocks[0].centre));
            farthest = std::max(farthest, position.x);
        }
        EXPECT_GT(nearest, 0.6F) << "rock " << aside << " m aside";
        EXPECT_GT(farthest, 1.5F) << "and it gets past";
    }
}

}  // namespace
}  // namespace aquarama::world
