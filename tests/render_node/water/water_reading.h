// SPDX-License-Identifier: Apache-2.0
// The water's tables as the shaders read them, and the sums over 31 bands that they stand for.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "render_node/water/water_lobes.h"
#include "render_node/water/water_tables.h"

namespace aquarama::test {

inline constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722};
using Pigment = std::function<double(double nanometres)>;

// Axes as in water.glsl, bilinear between texels.
inline glm::vec3 read(const scene::Table& table, double u, double v, int layer = 0) {
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

inline double rangeAxis(double range) {
    return std::sqrt(range / 80.0);
}
inline double depthAxis(double depth) {
    return std::sqrt((depth + 10.0) / 40.0);
}

inline glm::dvec3 integrated(const scene::WaterSpectra& water,
                             const std::function<double(std::size_t)>& light) {
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < scene::kBands; ++band)
        for (int c = 0; c < 3; ++c) sum[c] += water.weights[c][band] * light(band);
    return sum;
}

inline glm::dvec3 colourOf(const scene::WaterSpectra& water, const Pigment& pigment) {
    return integrated(water, [&](std::size_t band) { return pigment(scene::wavelengthOf(band)); });
}

inline glm::dvec3 seenThrough(const scene::WaterSpectra& water,
                              const Pigment& pigment,
                              double range,
                              double depth) {
    return integrated(water, [&](std::size_t band) {
        return pigment(scene::wavelengthOf(band)) *
               std::exp(-water.downwelling[band] * depth -
                        scene::beamAttenuation(water, band) * range);
    });
}

// A way to look: an eye's depth, the rise w_y, and how far round from the sun.
struct Sight {
    double depth = 0, rise = 0, azimuthDegrees = 0;
    [[nodiscard]] glm::dvec3 direction() const {
        const glm::dvec3 sun{scene::sunInWater()};
        const glm::dvec3 ahead = glm::normalize(glm::dvec3{sun.x, 0, sun.z});
        const glm::dvec3 aside = glm::cross(ahead, glm::dvec3{0, 1, 0});
        const double flat = std::sqrt(1 - rise * rise);
        const double around = azimuthDegrees * std::numbers::pi / 180;
        return flat * (std::cos(around) * ahead + std::sin(around) * aside) +
               glm::dvec3{0, rise, 0};
    }
};

// Light scattered into the view, through the diver's filter, at noon without shafts.
inline glm::dvec3 veil(const scene::WaterSpectra& water, const Sight& sight, double range) {
    const double lit = sight.depth - scene::filterDepthMetres(sight.depth);
    const double lobes = scene::plainLobe(sight.direction(), glm::dvec3{scene::sunInWater()});
    return integrated(water, [&](std::size_t band) {
        const double b = water.scattering[band];
        const double c = water.absorption[band] + b;
        const scene::WaterLobe lobe =
            scene::waterLobe(b / c, c * sight.depth, sight.rise, sight.azimuthDegrees);
        const double loss = std::max(c * lobe.loss, 0.004);
        return b * lobe.source * lobes * std::exp(-water.downwelling[band] * lit) *
               (1 - std::exp(-loss * range)) / loss;
    });
}

inline glm::dvec3 veilByTable(const scene::Table& table, const Sight& sight, double range) {
    const double cosine = std::cos(sight.azimuthDegrees * std::numbers::pi / 180);
    const double place = (0.5 + 0.5 * cosine) * (table.layers - 1);
    const int layer = std::min(static_cast<int>(place), table.layers - 2);
    const auto at = [&](int of) {
        return glm::dvec3(read(table, rangeAxis(range), 0.5 + 0.5 * sight.rise, of));
    };
    return glm::mix(at(layer), at(layer + 1), place - layer) *
           scene::plainLobe(sight.direction(), glm::dvec3{scene::sunInWater()});
}

}  // namespace aquarama::test
