// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/water_tables.h"

#include <cmath>
#include <functional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace aquarama {
namespace {

using Pigment = std::function<double(double nanometres)>;

double wavelengthOf(std::size_t band) {
    return 400.0 + 10.0 * static_cast<double>(band);
}

// A table as the shaders read it: axes as in water.glsl, bilinear between texels.
glm::vec3 read(const Table& table, double u, double v, int layer = 0) {
    const double x = u * (table.width - 1);
    const double y = v * (table.height - 1);
    const int left = std::min(static_cast<int>(x), table.width - 2);
    const int low = std::min(static_cast<int>(y), table.height - 2);
    const auto at = [&](int column, int row) {
        return table.texels.at(static_cast<std::size_t>(layer * table.height + row) *
                                   static_cast<std::size_t>(table.width) +
                               static_cast<std::size_t>(column));
    };
    const auto s = static_cast<float>(x - left);
    const auto t = static_cast<float>(y - low);
    return glm::mix(glm::mix(at(left, low), at(left + 1, low), s),
                    glm::mix(at(left, low + 1), at(left + 1, low + 1), s),
                    t);
}

double rangeAxis(double range) {
    return std::sqrt(range / 80.0);
}
double depthAxis(double depth) {
    return std::sqrt((depth + 10.0) / 40.0);
}

glm::dvec3 integrated(const WaterSpectra& water, const std::function<double(std::size_t)>& light) {
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < kBands; ++band)
        for (int c = 0; c < 3; ++c) sum[c] += water.weights[c][band] * light(band);
    return sum;
}

glm::dvec3 colourOf(const WaterSpectra& water, const Pigment& pigment) {
    return integrated(water, [&](std::size_t band) { return pigment(wavelengthOf(band)); });
}

glm::dvec3 seenThrough(const WaterSpectra& water,
                       const Pigment& pigment,
                       double range,
                       double depth) {
    return integrated(water, [&](std::size_t band) {
        return pigment(wavelengthOf(band)) *
               std::exp(-water.downwelling[band] * depth - beamAttenuation(water, band) * range);
    });
}

glm::dvec3 seenByTable(const Table& table, glm::dvec3 colour, double range, double depth) {
    glm::dvec3 sum{0.0};
    for (int column = 0; column < 3; ++column)
        sum += glm::dvec3(read(table, rangeAxis(range), depthAxis(depth), column)) * colour[column];
    return sum;
}

// Worst difference of a channel, relative to the brightest of them.
double error(glm::dvec3 a, glm::dvec3 truth) {
    const glm::dvec3 off = glm::abs(a - truth);
    return std::max({off.r, off.g, off.b}) / std::max({truth.r, truth.g, truth.b});
}

double smoothStep(double x) {
    return 1.0 / (1.0 + std::exp(-x));
}

TEST(WaterSpectra, daylightIsWhiteAndTheThreeSurfacesMakeWhite) {
    const WaterSpectra water = oceanWater();
    EXPECT_LT(error(colourOf(water, [](double) { return 1.0; }), glm::dvec3{1.0}), 1e-9);
    for (std::size_t band = 0; band < kBands; ++band)
        EXPECT_NEAR(
            water.reflectances[0][band] + water.reflectances[1][band] + water.reflectances[2][band],
            1.0,
            1e-12);
}

TEST(WaterSpectra, redDiesFirstAndTheWayDownIsNotTheWayAcross) {
    const WaterSpectra water = oceanWater();
    constexpr std::size_t kBlue = 7;  // 470 nm
    constexpr std::size_t kRed = 25;  // 650 nm
    EXPECT_GT(beamAttenuation(water, kRed), 5.0 * beamAttenuation(water, kBlue));
    EXPECT_GT(beamAttenuation(water, kBlue), 1.3 * water.downwelling[kBlue]);
    for (std::size_t band = 0; band < kBands; ++band) EXPECT_GT(water.absorption[band], 0.0);
}

// Also above the surface, where the diver's filter looks.
TEST(DirectTable, whiteIsExactAtAnyRangeAndDepth) {
    const WaterSpectra water = oceanWater();
    const Table table = bakeDirect(water);
    const Pigment white = [](double) { return 1.0; };
    for (double depth = -8.0; depth < 30.0; depth += 3.7)
        for (double range = 0.4; range < 40.0; range *= 1.7)
            EXPECT_LT(error(seenByTable(table, glm::dvec3{1.0}, range, depth),
                            seenThrough(water, white, range, depth)),
                      0.012)
                << "range " << range << " depth " << depth;
}

TEST(DirectTable, pigmentsComeOutAsTheirSpectraDo) {
    const WaterSpectra water = oceanWater();
    const Table table = bakeDirect(water);
    const std::array<Pigment, 4> pigments{
        [](double nm) { return 0.06 + 0.70 * smoothStep((nm - 515.0) / 10.0); },  // yellow
        [](double nm) { return 0.05 + 0.22 * std::exp(-0.5 * std::pow((nm - 555.0) / 35.0, 2)); },
        [](double nm) { return 0.05 + 0.40 * smoothStep((500.0 - nm) / 14.0); },  // blue
        [](double nm) { return 0.28 + 0.28 * (nm - 400.0) / 300.0; },             // sand
    };
    double sum = 0;
    int count = 0;
    for (const Pigment& pigment : pigments)
        for (const double depth : {0.0, 2.0, 5.0, 10.0})
            for (const double range : {1.0, 3.0, 8.0, 20.0}) {
                sum += error(seenByTable(table, colourOf(water, pigment), range, depth),
                             seenThrough(water, pigment, range, depth));
                ++count;
            }
    EXPECT_LT(sum / count, 0.06);
}

// The closed form against the sum along the ray of what each piece of water scatters.
TEST(InscatterTable, isTheSumAlongTheRay) {
    const WaterSpectra water = oceanWater();
    const Inscatter inscatter{water};
    constexpr double kDepth = 6.0;
    const Table table = inscatter.atDepth(kDepth);
    for (const double rise : {-0.8, -0.2, 0.0, 0.3})
        for (const double range : {1.0, 5.0, 14.0}) {
            constexpr int kSteps = 2000;
            const glm::dvec3 truth = integrated(water, [&](std::size_t band) {
                double sum = 0;
                for (int i = 0; i < kSteps; ++i) {
                    const double s = range * (i + 0.5) / kSteps;
                    sum += std::exp(-water.downwelling[band] * (kDepth - rise * s) -
                                    beamAttenuation(water, band) * s);
                }
                return water.scattering[band] * sum * range / kSteps;
            });
            EXPECT_LT(error(glm::dvec3(read(table, rangeAxis(range), 0.5 + 0.5 * rise)), truth),
                      0.02)
                << "rise " << rise << " range " << range;
        }
}

TEST(InscatterTable, openWaterIsBlue) {
    const Inscatter inscatter{oceanWater()};
    const glm::vec3 water = read(inscatter.openWater(), depthAxis(1.0), 0.5);
    EXPECT_GT(water.b, 1.3F * water.g);
    EXPECT_GT(water.g, 2.0F * water.r);
}

}  // namespace
}  // namespace aquarama
