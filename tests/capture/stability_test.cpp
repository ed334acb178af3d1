// SPDX-License-Identifier: Apache-2.0
// Fish that swim on and on: every gait of every species, with bodies that are not quite symmetric.
// With AQUARAMA_SOAK in the environment for an hour each.
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/swimmer.h"
#include "tests/capture/course.h"
#include "tests/support/all_species.h"

namespace aquarama::capture {
namespace {

// By then the slowest of them, the trumpetfish, swims at its speed.
constexpr double kWarmUpOwnSeconds = 120;
constexpr double kStretchOwnSeconds = 20;

int stretchesOf(const BiomechanicalFish& fish) {
    constexpr double kHour = 3600;
    return std::getenv("AQUARAMA_SOAK") == nullptr
               ? 1
               : static_cast<int>(kHour * fish.timeScale / kStretchOwnSeconds);
}

// A fish as none was drawn: each coordinate of each node out of place, by 1e-3 body lengths RMS.
BiomechanicalFish crooked(const config::Species& species) {
    BiomechanicalFish fish = makeBiomechanicalFish(species);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-1.7e-3, 1.7e-3);
    for (glm::dvec3& x : fish.restPositions)
        x += glm::dvec3(shift(random), shift(random), shift(random));
    for (Spring& spring : fish.springs)
        spring.restLength = glm::distance(fish.restPositions.at(spring.first),
                                          fish.restPositions.at(spring.second));
    return fish;
}

double largestDistance(const NodeVectors& a, const NodeVectors& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, glm::distance(a.at(i), b.at(i)));
    return most;
}

using SpeciesAndGait = std::tuple<std::size_t, config::Gait config::Swim::*>;
class EveryGait : public testing::TestWithParam<SpeciesAndGait> {
  protected:
    // Steps that divide the beat, so that poses of one phase can be compared.
    static Swimmer balancing(const BiomechanicalFish& fish,
                             const config::Species& species,
                             const config::Gait& gait) {
        const double steps = std::ceil(1 / (gait.beatHertz * longestStepSeconds(fish)));
        Swimmer swimmer(fish, species, 1 / (gait.beatHertz * steps));
        swimmer.give({.controller = Controller::Balance, .gait = gait});
        return swimmer;
    }
};

TEST_P(EveryGait, isSwumOnAndOnUprightAtOneSpeedInOnePose) {
    const auto [index, which] = GetParam();
    const config::Species& species = test::allSpecies().at(index);
    const config::Gait& gait = species.swim.*which;
    const BiomechanicalFish fish = crooked(species);
    Swimmer swimmer = balancing(fish, species, gait);
    const double ownSecond = 1 / fish.timeScale;
    const auto beatsIn = [&](double ownSeconds) {
        return std::ceil(ownSeconds * ownSecond * gait.beatHertz) / gait.beatHertz;
    };
    advanceSeconds(swimmer, beatsIn(kWarmUpOwnSeconds));
    const double speed = glm::length(courseOver(swimmer, 1 / gait.beatHertz).velocity);
    const NodeVectors pose = inBodyFrame(swimmer.state().positions);

    for (int i = 0; i < stretchesOf(fish); ++i) {
        const Course course = courseOver(swimmer, beatsIn(kStretchOwnSeconds));
        ASSERT_LT(course.mostRollRadians, 5 * kDegree);
        ASSERT_LT(std::abs(course.meanPitchRadians), 5 * kDegree);
    }
    EXPECT_NEAR(glm::length(courseOver(swimmer, 1 / gait.beatHertz).velocity), speed, 0.01 * speed);
    EXPECT_LT(largestDistance(inBodyFrame(swimmer.state().positions), pose), 5e-3);
}

std::string nameOf(const testing::TestParamInfo<SpeciesAndGait>& info) {
    const auto [index, which] = info.param;
    const std::string gait = which == &config::Swim::slow     ? "slow"
                             : which == &config::Swim::medium ? "medium"
                                                              : "fast";
    return test::allSpecies().at(index).name + "_" + gait;
}

INSTANTIATE_TEST_SUITE_P(InEverySpecies,
                         EveryGait,
                         testing::Combine(testing::Range(std::size_t{0}, test::allSpecies().size()),
                                          testing::Values(&config::Swim::slow,
                                                          &config::Swim::medium,
                                                          &config::Swim::fast)),
                         nameOf);

}  // namespace
}  // namespace aquarama::capture
