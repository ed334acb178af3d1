// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/true_hall.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "calibration/hall/random_hall.h"
#include "common/base/log.h"
#include "common/wall/wall.h"

namespace aquarama::hall {
namespace {

// Calls visit(channel, pixel) for places all over the pictures of a rig.
template <class Visit>
void walkPictures(const config::Rig& rig, Visit visit) {
    constexpr int kSteps = 12;
    for (std::size_t channel = 0; channel < rig.channels.size(); ++channel)
        for (int y = 0; y < kSteps; ++y)
            for (int x = 0; x < kSteps; ++x)
                visit(channel,
                      glm::dvec2(x + 0.5, y + 0.5) / double{kSteps} *
                          glm::dvec2(rig.channels[channel].sizePixels));
}

// The hall of all random ones that a seed names, and its rig.
struct Theatre {
    explicit Theatre(std::uint32_t seed, double scale = 0.25)
        : rig(randomRig(seed, scale)), hall(randomHall(rig, seed, scale)), truth(rig, hall) {}
    config::Rig rig;
    config::Hall hall;
    TrueHall truth;
};

TEST(TrueHall, isTheWallOfItsRigWhereNothingIsWrong) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        const config::Rig rig = randomRig(seed, 0.25);
        const wall::Wall wall(rig);
        const TrueHall truth(rig, plainHall(rig, seed, 0.25));
        int hits = 0;
        walkPictures(rig, [&](std::size_t channel, glm::dvec2 pixel) {
            const auto point = truth.pointOf(channel, pixel);
            const auto expected = wall.channel(channel).pointOf(pixel, 0);
            ASSERT_EQ(point.has_value(), expected.has_value());
            if (!point) return;
            ++hits;
            ASSERT_LT(glm::distance(*point, *expected), 1e-9);
            ASSERT_LT(glm::distance(*truth.pixelOf(channel, *point),
                                    *wall.channel(channel).pixelOf(*point)),
                      1e-6);
            ASSERT_LT(glm::distance(truth.unrolled(*point), wall.screen().unrolled(*point)), 1e-9);
        });
        EXPECT_GT(hits, 300) << seed;
    }
}

TEST(TrueHall, pixelsAndPointsAreInverse) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        const Theatre theatre(seed);
        const TrueHall& truth = theatre.truth;
        walkPictures(theatre.rig, [&](std::size_t channel, glm::dvec2 pixel) {
            const auto point = truth.pointOf(channel, pixel);
            if (!point) return;
            const auto back = truth.pixelOf(channel, *point);
            ASSERT_TRUE(back.has_value());
            ASSERT_LT(glm::distance(*back, pixel), 1e-6);
            const auto seen = truth.cameraPixelOf(*point);
            ASSERT_TRUE(seen.has_value()) << seed;
            ASSERT_LT(glm::distance(*truth.pointSeen(*seen), *point), 1e-6);
        });
    }
}

TEST(TrueHall, bumpsAreAsHighAsIsSaid) {
    const Theatre theatre(3);
    const TrueScreen& screen = theatre.truth.screen();
    double highest = 0;
    for (const glm::dvec3& point : theatre.truth.screenPoints(20000)) {
        const auto foot = screen.shape().hit({{0, 0, 0}, point}, 0.1);
        ASSERT_TRUE(foot.has_value());
        highest = std::max(highest, std::abs(screen.heightAt(*foot)));
    }
    EXPECT_GT(highest, theatre.hall.screen.bumpMetres * 0.9);
    EXPECT_LT(highest, theatre.hall.screen.bumpMetres * 1.02 + 0.008);
}

// The slope of the bumps, against differences of heights.
TEST(TrueHall, normalsStandOnTheBumpyScreen) {
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        const Theatre theatre(seed);
        const TrueScreen& screen = theatre.truth.screen();
        for (const glm::dvec3& point : theatre.truth.screenPoints(100)) {
            const glm::dvec3 normal = screen.normalAt(point);
            const glm::dvec3 aside = glm::normalize(glm::cross(normal, {0.3, 0.8, 0.1}));
            constexpr double kStep = 1e-4;
            const auto next = screen.hit({point + 0.1 * normal + kStep * aside, -normal});
            const auto before = screen.hit({point + 0.1 * normal - kStep * aside, -normal});
            if (!next || !before) continue;
            EXPECT_LT(std::abs(glm::dot(*next - *before, normal)), 2e-4 * 2 * kStep);
        }
    }
}

// A viewer sees a raised point in front of another place of the picture than a person before the
// screen would say.
TEST(TrueHall, thePanoramaIsForTheSweetSpot) {
    config::Rig rig = randomRig(1, 0.25);
    rig.screen = {.shape = config::ScreenShape::Flat,
                  .widthMetres = 4,
                  .heightMetres = 2,
                  .distanceMetres = 4};
    config::Hall hall;
    hall.projectors.resize(rig.channels.size());
    hall.camera.sizePixels = {100, 100};
    hall.camera.focalPixels = 100;
    const TrueHall truth(rig, hall);
    const glm::dvec2 place = truth.unrolled({1, 0, -2});
    EXPECT_NEAR(place.x, 1.0, 1e-12);
    EXPECT_NEAR(place.y, 0.5, 1e-12);
}

TEST(TrueHall, aDistortedLensGoesBothWays) {
    LensTruth truth{.focal = {1000, 1000}, .principal = {500, 300}, .size = {1000, 700}};
    truth.lens = {.distortion = {-0.05, 0.02, 0.01, 0.002, -0.003}, .vignetting = 0.2};
    truth.keystone = {0.1, -0.05};
    const TrueLens lens(truth);
    for (int y = 0; y <= 700; y += 100)
        for (int x = 0; x <= 1000; x += 100) {
            const wall::Ray ray = lens.ray({x, y});
            const auto back = lens.pixelOf(ray.origin + 2.0 * ray.direction);
            const bool isEdge = x == 0 || y == 0 || x == 1000 || y == 700;
            EXPECT_TRUE(back ? glm::distance(*back, glm::dvec2(x, y)) < 1e-9 : isEdge);
        }
}

// Keystone keeps the picture on the panel, and one of its corners where it is.
TEST(TrueHall, keystoneShrinksThePicture) {
    LensTruth truth{.focal = {1000, 1000}, .principal = {500, 300}, .size = {1000, 600}};
    const TrueLens straight(truth);
    truth.keystone = {0.2, 0.1};
    const TrueLens bent(truth);
    int kept = 0;
    for (const glm::dvec2 corner : {glm::dvec2(0), {1000, 0}, {0, 600}, {1000, 600}}) {
        const auto at = straight.pixelOf(bent.ray(corner).origin + bent.ray(corner).direction);
        if (!at || glm::distance(*at, corner) < 1e-6) ++kept;
    }
    EXPECT_EQ(kept, 1);
}

// On a flat wall that it faces, a projector's light falls off with the square of the distance only.
TEST(TrueHall, lightFallsOffWithTheSquareOfTheDistance) {
    const TrueLens lens(
        LensTruth{.focal = {1000, 1000}, .principal = {500, 300}, .size = {1000, 600}});
    EXPECT_NEAR(lens.lightAt({0, 0, -1}), 1, 1e-12);
    EXPECT_NEAR(lens.lightAt({0, 0, -2}), 0.25, 1e-12);
    const glm::dvec3 aside(0.4, 0.2, -1);
    const double cosine = 1 / glm::length(aside);  // of the wall against the light
    EXPECT_NEAR(lens.lightAt(aside) * cosine, 1, 1e-12);
}

// Two pixels of one picture have the same light, wherever they fall: that of an area is the number
// of pixels that it gets.
TEST(TrueHall, noLightIsLostInTheLens) {
    LensTruth truth{.focal = {1000, 1000}, .principal = {500, 300}, .size = {1000, 600}};
    truth.lens.distortion = {0.1, -0.02, 0.03, 0.01, 0.004};
    const TrueLens lens(truth);
    const auto onWall = [&](glm::dvec2 pixel) {
        const wall::Ray ray = lens.ray(pixel);
        return glm::dvec2(ray.direction) / -ray.direction.z;
    };
    const glm::dvec2 at(850, 100);
    const glm::dvec2 right = onWall(at + glm::dvec2(1, 0)) - onWall(at - glm::dvec2(1, 0));
    const glm::dvec2 down = onWall(at + glm::dvec2(0, 1)) - onWall(at - glm::dvec2(0, 1));
    const double area = std::abs(right.x * down.y - right.y * down.x) / 4 * 1e6;
    const glm::dvec3 point(onWall(at), -1);
    EXPECT_NEAR(lens.lightAt(point) / glm::length(point), 1 / area, 1e-5);
}

TEST(TrueHall, refusesWhatIsNotProjected) {
    config::Rig rig = randomRig(1, 0.25);
    const config::Hall hall = plainHall(rig, 1, 0.25);
    rig.channels[1].panel.emplace();
    EXPECT_THROW(TrueHall(rig, hall), Error);
}

// The picture of a channel is followed through the cables.
TEST(TrueHall, cablesAndSizesAreFollowed) {
    const Theatre theatre(2);
    config::Hall hall = theatre.hall;
    hall.faults.swapped = {0, 1};
    const TrueHall swapped(theatre.rig, hall);
    const glm::dvec2 pixel(200, 120);
    EXPECT_EQ(swapped.pointOf(0, pixel), theatre.truth.pointOf(1, pixel));

    hall = theatre.hall;
    const glm::ivec2 size = theatre.rig.channels[0].sizePixels;
    hall.faults.mode = {0, {size.x / 2, size.y / 4}};
    const TrueHall squeezed(theatre.rig, hall);
    EXPECT_EQ(squeezed.panelFrom(0, {0, 0}), glm::dvec2(0, size.y / 4.0));
    EXPECT_EQ(squeezed.panelFrom(0, size), glm::dvec2(size.x, size.y * 0.75));
    EXPECT_EQ(squeezed.pictureFrom(0, squeezed.panelFrom(0, pixel)), pixel);
}

TEST(TrueHall, aFlatScreenHangsWhereACurvedOneIsMeant) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        const config::Rig rig = randomRig(seed, 0.25);
        config::Hall hall = plainHall(rig, seed, 0.25);
        hall.faults.flatScreen = true;
        const TrueHall truth(rig, hall);
        const auto points = truth.screenPoints(100);
        ASSERT_GT(points.size(), 60U);
        const glm::dvec3 normal = truth.screen().normalAt(points[0]);
        for (const glm::dvec3& point : points)
            EXPECT_NEAR(glm::dot(point - points[0], normal), 0, 1e-9);
    }
}

}  // namespace
}  // namespace aquarama::hall
