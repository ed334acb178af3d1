// SPDX-License-Identifier: Apache-2.0
// Light in halls: closed forms.
#include <cmath>
#include <numbers>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "calibration/hall/bounce.h"
#include "calibration/hall/hall_view.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"

namespace aquarama::hall {
namespace {

// Four projectors that face a flat wall squarely, and a camera.
config::Rig flatRig() {
    for (std::uint32_t seed = 0;; ++seed) {
        config::Rig rig = randomRig(seed, 0.1);
        if (rig.screen.shape == config::ScreenShape::Flat) return rig;
    }
}

int channelsAt(const TrueHall& hall, glm::dvec3 point) {
    int lit = 0;
    for (std::size_t i = 0; i < hall.channels(); ++i) lit += hall.pixelOf(i, point) ? 1 : 0;
    return lit;
}

// Whether the pixel and those beside it lie on the screen and have one number of channels.
bool isEven(const TrueHall& hall, glm::dvec2 pixel, int& lit) {
    lit = -1;
    for (const glm::dvec2 step : {glm::dvec2(-2), {2, -2}, {-2, 2}, glm::dvec2(2)}) {
        const auto point = hall.pointSeen(pixel + step);
        if (!point) return false;
        const int here = channelsAt(hall, *point);
        if (lit >= 0 && here != lit) return false;
        lit = here;
    }
    return true;
}

TEST(HallLight, aGreyFieldIsEvenOnAFlatWall) {
    const config::Rig rig = flatRig();
    const TrueHall hall(rig, plainHall(rig, 1, 0.1));
    std::vector<Light> grey;
    for (const config::Channel& channel : rig.channels) {
        grey.push_back(darkness(channel.sizePixels));
        for (glm::vec3& light : grey.back().rgb) light = glm::vec3(0.25F, 0.5F, 0.125F);
    }
    const Light view = seen(hall, grey, hall.cameraLens());
    int looked = 0;
    for (int y = 0; y < view.sizePixels.y; ++y)
        for (int x = 0; x < view.sizePixels.x; ++x) {
            int lit = 0;
            if (!isEven(hall, glm::dvec2(x, y) + 0.5, lit)) continue;
            ++looked;
            ASSERT_NEAR(view.at(x, y).r, 0.25 * lit, 1e-5);
            ASSERT_NEAR(view.at(x, y).g, 0.5 * lit, 1e-5);
            ASSERT_NEAR(view.at(x, y).b, 0.125 * lit, 1e-5);
        }
    EXPECT_GT(looked, 10000);
}

// Every part of a sphere sees every other one alike: one bounce of an even light is even, and the
// share of it is the part's share of the sphere.
TEST(HallLight, oneBounceInADomeIsEven) {
    config::Rig rig = flatRig();
    for (const double opening : {90.0, 180.0, 260.0}) {
        rig.screen = {.shape = config::ScreenShape::Dome,
                      .radiusMetres = 3,
                      .arcRadians = opening / 180 * std::numbers::pi};
        config::Hall hall = plainHall(randomRig(6, 0.1), 1, 0.1);
        hall.projectors.resize(rig.channels.size());
        hall.screen.bounces = true;
        const TrueHall truth(rig, hall);
        const Bounce bounce(truth);
        const Light falls = bounce.of(std::vector<glm::vec3>(bounce.patches(), glm::vec3(2)));
        const double share = (1 - std::cos(rig.screen.arcRadians / 2)) / 2;
        for (const glm::vec3& light : falls.rgb)
            EXPECT_NEAR(double(light.g) / (2 * share), 1, 0.04);
    }
}

TEST(HallLight, aFlatWallDoesNotLightItself) {
    const config::Rig rig = flatRig();
    config::Hall hall = plainHall(rig, 1, 0.1);
    hall.screen.bounces = true;
    const TrueHall truth(rig, hall);
    const Bounce bounce(truth);
    const Light falls = bounce.of(std::vector<glm::vec3>(bounce.patches(), glm::vec3(1)));
    for (const glm::vec3& light : falls.rgb) EXPECT_LT(light.g, 1e-6F);
}

TEST(HallLight, responsesKeepBlackAndWhiteAndBendBetween) {
    config::HallProjector projector;
    EXPECT_NEAR(lightOfCode(projector, glm::vec3(0.5F)).g, linearFromSrgb(0.5), 1e-6);
    projector.gamma = {2.2, 2.0, 2.4};
    EXPECT_NEAR(lightOfCode(projector, glm::vec3(0.5F)).b, std::pow(0.5, 2.4), 1e-6);
    projector.toe = 0.05;
    projector.knee = 0.2;
    EXPECT_GT(lightOfCode(projector, glm::vec3(0.02F)).g, std::pow(0.02, 2.0));
    float before = -1;
    for (int code = 0; code <= 255; ++code) {
        const float light = lightOfCode(projector, glm::vec3(static_cast<float>(code) / 255)).r;
        EXPECT_GT(light, before);
        before = light;
    }
    EXPECT_NEAR(before, 1, 1e-6);
    projector.black = 0.01;
    EXPECT_NEAR(lightOfCode(projector, glm::vec3(0)).g, 0.01, 1e-6);
    EXPECT_NEAR(lightOfCode(projector, glm::vec3(1)).g, 1, 1e-6);
    projector.primaries[0][1] = 0.1;  // green has some of red
    EXPECT_NEAR(lightOfCode(projector, {1, 0, 0}).g, 0.1 + 0.01, 1e-6);
}

// A light on the screen from anywhere is what the view of a camera has there.
TEST(HallLight, theLitScreenIsWhatAnEyeSees) {
    const config::Rig rig = randomRig(5, 0.1);
    config::Hall bare = randomHall(rig, 5, 0.1);
    bare.screen.marksOffMetres.clear();  // tape is on the view alone, as it is taken off
    const TrueHall hall(rig, bare);
    std::vector<Light> pictures;
    for (const config::Channel& channel : rig.channels) {
        pictures.push_back(darkness(channel.sizePixels));
        for (int y = 0; y < channel.sizePixels.y; ++y)
            for (int x = 0; x < channel.sizePixels.x; ++x)
                pictures.back().at(x, y) =
                    glm::vec3(0.5F + 0.4F * std::sin(0.05F * static_cast<float>(x + y)));
    }
    const Light view = seen(hall, pictures, hall.cameraLens());
    const LitScreen screen(hall, pictures);
    int looked = 0;
    for (const glm::dvec3& point : hall.screenPoints(2000)) {
        const auto pixel = hall.cameraPixelOf(point);
        int lit = 0;
        if (!pixel || !isEven(hall, *pixel, lit)) continue;
        ++looked;
        EXPECT_NEAR(bilinear(view, *pixel).g, screen.at(point).g, 0.02);
    }
    EXPECT_GT(looked, 1000);
}

}  // namespace
}  // namespace aquarama::hall
