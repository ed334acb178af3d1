// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/water_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/files/derived_cache.h"
#include "render_node/scene/shade.h"
#include "render_node/scene/water_lobes.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

constexpr int kRanges = 64, kDepths = 64, kRises = 32;
constexpr double kOpenWaterMetres = 60.0;
// Eyes: closer near the surface, where the light changes most.
constexpr int kEyes = 13;
constexpr double kDeepestEyeMetres = 40.0;

double evenly(int i, int count) {
    return static_cast<double>(i) / (count - 1);
}
double rangeAt(int i, int count) {
    const double u = evenly(i, count);
    return kFarthestMetres * u * u;
}
double depthAt(int i) {
    const double v = evenly(i, kDepths);
    return (kDeepestMetres + kDepthOffsetMetres) * v * v - kDepthOffsetMetres;
}
double riseAt(int i, int count) {
    return 2.0 * evenly(i, count) - 1.0;
}
double eyeDepthAt(int i) {
    const double v = evenly(i, kEyes);
    return kDeepestEyeMetres * v * v;
}

glm::dvec3 integrated(const WaterSpectra& water, const Spectrum& light) {
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < kBands; ++band)
        for (int c = 0; c < 3; ++c) sum[c] += water.weights[c][band] * light[band];
    return sum;
}

double luminance(glm::dvec3 rgb) {
    return glm::dot(rgb, glm::dvec3{0.2126, 0.7152, 0.0722});
}

// Columns: what is left of a unit of each smooth reflectance, in linear Rec. 709.
glm::dmat3 transmitted(const WaterSpectra& water, double range, double depth) {
    glm::dmat3 columns{0.0};
    for (std::size_t band = 0; band < kBands; ++band) {
        const double left =
            std::exp(-water.downwelling[band] * depth - beamAttenuation(water, band) * range);
        for (int surface = 0; surface < 3; ++surface)
            for (int c = 0; c < 3; ++c)
                columns[surface][c] +=
                    water.weights[c][band] * left * water.reflectances[surface][band];
    }
    return columns;
}

// What a unit of irradiance at the eye makes of the ray before this range: source and loss.
struct Ray {
    Spectrum source{}, loss{};
    [[nodiscard]] Spectrum lightBefore(double range) const {
        Spectrum light;
        for (std::size_t band = 0; band < kBands; ++band)
            light[band] = source[band] * (1.0 - std::exp(-loss[band] * range)) / loss[band];
        return light;
    }
};

Ray rayOf(const WaterSpectra& water,
          double eyeDepth,
          double litDepth,
          double rise,
          double azimuthDegrees) {
    Ray ray;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double b = water.scattering[band];
        const double c = water.absorption[band] + b;
        const WaterLobe lobe = waterLobe(b / c, c * eyeDepth, rise, azimuthDegrees);
        ray.source[band] = b * lobe.source * std::exp(-water.downwelling[band] * litDepth);
        ray.loss[band] = std::max(c * lobe.loss, 0.004);
    }
    return ray;
}

double azimuthAt(int i) {
    const double cosine = std::clamp(2.0 * evenly(i, shaders::kSightAzimuths) - 1.0, -1.0, 1.0);
    return std::acos(cosine) * 180.0 / std::numbers::pi;
}

// Where between the eyes of the slices, by index.
double eyePlace(double depth) {
    return std::sqrt(std::clamp(depth / kDeepestEyeMetres, 0.0, 1.0)) * (kEyes - 1);
}

// Straight between a mean of near sand and the water beyond it, in their logarithms.
double exposureOf(const WaterSpectra& water, double eyeDepth) {
    constexpr double kKey = 0.124, kWater = 0.6;
    constexpr double kDusk = 0.018;  // the deep is darker, 1/m
    constexpr double kSandAway = 5.0, kSandBelow = 5.0, kSandAlbedo = 0.4;
    const double lit = eyeDepth - filterDepthMetres(eyeDepth);
    const glm::dvec3 sand = transmitted(water, kSandAway, lit + kSandBelow) * glm::dvec3{1.0};
    const glm::dvec3 across =
        glm::normalize(glm::cross(glm::dvec3{sunInWater()}, glm::dvec3{0, 1, 0}));
    const glm::dvec3 open =
        integrated(water, rayOf(water, eyeDepth, lit, 0.0, 90.0).lightBefore(kOpenWaterMetres)) *
        plainLobe(across, glm::dvec3{sunInWater()});
    const double grey = std::pow(luminance(sand) * kSandAlbedo / std::numbers::pi, 1 - kWater) *
                        std::pow(luminance(open), kWater);
    return kKey / grey * std::exp(-kDusk * eyeDepth);
}

}  // namespace

double filterDepthMetres(double eyeDepthMetres) {
    constexpr double kMost = 21.0;
    const double depth = std::max(eyeDepthMetres, 0.0);
    return depth / std::hypot(1.0, depth / kMost);
}

Table bakeDirect(const WaterSpectra& water) {
    Table table{kRanges, kDepths, 3, {}};
    table.texels.resize(std::size_t{kRanges} * kDepths * 3);
    std::size_t at = 0;
    const glm::dmat3 surfacesFromColour = glm::inverse(transmitted(water, 0.0, 0.0));
    for (int depth = 0; depth < kDepths; ++depth)
        for (int range = 0; range < kRanges; ++range) {
            const glm::dmat3 seen =
                transmitted(water, rangeAt(range, kRanges), depthAt(depth)) * surfacesFromColour;
            for (int column = 0; column < 3; ++column)
                table.texels[at + static_cast<std::size_t>(column) * kRanges * kDepths] =
                    glm::vec3(seen[column]);
            ++at;
        }
    return table;
}

Table bakeOpenWater(const WaterSpectra& water) {
    Table table{kDepths, kRises, 1, {}};
    for (int rise = 0; rise < kRises; ++rise)
        for (int depth = 0; depth < kDepths; ++depth) {
            const double lit = depthAt(depth);
            const Ray ray = rayOf(water, std::max(lit, 0.5), lit, riseAt(rise, kRises), 90.0);
            table.texels.push_back(glm::vec3(integrated(water, ray.lightBefore(kOpenWaterMetres))));
        }
    return table;
}

Inscatter::Inscatter(const WaterSpectra& water) {
    for (int eye = 0; eye < kEyes; ++eye) {
        slices_.push_back(baked(water, eyeDepthAt(eye)));
        exposures_.push_back(exposureOf(water, eyeDepthAt(eye)));
    }
}

Inscatter::Inscatter(std::span<const glm::vec3> texels, std::vector<double> exposures)
    : exposures_{std::move(exposures)} {
    constexpr std::size_t kTexels =
        std::size_t{shaders::kSightRanges} * shaders::kSightRises * shaders::kSightAzimuths;
    assert(texels.size() == kEyes * kTexels && exposures_.size() == kEyes);
    for (std::size_t eye = 0; eye < kEyes; ++eye) {
        const auto own = texels.subspan(eye * kTexels, kTexels);
        slices_.push_back({shaders::kSightRanges,
                           shaders::kSightRises,
                           shaders::kSightAzimuths,
                           {own.begin(), own.end()}});
    }
}

std::vector<glm::vec3> Inscatter::texels() const {
    std::vector<glm::vec3> all;
    for (const Table& slice : slices_)
        all.insert(all.end(), slice.texels.begin(), slice.texels.end());
    return all;
}

Table Inscatter::baked(const WaterSpectra& water, double eyeDepthMetres) const {
    const double lit = eyeDepthMetres - filterDepthMetres(eyeDepthMetres);
    Table table{shaders::kSightRanges, shaders::kSightRises, shaders::kSightAzimuths, {}};
    for (int azimuth = 0; azimuth < shaders::kSightAzimuths; ++azimuth)
        for (int rise = 0; rise < shaders::kSightRises; ++rise) {
            const Ray ray = rayOf(
                water, eyeDepthMetres, lit, riseAt(rise, shaders::kSightRises), azimuthAt(azimuth));
            for (int range = 0; range < shaders::kSightRanges; ++range)
                table.texels.push_back(glm::vec3(
                    integrated(water, ray.lightBefore(rangeAt(range, shaders::kSightRanges)))));
        }
    return table;
}

Table Inscatter::atDepth(double eyeDepthMetres) const {
    Table table = slices_.front();
    mixAtDepth(eyeDepthMetres, table);
    return table;
}

void Inscatter::mixAtDepth(double eyeDepthMetres, Table& table) const {
    const double place = eyePlace(eyeDepthMetres);
    const auto left = std::min(static_cast<std::size_t>(place), slices_.size() - 2);
    const auto share = static_cast<float>(place - static_cast<double>(left));
    const auto& near = slices_[left].texels;
    const auto& far = slices_[left + 1].texels;
    for (std::size_t i = 0; i < near.size(); ++i)
        table.texels[i] = glm::mix(near[i], far[i], share);
}

double Inscatter::exposureAt(double eyeDepthMetres) const {
    const double place = eyePlace(eyeDepthMetres);
    const auto left = std::min(static_cast<std::size_t>(place), exposures_.size() - 2);
    return std::lerp(exposures_[left], exposures_[left + 1], place - static_cast<double>(left));
}

namespace {

struct WaterArrays {
    std::vector<glm::vec3> inscatter, direct, openWater;
    std::vector<double> exposures;

    auto arrays() { return std::tie(inscatter, direct, openWater, exposures); }
};

}  // namespace

WaterTables waterTables(config::WaterType type) {
    WaterArrays kept = files::derivedTables<WaterArrays>(files::DerivedKey("water").add(type), [&] {
        const WaterSpectra water = seaWater(type);
        const Inscatter inscatter{water};
        return WaterArrays{inscatter.texels(),
                           bakeDirect(water).texels,
                           bakeOpenWater(water).texels,
                           inscatter.exposures()};
    });
    return {Inscatter{kept.inscatter, std::move(kept.exposures)},
            {kRanges, kDepths, 3, std::move(kept.direct)},
            {kDepths, kRises, 1, std::move(kept.openWater)}};
}

glm::vec3 primariesDownwelling(const WaterSpectra& water) {
    constexpr double kFrom = -2.0, kTo = 2.0;
    const glm::dvec3 above = transmitted(water, 0, kFrom) * glm::dvec3{1.0};
    const glm::dvec3 below = transmitted(water, 0, kTo) * glm::dvec3{1.0};
    return glm::vec3(glm::log(above / below) / (kTo - kFrom));
}

}  // namespace aquarama::scene
