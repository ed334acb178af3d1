// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/random_hall.h"

#include <map>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "calibration/hall/true_hall.h"
#include "common/wall/scan_pattern.h"
#include "common/wall/wall.h"

namespace aquarama::hall {
namespace {

constexpr std::uint32_t kSeeds = 18;

TEST(RandomHall, rigsMakeWalls) {
    std::map<config::ScreenShape, int> shapes;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const config::Rig rig = randomRig(seed, 0.25);
        ++shapes[rig.screen.shape];
        EXPECT_NO_THROW(wall::checkGeometry(rig, "random")) << seed;
        EXPECT_GE(rig.channels.size(), 3U);
        EXPECT_LE(rig.channels.size(), 6U);
        EXPECT_LE(rig.panoramaPixels.x, 1000);
        EXPECT_GT(rig.panoramaPixels.x, 250);
    }
    EXPECT_EQ(shapes.size(), 3U);
    for (const auto& [shape, count] : shapes) EXPECT_GE(count, 3);
}

// Channels of one seed hang as they do at full size.
TEST(RandomHall, scaleChangesPixelsOnly) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        const config::Rig large = randomRig(seed), small = randomRig(seed, 0.25);
        const TrueHall there(large, randomHall(large, seed));
        const TrueHall here(small, randomHall(small, seed, 0.25));
        const auto one = there.pointOf(0, glm::dvec2(large.channels[0].sizePixels) / 2.0);
        const auto other = here.pointOf(0, glm::dvec2(small.channels[0].sizePixels) / 2.0);
        ASSERT_TRUE(one && other);
        EXPECT_LT(glm::distance(*one, *other), 0.01) << seed;
    }
}

TEST(RandomHall, crookedHallsAreWhollyLitAndSeen) {
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const config::Rig rig = randomRig(seed, 0.25);
        const TrueHall truth(rig, randomHall(rig, seed, 0.25));
        double lit = 0;
        const auto points = truth.screenPoints(1500);
        for (const glm::dvec3& point : points) {
            int lights = 0;
            for (std::size_t i = 0; i < truth.channels(); ++i)
                lights += truth.pixelOf(i, point) ? 1 : 0;
            EXPECT_GT(lights, 0) << seed;
            lit += lights;
            EXPECT_TRUE(truth.cameraPixelOf(point)) << seed;
        }
        // They overlap, but not all over.
        EXPECT_GT(lit / double(points.size()), 1.05) << seed;
        EXPECT_LT(lit / double(points.size()), 2.2) << seed;
        for (const glm::dvec3& point : truth.outline())
            ASSERT_TRUE(truth.cameraPixelOf(point)) << seed;
    }
}

// Decoders read them.
TEST(RandomHall, tagsOfPatternsFallOnTheScreen) {
    for (std::uint32_t seed = 0; seed < 2 * kSeeds; ++seed) {
        const config::Rig rig = randomRig(seed, 0.25);
        const TrueHall truth(rig, randomHall(rig, seed, 0.25));
        for (std::size_t i = 0; i < truth.channels(); ++i) {
            const auto [cell, corner] = wall::scanTagPlace(rig.channels[i].sizePixels);
            const glm::dvec2 size(wall::kScanTagCells * cell, cell);
            for (const glm::dvec2 part : {glm::dvec2(0), {1, 0}, {0, 1}, glm::dvec2(1)})
                EXPECT_TRUE(truth.pointOf(i, glm::dvec2(corner) + part * size)) << seed << " " << i;
        }
    }
}

// As crooked as a touring crew leaves it: tens of pixels.
TEST(RandomHall, picturesFallBesideWhereTheyAreMeant) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const config::Rig rig = randomRig(seed);
        const wall::Wall wall(rig);
        const TrueHall truth(rig, randomHall(rig, seed));
        double sum = 0;
        int count = 0;
        for (const glm::dvec3& point : truth.screenPoints(300))
            for (std::size_t i = 0; i < truth.channels(); ++i) {
                const auto is = truth.pixelOf(i, point), meant = wall.channel(i).pixelOf(point);
                if (!is || !meant) continue;
                sum += glm::distance(*is, *meant);
                ++count;
            }
        EXPECT_GT(sum / count, 8) << seed;
        EXPECT_LT(sum / count, 120) << seed;
    }
}

TEST(RandomHall, oneSeedIsOneHall) {
    const config::Rig rig = randomRig(7, 0.25);
    const TrueHall one(rig, randomHall(rig, 7, 0.25)), same(rig, randomHall(rig, 7, 0.25));
    const TrueHall other(rig, randomHall(rig, 8, 0.25));
    EXPECT_EQ(one.pointOf(1, {100, 100}), same.pointOf(1, {100, 100}));
    EXPECT_NE(one.pointOf(1, {100, 100}), other.pointOf(1, {100, 100}));
}

}  // namespace
}  // namespace aquarama::hall
