// SPDX-License-Identifier: Apache-2.0
// The Monte Carlo of light in the sea against what is known without it, and the table that was made
// of it against the Monte Carlo. All types, at length: aquarama_trace_water --compare.
#include "tests/support/water_light.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/units.h"
#include "render_node/water/water_tables.h"
#include "tests/support/water_comparison.h"

namespace aquarama::test {
namespace {

const glm::dvec3 kSun{scene::sunInWater()};

const ForwardPhase& phase() {
    static const ForwardPhase instance;
    return instance;
}

// Mobley, Sundman and Boss 2002: 1.83 % of what Petzold's particles scatter goes back.
TEST(ForwardPhase, goesForwardAsParticlesOfTheSeaDo) {
    EXPECT_NEAR(1 - phase().shareWithin(90 * kDegree), 0.0183, 0.002);
    EXPECT_NEAR(phase().shareWithin(1 * kDegree), 0.25, 0.03);
    EXPECT_NEAR(phase().shareWithin(10 * kDegree), 0.71, 0.03);
}

TEST(MonteCarlo, withoutScatteringItIsBeersLaw) {
    EXPECT_EQ(scatteredIn(phase(), {0.0, 2.0, {0, 0, -1}, 3.0}, kSun, 100, 1).mean, 0);
    EXPECT_NEAR(transmitted(phase(), 0.0, 0.7, 0.1, 40000, 1).mean, std::exp(-0.7), 0.01);
}

// Little scattering: what comes from the sun by one scattering is an integral along the ray.
TEST(MonteCarlo, ofOneScatteringItIsTheIntegral) {
    constexpr double kAlbedo = 0.01;
    const glm::dvec3 way = glm::normalize(glm::dvec3{0.5, -0.2, -0.6});
    const Estimate light = scatteredIn(phase(), {kAlbedo, 1.0, way, 2.0}, kSun, 100000, 1);
    double sum = 0;
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
        const double s = 2.0 * (i + 0.5) / kSteps;
        sum += std::exp(-s - (1.0 - way.y * s) / kSun.y) * 2.0 / kSteps;
    }
    const double once = kAlbedo * 0.8 / kSun.y * phase().towardsSun(glm::dot(way, kSun)) * sum;
    // The sky adds some: by the same scattering, a quarter of the sun's light from wider about.
    EXPECT_GT(light.mean, once);
    EXPECT_LT(light.mean, 1.8 * once);
}

// The exponent of the way to the eye, a + 0.51 b, is this: what is scattered by less than the size
// of a detail stays in its picture.
TEST(MonteCarlo, aboutHalfOfTheScatteredLightStaysInThePicture) {
    constexpr double kDetail = 0.02;
    for (const double albedo : {0.4, 0.75}) {
        const double arrived = transmitted(phase(), albedo, 1.5, kDetail, 40000, 3).mean;
        const double stays = (1 + std::log(arrived) / 1.5) / albedo;
        EXPECT_NEAR(stays, scene::kStaysInPicture, 0.1) << albedo;
    }
}

TEST(MonteCarlo, theSameSeedIsTheSameLight) {
    const SeenWater seen{0.7, 2.0, {0, 0, -1}, 1.0};
    const double first = scatteredIn(phase(), seen, kSun, 2000, 7).mean;
    EXPECT_EQ(scatteredIn(phase(), seen, kSun, 2000, 7).mean, first);
    EXPECT_NE(scatteredIn(phase(), seen, kSun, 2000, 8).mean, first);
}

// To take the peak as straight is to quiet the noise, not to change the light.
TEST(MonteCarlo, withoutThePeakItIsTheSameLight) {
    const ForwardPhase blunt{4 * kDegree};
    constexpr double kAlbedo = 0.6;
    const double scale = 1 - blunt.peakShare() * kAlbedo;
    const double scaled = kAlbedo * (1 - blunt.peakShare()) / scale;
    const Estimate sharp = irradiance(phase(), kAlbedo, 2.0, kSun, 60000, 1);
    const Estimate quiet = irradiance(blunt, scaled, 2.0 * scale, kSun, 60000, 2);
    EXPECT_NEAR(quiet.mean / sharp.mean, 1.0, 0.08);
    EXPECT_LT(quiet.deviation, sharp.deviation);
}

class TableOfTheLobe : public testing::TestWithParam<config::WaterType> {};
INSTANTIATE_TEST_SUITE_P(Jerlov,
                         TableOfTheLobe,
                         testing::Values(config::WaterType::IA, config::WaterType::II),
                         [](const auto& tested) {
                             return "type" + std::string(config::kWaterTypeNames.at(
                                                 static_cast<std::size_t>(tested.param)));
                         });

// Other seeds than the table's. What is left is noise of a short run for a part.
TEST_P(TableOfTheLobe, looksAsTheMonteCarlo) {
    const ForwardPhase blunt{4 * kDegree};
    const auto off = differences(blunt, GetParam(), {{4.0, 12.0}, {3.0, 15.0}, 12000, 1000});
    EXPECT_LT(std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size()), 2.0);
}

}  // namespace
}  // namespace aquarama::test
