// SPDX-License-Identifier: Apache-2.0
// The tables that the shaders read, against the 31 bands that they stand for.
#include "render_node/water/water_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "render_node/water/water_lobes.h"
#include "tests/render_node/water/water_reading.h"
#include "tests/support/colour_difference.h"

namespace aquarama::scene {
namespace {

using namespace test;

double smoothStep(double x) {
    return 1.0 / (1.0 + std::exp(-x));
}

// Reflectances: white, sand (Maritorena 1994, a straight line), coral red, yellow, green, blue,
// magenta.
const std::array<test::Pigment, 7> kTargets{
    [](double) { return 1.0; },
    [](double nm) { return 0.28 + 0.28 * (nm - 400) / 300; },
    [](double nm) { return 0.06 + 0.55 * smoothStep((nm - 600) / 9); },
    [](double nm) { return 0.06 + 0.70 * smoothStep((nm - 515) / 10); },
    [](double nm) { return 0.05 + 0.22 * std::exp(-0.5 * std::pow((nm - 555) / 35, 2)); },
    [](double nm) { return 0.05 + 0.40 * smoothStep((500 - nm) / 14); },
    [](double nm) { return 0.50 - 0.42 * std::exp(-0.5 * std::pow((nm - 540) / 40, 2)); },
};
constexpr std::size_t kWhiteAndSand = 2;

glm::dvec3 seenByTable(const Table& table, glm::dvec3 colour, double range, double depth) {
    glm::dvec3 sum{0.0};
    for (int column = 0; column < 3; ++column)
        sum +=
            glm::dvec3(test::read(table, test::rangeAxis(range), test::depthAxis(depth), column)) *
            colour[column];
    return sum;
}

class EachWater : public testing::TestWithParam<config::WaterType> {
  protected:
    WaterSpectra water = seaWater(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Jerlov,
                         EachWater,
                         testing::Values(config::WaterType::I,
                                         config::WaterType::IA,
                                         config::WaterType::IB,
                                         config::WaterType::II,
                                         config::WaterType::III,
                                         config::WaterType::C1,
                                         config::WaterType::C3),
                         [](const auto& tested) {
                             return "type" + std::string(config::kWaterTypeNames.at(
                                                 static_cast<std::size_t>(tested.param)));
                         });

TEST_P(EachWater, daylightIsWhiteAndTheThreeSurfacesMakeWhite) {
    EXPECT_LT(glm::distance(test::colourOf(water, kTargets[0]), glm::dvec3{1.0}), 1e-9);
    for (std::size_t band = 0; band < kBands; ++band)
        EXPECT_NEAR(
            water.reflectances[0][band] + water.reflectances[1][band] + water.reflectances[2][band],
            1.0,
            1e-12);
}

TEST_P(EachWater, redDiesFirstAndTheWayDownIsNotTheWayAcross) {
    constexpr std::size_t kGreen = 13;  // 530 nm
    constexpr std::size_t kRed = 25;    // 650 nm
    constexpr std::size_t kBlue = 7;    // 470 nm
    EXPECT_GT(beamAttenuation(water, kRed), 1.3 * beamAttenuation(water, kGreen));
    EXPECT_GT(beamAttenuation(water, kBlue), 1.1 * water.downwelling[kBlue]);
    for (std::size_t band = 0; band < kBands; ++band) {
        EXPECT_GT(water.absorption[band], 0.0);
        EXPECT_GT(water.scattering[band], 0.0);
    }
}

TEST(WaterTypes, theClearestComesFirst) {
    constexpr std::size_t kBlue = 7;  // 470 nm
    for (std::size_t i = 1; i < config::kWaterTypeNames.size(); ++i)
        EXPECT_LT(beamAttenuation(seaWater(static_cast<config::WaterType>(i - 1)), kBlue),
                  beamAttenuation(seaWater(static_cast<config::WaterType>(i)), kBlue))
            << config::kWaterTypeNames.at(i);
}

// With the light that water adds, as a visitor sees them, exposed so that near white is at 0.8.
TEST_P(EachWater, pigmentsLookAsTheirSpectraDo) {
    const Table direct = bakeDirect(water);
    const Inscatter inscatter{water};
    double sum = 0;
    double plain = 0;
    int count = 0;
    const double clear = 0.13 / beamAttenuation(water, 10);  // this water's range, as of type IA
    for (const double depth : {2.0, 5.0, 10.0, 20.0}) {
        const Table sight = inscatter.atDepth(depth);
        const double lit = depth - filterDepthMetres(depth);
        const double exposure =
            0.8 / glm::dot(test::seenThrough(water, kTargets[0], 0.5, lit), test::kLuminance);
        for (const double range : {1.0, 2.0, 5.0, 10.0, 20.0}) {
            const double away = range * std::min(clear, 1.0);
            const test::Sight level{depth, 0.0, 90.0};
            const glm::dvec3 added = test::veil(water, level, away) * std::numbers::pi;
            const glm::dvec3 addedByTable =
                test::veilByTable(sight, level, away) * std::numbers::pi;
            for (std::size_t i = 0; i < kTargets.size(); ++i) {
                const glm::dvec3 truth = test::seenThrough(water, kTargets[i], away, lit) + added;
                const glm::dvec3 table =
                    seenByTable(direct, test::colourOf(water, kTargets[i]), away, lit) +
                    addedByTable;
                const double off =
                    test::ciede2000(test::labOf(truth * exposure), test::labOf(table * exposure));
                sum += off;
                plain += i < kWhiteAndSand ? off : 0;
                ++count;
            }
        }
    }
    const double white = plain / (count * double{kWhiteAndSand} / kTargets.size());
    RecordProperty("mean_de2000", std::to_string(sum / count));
    RecordProperty("white_and_sand_de2000", std::to_string(white));
    EXPECT_LT(sum / count, 1.3);
    EXPECT_LT(white, 1.0);
}

// Closed form: each band keeps what the grade leaves of its exponent, and white its luminance.
TEST_P(EachWater, aGradeGivesColourBackAndLeavesTheLuminanceOfWhite) {
    const double clear = std::min(0.13 / beamAttenuation(water, 10), 1.0);
    for (const double returned : {0.0, 0.4, 0.8, 1.0}) {
        const Grade grade = gradeOf(returned);
        const Table table = bakeDirect(water, grade);
        for (const double depth : {-3.0, 0.0, 6.0})
            for (const double inClearWater : {0.0, 4.0, 12.0}) {
                const double range = inClearWater * clear;
                const auto kept = [&](std::size_t band) {
                    return std::exp(-(1 - grade.down) * water.downwelling[band] * depth -
                                    (1 - grade.toEye) * beamAttenuation(water, band) * range);
                };
                const glm::dvec3 plain = test::seenThrough(water, kTargets[0], range, depth);
                glm::dvec3 graded = test::integrated(water, kept);
                graded *= glm::dot(plain, test::kLuminance) / glm::dot(graded, test::kLuminance);
                const glm::dvec3 seen = seenByTable(table, glm::dvec3{1.0}, range, depth);
                EXPECT_LT(glm::distance(seen, graded), 0.02 * glm::length(graded))
                    << returned << ", " << depth << " m deep, " << range << " m away";
            }
    }
}

// All that is drawn for no colour returned is as it was before there was a grade.
TEST_P(EachWater, noColourReturnedIsTheWaterOfNature) {
    const GradedDirect graded{water};
    const Table table = graded.at(0.0);
    const Table plain = bakeDirect(water);
    EXPECT_TRUE(table.texels == plain.texels);
    const std::size_t layer = plain.texels.size() / 4;
    for (std::size_t i = 3 * layer; i < plain.texels.size(); ++i)
        ASSERT_EQ(plain.texels[i], glm::vec3{1.0F}) << "nothing is to be undone";
}

// To look up so much nearer the surface is the spectral gain of the filter.
TEST_P(EachWater, theFilterIsAGainOnEachWavelength) {
    for (const double depth : {1.0, 6.0, 12.0, 30.0}) {
        const double filter = filterDepthMetres(depth);
        EXPECT_LT(filter, depth) << "the water above is never undone wholly";
        const glm::dvec3 gained = test::integrated(water, [&](std::size_t band) {
            return std::exp(-water.downwelling[band] * depth) *
                   std::exp(water.downwelling[band] * filter);
        });
        EXPECT_LT(glm::distance(gained, test::seenThrough(water, kTargets[0], 0, depth - filter)),
                  1e-9);
        const glm::dvec3 table =
            seenByTable(bakeDirect(water), glm::dvec3{1.0}, 0.0, depth - filter);
        EXPECT_LT(glm::distance(gained, table), 0.01 * glm::length(gained));
    }
}

// The submarine dives and rises: neither light nor exposure ever jumps.
TEST_P(EachWater, nothingJumpsAsTheEyeDives) {
    const Inscatter inscatter{water};
    constexpr double kStep = 0.05;
    for (double depth = 0.5; depth < 45; depth += kStep) {
        EXPECT_NEAR(inscatter.exposureAt(depth + kStep) / inscatter.exposureAt(depth), 1.0, 0.02);
        EXPECT_NEAR(filterDepthMetres(depth + kStep), filterDepthMetres(depth), kStep);
    }
    for (double depth = 0.5; depth < 40; depth += 1.7) {
        const test::Sight ahead{depth, -0.1, 60.0};
        const test::Sight deeper{depth + kStep, -0.1, 60.0};
        const glm::dvec3 here = test::veilByTable(inscatter.atDepth(depth), ahead, 30);
        const glm::dvec3 there = test::veilByTable(inscatter.atDepth(depth + kStep), deeper, 30);
        EXPECT_LT(glm::distance(here, there), 0.03 * glm::length(here)) << depth;
    }
}

TEST_P(EachWater, slicesBetweenEyesAreAsBakedForThem) {
    const Inscatter inscatter{water};
    double sum = 0;
    int count = 0;
    for (const double depth : {1.7, 4.4, 6.0, 9.1, 17.0, 28.0})
        for (const double rise : {-0.6, -0.1, 0.3})
            for (const double range : {3.0, 10.0}) {
                const test::Sight sight{depth, rise, 70.0};
                const double exposure = inscatter.exposureAt(depth);
                const glm::dvec3 truth = test::veil(water, sight, range) * exposure;
                const glm::dvec3 table =
                    test::veilByTable(inscatter.atDepth(depth), sight, range) * exposure;
                sum += test::ciede2000(test::labOf(truth), test::labOf(table));
                ++count;
            }
    EXPECT_LT(sum / count, 1.0);
}

TEST(Inscatter, clearWaterIsBlueAndCoastalWaterGreen) {
    const auto level = [](config::WaterType type) {
        const WaterSpectra water = seaWater(type);
        return test::veil(water, {10.0, 0.0, 90.0}, 60.0);
    };
    const glm::dvec3 blue = level(config::WaterType::IA);
    EXPECT_GT(blue.b, 1.8 * blue.g);
    EXPECT_GT(blue.g, 2.0 * blue.r);
    const glm::dvec3 green = level(config::WaterType::C3);
    EXPECT_GT(green.g, 1.3 * green.b);
}

}  // namespace
}  // namespace aquarama::scene
