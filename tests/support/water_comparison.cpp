// SPDX-License-Identifier: Apache-2.0
#include "tests/support/water_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/render_node/water/water_reading.h"
#include "tests/support/colour_difference.h"

namespace aquarama::test {

namespace {

constexpr std::size_t kEvery = 3;  // of the 31 bands
struct Way {
    double rise, azimuthDegrees;
};
constexpr std::array kWays{
    Way{0.0, 30.0}, Way{0.0, 110.0}, Way{0.35, 70.0}, Way{-0.4, 20.0}, Way{-0.3, 150.0}};

// Depths and ranges in lengths of the light that the phase function does not take as straight.
struct Band {
    double albedo, scale;  // scaled b / c, and 1/m
};

Band bandOf(const ForwardPhase& phase, const scene::WaterSpectra& water, std::size_t band) {
    const double b = water.scattering[band] * (1 - phase.peakShare());
    const double c = water.absorption[band] + b;
    return {b / c, c};
}

glm::dvec3 traced(const ForwardPhase& phase,
                  const scene::WaterSpectra& water,
                  const Sight& sight,
                  double range,
                  const std::vector<double>& irradiances,
                  const Comparison& comparison) {
    const double lit = sight.depth - scene::filterDepthMetres(sight.depth);
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < scene::kBands; band += kEvery) {
        const Band at = bandOf(phase, water, band);
        const SeenWater seen{
            at.albedo, sight.depth * at.scale, sight.direction(), range * at.scale};
        const double light = scatteredIn(phase,
                                         seen,
                                         glm::dvec3{scene::sunInWater()},
                                         comparison.paths,
                                         comparison.seed + band)
                                 .mean /
                             irradiances[band / kEvery] * std::exp(-water.downwelling[band] * lit);
        for (int c = 0; c < 3; ++c) sum[c] += kEvery * water.weights[c][band] * light;
    }
    return sum;
}

// The tables' own, at the same bands.
glm::dvec3 tabled(const scene::WaterSpectra& water, const Sight& sight, double range) {
    scene::WaterSpectra some = water;
    for (scene::Spectrum& weights : some.weights)
        for (std::size_t band = 0; band < scene::kBands; ++band)
            weights[band] *= band % kEvery == 0 ? double{kEvery} : 0.0;
    return veil(some, sight, range);
}

}  // namespace

std::vector<double> differences(const ForwardPhase& phase,
                                config::WaterType type,
                                const Comparison& comparison) {
    const scene::WaterSpectra water = scene::seaWater(type);
    const scene::Inscatter inscatter{water};
    const double clear = std::min(0.13 / scene::beamAttenuation(water, 10), 1.0);
    std::vector<double> all;
    for (const double inClear : comparison.depths) {
        const double depth = inClear * std::sqrt(clear);
        std::vector<double> irradiances;
        for (std::size_t band = 0; band < scene::kBands; band += kEvery) {
            const Band at = bandOf(phase, water, band);
            irradiances.push_back(irradiance(phase,
                                             at.albedo,
                                             depth * at.scale,
                                             glm::dvec3{scene::sunInWater()},
                                             4 * comparison.paths,
                                             comparison.seed)
                                      .mean);
        }
        const double exposure = inscatter.exposureAt(depth);
        for (const Way& way : kWays)
            for (const double inClearWater : comparison.ranges) {
                const Sight sight{depth, way.rise, way.azimuthDegrees};
                const double surface = way.rise > 0 ? depth / way.rise : 1e9;
                const double range = std::min(inClearWater * clear, surface);
                const glm::dvec3 truth =
                    traced(phase, water, sight, range, irradiances, comparison);
                const glm::dvec3 table = tabled(water, sight, range);
                all.push_back(ciede2000(labOf(truth * exposure), labOf(table * exposure)));
            }
    }
    return all;
}

}  // namespace aquarama::test
