// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/water_tables.h"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

namespace aquarama {

namespace {

// Jerlov's type IA every 25 nm from 400 to 700 nm, 1/m. Downwelling Kd: Jerlov 1976, table XXVII,
// as updated by Austin and Petzold 1984. Absorption of pure water: Pope and Fry 1997.
constexpr int kSamples = 13;
constexpr std::array<double, kSamples> kDownwelling{
    .0316, .0280, .0257, .0250, .0332, .0545, .0674, .0960, .2437, .3206, .3601, .4410, .6530};
constexpr std::array<double, kSamples> kPureAbsorption{
    .00663, .00478, .00922, .0114, .0204, .0417, .0565, .0772, .2224, .2834, .340, .448, .624};

// CIE standard illuminant D65 at the 31 bands.
constexpr Spectrum kDaylight{82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81, 114.86,
                             115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
                             100.0,  96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,
                             83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61};

constexpr double kStaysInPicture = 0.49;
constexpr int kRanges = 64, kDepths = 32, kRises = 32;
constexpr double kOpenWaterMetres = 60.0;

double wavelength(std::size_t band) {
    return 400.0 + 10.0 * static_cast<double>(band);
}

double sampled(const std::array<double, kSamples>& samples, double nanometres) {
    const double place = (nanometres - 400.0) / 300.0 * (kSamples - 1);
    const auto left = static_cast<std::size_t>(std::clamp(place, 0.0, kSamples - 2.0));
    const double share = place - static_cast<double>(left);
    return samples[left] * (1.0 - share) + samples[left + 1] * share;
}

double bell(double x, double peak, double below, double above) {
    const double t = (x - peak) * (x < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

// CIE 1931 observer as fitted by Wyman, Sloan and Shirley 2013 (JCGT 2:2).
glm::dvec3 observer(double nm) {
    return {0.362 * bell(nm, 442.0, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
                0.065 * bell(nm, 501.1, 0.0490, 0.0382),
            0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
            1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725)};
}

void setWeights(WaterSpectra& water) {
    const glm::dmat3 rec709FromXyz{{3.2404542, -0.9692660, 0.0556434},
                                   {-1.5371385, 1.8760108, -0.2040259},
                                   {-0.4985314, 0.0415560, 1.0572252}};
    glm::dvec3 white{0.0};
    for (std::size_t band = 0; band < kBands; ++band) {
        const glm::dvec3 rgb = rec709FromXyz * observer(wavelength(band)) * kDaylight[band];
        for (int c = 0; c < 3; ++c) water.weights[c][band] = rgb[c];
        white += rgb;
    }
    for (int c = 0; c < 3; ++c)
        for (double& weight : water.weights[c]) weight /= white[c];
}

// Edges at 495 and 585 nm, 8 nm soft: of such triples the one that errs least over seven pigments.
void setReflectances(WaterSpectra& water) {
    const auto step = [](double x) { return 1.0 / (1.0 + std::exp(-x / 8.0)); };
    for (std::size_t band = 0; band < kBands; ++band) {
        const double red = step(wavelength(band) - 585.0);
        const double blue = 1.0 - step(wavelength(band) - 495.0);
        water.reflectances[0][band] = red;
        water.reflectances[1][band] = 1.0 - red - blue;
        water.reflectances[2][band] = blue;
    }
}

double rangeAt(int i) {
    const double u = static_cast<double>(i) / (kRanges - 1);
    return kFarthestMetres * u * u;
}
double depthAt(int i) {
    const double v = static_cast<double>(i) / (kDepths - 1);
    return (kDeepestMetres + kDepthOffsetMetres) * v * v - kDepthOffsetMetres;
}
double riseAt(int i) {
    return 2.0 * i / (kRises - 1) - 1.0;
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

// b (1 - exp(-k r)) / k with k = kappa - Kd w_y: looking up, the light grows on the way.
double pathScattering(const WaterSpectra& water, std::size_t band, double range, double rise) {
    const double k = std::max(beamAttenuation(water, band) - water.downwelling[band] * rise, 0.004);
    return water.scattering[band] * (1.0 - std::exp(-k * range)) / k;
}

}  // namespace

double beamAttenuation(const WaterSpectra& water, std::size_t band) {
    return water.absorption[band] + (1.0 - kStaysInPicture) * water.scattering[band];
}

WaterSpectra oceanWater() {
    constexpr double kParticles = 0.045;  // scattering at 550 nm, 1/m, of clear ocean water
    constexpr double kMeanCosine = 0.9;   // of the light that comes down
    WaterSpectra water;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = wavelength(band);
        const double kd = sampled(kDownwelling, nm);
        // Sea water itself scatters as in Morel 1974, particles as 1/lambda.
        const double b = 0.0076 * std::pow(400.0 / nm, 4.32) + kParticles * 550.0 / nm;
        // Kirk: (Kd mu)^2 = a^2 + 0.256 a b, solved for a; never clearer than water.
        const double half = 0.128 * b;
        const double a = std::sqrt(half * half + kd * kd * kMeanCosine * kMeanCosine) - half;
        water.scattering[band] = b;
        water.absorption[band] = std::max(a, 0.95 * sampled(kPureAbsorption, nm));
        water.downwelling[band] = kd;
    }
    setWeights(water);
    setReflectances(water);
    return water;
}

Table bakeDirect(const WaterSpectra& water) {
    Table table{kRanges, kDepths, 3, {}};
    table.texels.resize(std::size_t{kRanges} * kDepths * 3);
    std::size_t at = 0;
    const glm::dmat3 surfacesFromColour = glm::inverse(transmitted(water, 0.0, 0.0));
    for (int depth = 0; depth < kDepths; ++depth)
        for (int range = 0; range < kRanges; ++range) {
            const glm::dmat3 seen =
                transmitted(water, rangeAt(range), depthAt(depth)) * surfacesFromColour;
            for (int column = 0; column < 3; ++column)
                table.texels[at + static_cast<std::size_t>(column) * kRanges * kDepths] =
                    glm::vec3(seen[column]);
            ++at;
        }
    return table;
}

Inscatter::Inscatter(const WaterSpectra& water) : water_{water} {
    // One more column than the tables of an eye: the open water's 60 m.
    for (int rise = 0; rise < kRises; ++rise)
        for (int range = 0; range <= kRanges; ++range) {
            const double metres = range < kRanges ? rangeAt(range) : kOpenWaterMetres;
            Spectrum& path = paths_.emplace_back();
            for (std::size_t band = 0; band < kBands; ++band)
                path[band] = pathScattering(water, band, metres, riseAt(rise));
        }
}

Spectrum Inscatter::lightAt(double depthMetres) const {
    Spectrum light;
    for (std::size_t band = 0; band < kBands; ++band)
        light[band] = std::exp(-water_.downwelling[band] * depthMetres);
    return light;
}

glm::vec3 Inscatter::along(const Spectrum& light, int range, int rise) const {
    const Spectrum& path =
        paths_[static_cast<std::size_t>(rise) * (kRanges + 1) + static_cast<std::size_t>(range)];
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < kBands; ++band)
        for (int c = 0; c < 3; ++c) sum[c] += water_.weights[c][band] * light[band] * path[band];
    return glm::vec3(sum);
}

Table Inscatter::atDepth(double depthMetres) const {
    const Spectrum light = lightAt(depthMetres);
    Table table{kRanges, kRises, 1, {}};
    for (int rise = 0; rise < kRises; ++rise)
        for (int range = 0; range < kRanges; ++range)
            table.texels.push_back(along(light, range, rise));
    return table;
}

Table Inscatter::openWater() const {
    Table table{kDepths, kRises, 1, {}};
    for (int rise = 0; rise < kRises; ++rise)
        for (int depth = 0; depth < kDepths; ++depth)
            table.texels.push_back(along(lightAt(depthAt(depth)), kRanges, rise));
    return table;
}

}  // namespace aquarama
