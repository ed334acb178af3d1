// SPDX-License-Identifier: Apache-2.0
#include "render_node/water/water_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "common/base/derived_cache.h"
#include "common/base/picture.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/water/water_lobes.h"

namespace aquarama::scene {

namespace {

// Values at N wavelengths, evenly spaced from 400 to 700 nm, 1/m.
template <std::size_t N>
using Samples = std::array<double, N>;

template <std::size_t N>
// Linear interpolation at a wavelength.
double sampled(const Samples<N>& samples, double nanometres) {
    const double place = (nanometres - 400.0) / 300.0 * (N - 1);
    const auto left = static_cast<std::size_t>(std::clamp(place, 0.0, N - 2.0));
    const double share = place - static_cast<double>(left);
    return samples[left] * (1.0 - share) + samples[left + 1] * share;
}

// Measured coefficients at 20 wavelengths. Source: Williamson and Hollins 2022, Applied Optics
// 61(33) 9951, data doi 10.6084/m9.figshare.20290782. They give b, c and Kd; a = c - b.
constexpr std::size_t kMeasured = 20;
struct MeasuredWater {
    Samples<kMeasured> absorption, scattering, downwelling;
};
constexpr MeasuredWater kIB{
    .absorption = {.045, .043, .042, .041, .038, .037, .038, .046, .052, .059,
                   .072, .088, .138, .252, .286, .310, .347, .412, .453, .573},
    .scattering = {.144, .141, .138, .135, .133, .130, .129, .127, .124, .123,
                   .121, .120, .119, .117, .116, .115, .114, .113, .112, .111},
    .downwelling = {.051, .045, .040, .037, .034, .034, .040, .047, .055, .066,
                    .080, .098, .184, .260, .304, .343, .381, .419, .488, .580}};
constexpr MeasuredWater kII{
    .absorption = {.074, .071, .067, .063, .058, .054, .053, .057, .061, .066,
                   .078, .094, .143, .255, .289, .314, .350, .416, .457, .575},
    .scattering = {.209, .204, .200, .196, .192, .189, .186, .183, .180, .178,
                   .175, .173, .171, .169, .167, .165, .164, .162, .161, .159},
    .downwelling = {.096, .087, .078, .069, .065, .063, .068, .073, .077, .085,
                    .097, .114, .199, .276, .323, .366, .407, .448, .518, .610}};
constexpr MeasuredWater kIII{
    .absorption = {.130, .128, .124, .114, .102, .092, .085, .083, .082, .083,
                   .092, .105, .154, .266, .301, .325, .365, .438, .475, .581},
    .scattering = {.324, .319, .315, .310, .306, .302, .298, .295, .292, .289,
                   .285, .282, .280, .277, .275, .273, .270, .268, .266, .264},
    .downwelling = {.185, .169, .153, .138, .125, .116, .115, .115, .116, .119,
                    .129, .147, .233, .312, .362, .408, .453, .500, .572, .660}};
constexpr MeasuredWater k1C{
    .absorption = {.186, .178, .168, .152, .134, .117, .107, .101, .097, .096,
                   .101, .113, .161, .273, .308, .333, .373, .454, .487, .585},
    .scattering = {.474, .468, .462, .456, .451, .446, .442, .437, .433, .429,
                   .425, .421, .418, .414, .411, .408, .405, .402, .399, .396},
    .downwelling = {.510, .415, .331, .262, .208, .165, .146, .136, .129, .123,
                    .129, .148, .237, .315, .359, .408, .456, .494, .562, .650}};
constexpr MeasuredWater k3C{
    .absorption = {.236, .234, .227, .206, .182, .161, .148, .139, .131, .127,
                   .127, .136, .183, .293, .329, .353, .394, .484, .513, .598},
    .scattering = {.713, .704, .695, .687, .680, .673, .666, .660, .653, .647,
                   .642, .636, .631, .625, .621, .616, .611, .607, .603, .599},
    .downwelling = {.780, .628, .501, .406, .337, .279, .235, .212, .199, .193,
                    .196, .209, .279, .345, .389, .428, .471, .534, .615, .710}};

// Types I and IA, the clearest, which were not measured: Kd by Jerlov 1976, table XXVII, as updated
// by Austin and Petzold 1984. Absorption of pure water by Pope and Fry 1997. 13 wavelengths.
constexpr std::size_t kDerived = 13;
constexpr Samples<kDerived> kDownwellingI{
    .0217, .0185, .0176, .0184, .0280, .0504, .0640, .0931, .2408, .3174, .3559, .4372, .6513};
constexpr Samples<kDerived> kDownwellingIA{
    .0316, .0280, .0257, .0250, .0332, .0545, .0674, .0960, .2437, .3206, .3601, .4410, .6530};
constexpr Samples<kDerived> kPureAbsorption{
    .00663, .00478, .00922, .0114, .0204, .0417, .0565, .0772, .2224, .2834, .340, .448, .624};

// CIE standard illuminant D65 at the 31 bands.
constexpr Spectrum kDaylight{82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81, 114.86,
                             115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
                             100.0,  96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,
                             83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61};

// Derives a and b of types I and IA. b = b_w + b_p 550 / lambda, with sea water's own b_w = 0.0076
// (400 / lambda)^4.32 (Morel 1974) and b_p of clear ocean water at 550 nm (`particles`, 1/m). a is
// the root of Kirk's (Kd mu)^2 = a^2 + 0.256 a b with the mean cosine mu = 0.9, and at least 0.95
// of that of pure water.
void derive(WaterSpectra& water, const Samples<kDerived>& downwelling, double particles) {
    constexpr double kMeanCosine = 0.9;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = wavelengthOf(band);
        const double kd = sampled(downwelling, nm);
        const double b = 0.0076 * std::pow(400.0 / nm, 4.32) + particles * 550.0 / nm;
        const double half = 0.128 * b;
        const double a = std::sqrt(half * half + kd * kd * kMeanCosine * kMeanCosine) - half;
        water.scattering[band] = b;
        water.absorption[band] = std::max(a, 0.95 * sampled(kPureAbsorption, nm));
        water.downwelling[band] = kd;
    }
}

// Resamples measured coefficients at the bands.
void copy(WaterSpectra& water, const MeasuredWater& measured) {
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = wavelengthOf(band);
        water.absorption[band] = sampled(measured.absorption, nm);
        water.scattering[band] = sampled(measured.scattering, nm);
        water.downwelling[band] = sampled(measured.downwelling, nm);
    }
}

// A Gaussian whose widths differ below and above its peak; `below` and `above` are 1 / sigma.
double bell(double x, double peak, double below, double above) {
    const double t = (x - peak) * (x < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

// Colour matching functions of the CIE 1931 observer, as fitted by Wyman, Sloan and Shirley 2013
// (JCGT 2:2).
glm::dvec3 observer(double nm) {
    return {0.362 * bell(nm, 442.0, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
                0.065 * bell(nm, 501.1, 0.0490, 0.0382),
            0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
            1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725)};
}

// Observer times D65, converted from XYZ to linear Rec. 709 and normalised so that each channel
// sums to 1.
void setWeights(WaterSpectra& water) {
    const glm::dmat3 rec709FromXyz{{3.2404542, -0.9692660, 0.0556434},
                                   {-1.5371385, 1.8760108, -0.2040259},
                                   {-0.4985314, 0.0415560, 1.0572252}};
    glm::dvec3 white{0.0};
    for (std::size_t band = 0; band < kBands; ++band) {
        const glm::dvec3 rgb = rec709FromXyz * observer(wavelengthOf(band)) * kDaylight[band];
        for (int c = 0; c < 3; ++c) water.weights[c][band] = rgb[c];
        white += rgb;
    }
    for (int c = 0; c < 3; ++c)
        for (double& weight : water.weights[c]) weight /= white[c];
}

// Three reflectances with soft edges (8 nm) at 505 and 590 nm. Among such triples these edges give
// the least error for seven pigments.
void setReflectances(WaterSpectra& water) {
    const auto step = [](double x) { return 1.0 / (1.0 + std::exp(-x / 8.0)); };
    for (std::size_t band = 0; band < kBands; ++band) {
        const double red = step(wavelengthOf(band) - 590.0);
        const double blue = 1.0 - step(wavelengthOf(band) - 505.0);
        water.reflectances[0][band] = red;
        water.reflectances[1][band] = 1.0 - red - blue;
        water.reflectances[2][band] = blue;
    }
}

}  // namespace

glm::vec3 sunInWater() {
    return glm::normalize(glm::vec3{-0.27F, 0.82F, -0.51F});
}

double wavelengthOf(std::size_t band) {
    assert(band < kBands);
    return 400.0 + 10.0 * static_cast<double>(band);
}

double beamAttenuation(const WaterSpectra& water, std::size_t band) {
    return water.absorption[band] + (1.0 - kStaysInPicture) * water.scattering[band];
}

WaterSpectra seaWater(config::WaterType type) {
    WaterSpectra water;
    switch (type) {
        case config::WaterType::I:
            derive(water, kDownwellingI, 0.016);
            break;
        case config::WaterType::IA:
            derive(water, kDownwellingIA, 0.045);
            break;
        case config::WaterType::IB:
            copy(water, kIB);
            break;
        case config::WaterType::II:
            copy(water, kII);
            break;
        case config::WaterType::III:
            copy(water, kIII);
            break;
        case config::WaterType::C1:
            copy(water, k1C);
            break;
        case config::WaterType::C3:
            copy(water, k3C);
            break;
    }
    setWeights(water);
    setReflectances(water);
    return water;
}

namespace {

// Sizes of the tables' axes.
constexpr int kRanges = 64, kDepths = 64, kRises = 32;
constexpr int kDirectLayers = 4;
// The depth of water behind which open water looks the same.
constexpr double kOpenWaterMetres = 60.0;
// Depths of the eye for which Inscatter has tables: closer together near the surface, where the
// light changes most.
constexpr int kEyes = 13;
constexpr double kDeepestEyeMetres = 40.0;

// 0 to 1 in equal steps. The functions below give the value of each axis at an index.
double evenly(int i, int count) {
    assert(count > 1);
    assert(i >= 0);
    assert(i < count);
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

// Linear Rec. 709 of a spectrum of light.
glm::dvec3 integrated(const WaterSpectra& water, const Spectrum& light) {
    glm::dvec3 sum{0.0};
    for (std::size_t band = 0; band < kBands; ++band)
        for (int c = 0; c < 3; ++c) sum[c] += water.weights[c][band] * light[band];
    return sum;
}

// What remains of a band's light after this depth and range, where `grade` is given back.
double leftOf(
    const WaterSpectra& water, std::size_t band, double range, double depth, Grade grade) {
    return std::exp(-(1.0 - grade.down) * water.downwelling[band] * depth -
                    (1.0 - grade.toEye) * beamAttenuation(water, band) * range);
}

// Luminance of white light after this depth and range.
double whiteOf(const WaterSpectra& water, double range, double depth, Grade grade) {
    Spectrum light;
    for (std::size_t band = 0; band < kBands; ++band)
        light[band] = leftOf(water, band, range, depth, grade);
    return luminance(integrated(water, light));
}

// Columns: what remains of each unit reflectance after this depth and range, in linear Rec. 709;
// graded, with the luminance that white has without a grade.
glm::dmat3 transmitted(const WaterSpectra& water, double range, double depth, Grade grade = {}) {
    glm::dmat3 columns{0.0};
    const double kept = whiteOf(water, range, depth, {}) / whiteOf(water, range, depth, grade);
    for (std::size_t band = 0; band < kBands; ++band) {
        const double left = kept * leftOf(water, band, range, depth, grade);
        for (int surface = 0; surface < 3; ++surface)
            for (int c = 0; c < 3; ++c)
                columns[surface][c] +=
                    water.weights[c][band] * left * water.reflectances[surface][band];
    }
    return columns;
}

// The light without a grade as a share of that with it, by primary. Where red has left the gamut
// there is none to be changed.
glm::vec3 ungraded(glm::dvec3 plain, glm::dvec3 graded) {
    constexpr double kMost = 8.0;
    glm::vec3 share{1.0F};
    for (int c = 0; c < 3; ++c)
        if (graded[c] > 0)
            share[c] = static_cast<float>(std::clamp(plain[c] / graded[c], 0.0, kMost));
    return share;
}

// Light scattered into one direction of view, by band: source at the eye (1/m) and loss along the
// way (1/m).
struct Ray {
    Spectrum source{}, loss{};
    // The integral of source exp(-loss r) from 0 to this range.
    [[nodiscard]] Spectrum lightBefore(double range) const {
        Spectrum light;
        for (std::size_t band = 0; band < kBands; ++band)
            light[band] = source[band] * (1.0 - std::exp(-loss[band] * range)) / loss[band];
        return light;
    }
};

// eyeDepth, metres, selects the lobe; litDepth, the depth less the filter's, attenuates the light
// from above. The least loss keeps the integral finite.
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

// Azimuth of a layer, degrees: even steps in its cosine.
double azimuthAt(int i) {
    const double cosine = std::clamp(2.0 * evenly(i, shaders::kSightAzimuths) - 1.0, -1.0, 1.0);
    return std::acos(cosine) * 180.0 / std::numbers::pi;
}

// Fractional index of a depth among the tables of Inscatter: the inverse of eyeDepthAt().
double eyePlace(double depth) {
    return std::sqrt(std::clamp(depth / kDeepestEyeMetres, 0.0, 1.0)) * (kEyes - 1);
}

// The texels of all tables, one table after the other.
std::vector<glm::vec3> allTexels(std::span<const Table> slices) {
    std::vector<glm::vec3> all;
    for (const Table& slice : slices)
        all.insert(all.end(), slice.texels.begin(), slice.texels.end());
    return all;
}

// Mixes the two tables on both sides of a fractional index into one of their size.
void mixSlices(std::span<const Table> slices, double place, Table& table) {
    const auto left = std::min(static_cast<std::size_t>(place), slices.size() - 2);
    const auto share = static_cast<float>(place - static_cast<double>(left));
    const auto& near = slices[left].texels;
    const auto& far = slices[left + 1].texels;
    assert(table.texels.size() == near.size());
    for (std::size_t i = 0; i < near.size(); ++i)
        table.texels[i] = glm::mix(near[i], far[i], share);
}

// Exposure for an eye at this depth: kKey divided by a geometric mean of near sand and of open
// water across the sun, weighted by kWater.
double exposureOf(const WaterSpectra& water, double eyeDepth) {
    constexpr double kKey = 0.124, kWater = 0.6;
    // The deep is shown darker by this, 1/m.
    constexpr double kDusk = 0.018;
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
    // The filter approaches this many metres and is nearly the depth itself near the surface.
    constexpr double kMost = 21.0;
    const double depth = std::max(eyeDepthMetres, 0.0);
    return depth / std::hypot(1.0, depth / kMost);
}

Grade gradeOf(double colourReturned) {
    constexpr double kBalancedAt = 0.8;
    assert(colourReturned >= 0);
    assert(colourReturned <= 1);
    return {.toEye = colourReturned, .down = std::min(colourReturned / kBalancedAt, 1.0)};
}

Table bakeDirect(const WaterSpectra& water, Grade grade) {
    constexpr std::size_t kLayer = std::size_t{kRanges} * kDepths;
    Table table{kRanges, kDepths, kDirectLayers, {}};
    table.texels.resize(kLayer * kDirectLayers);
    std::size_t at = 0;
    // A colour is taken as the sum of the three surfaces that gives it at no depth and no range.
    const glm::dmat3 surfacesFromColour = glm::inverse(transmitted(water, 0.0, 0.0));
    for (int depth = 0; depth < kDepths; ++depth)
        for (int range = 0; range < kRanges; ++range) {
            const double metres = rangeAt(range, kRanges);
            const glm::dmat3 left = transmitted(water, metres, depthAt(depth), grade);
            const glm::dmat3 seen = left * surfacesFromColour;
            for (std::size_t column = 0; column < 3; ++column)
                table.texels[at + column * kLayer] = glm::vec3(seen[static_cast<int>(column)]);
            const glm::dmat3 plain = transmitted(water, metres, depthAt(depth));
            table.texels[at + 3 * kLayer] = ungraded(plain * glm::dvec3{1}, left * glm::dvec3{1});
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
    assert(texels.size() == kEyes * kTexels);
    assert(exposures_.size() == kEyes);
    for (std::size_t eye = 0; eye < kEyes; ++eye) {
        const auto own = texels.subspan(eye * kTexels, kTexels);
        slices_.push_back({shaders::kSightRanges,
                           shaders::kSightRises,
                           shaders::kSightAzimuths,
                           {own.begin(), own.end()}});
    }
}

std::vector<glm::vec3> Inscatter::texels() const {
    return allTexels(slices_);
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
    mixSlices(slices_, eyePlace(eyeDepthMetres), table);
}

double Inscatter::exposureAt(double eyeDepthMetres) const {
    const double place = eyePlace(eyeDepthMetres);
    const auto left = std::min(static_cast<std::size_t>(place), exposures_.size() - 2);
    return std::lerp(exposures_[left], exposures_[left + 1], place - static_cast<double>(left));
}

namespace {

// Shares of colour returned for which there are tables.
constexpr std::size_t kShares = 6;

}  // namespace

GradedDirect::GradedDirect(const WaterSpectra& water) {
    for (std::size_t i = 0; i < kShares; ++i)
        slices_.push_back(bakeDirect(water, gradeOf(evenly(static_cast<int>(i), kShares))));
}

GradedDirect::GradedDirect(std::span<const glm::vec3> texels) {
    constexpr std::size_t kTexels = std::size_t{kRanges} * kDepths * kDirectLayers;
    assert(texels.size() == kShares * kTexels);
    for (std::size_t i = 0; i < kShares; ++i) {
        const auto own = texels.subspan(i * kTexels, kTexels);
        slices_.push_back({kRanges, kDepths, kDirectLayers, {own.begin(), own.end()}});
    }
}

std::vector<glm::vec3> GradedDirect::texels() const {
    return allTexels(slices_);
}

Table GradedDirect::at(double colourReturned) const {
    Table table = slices_.front();
    mixAt(colourReturned, table);
    return table;
}

void GradedDirect::mixAt(double colourReturned, Table& table) const {
    mixSlices(slices_, colourReturned * (kShares - 1), table);
}

namespace {

// The tables as flat arrays, as the cache of derived data stores them.
struct WaterArrays {
    std::vector<glm::vec3> inscatter, direct, openWater;
    std::vector<double> exposures;

    auto arrays() { return std::tie(inscatter, direct, openWater, exposures); }
};

}  // namespace

WaterTables waterTables(config::WaterType type) {
    WaterArrays kept = derivedTables<WaterArrays>(DerivedKey("water").add(type), [&] {
        const WaterSpectra water = seaWater(type);
        const Inscatter inscatter{water};
        return WaterArrays{inscatter.texels(),
                           GradedDirect{water}.texels(),
                           bakeOpenWater(water).texels,
                           inscatter.exposures()};
    });
    return {Inscatter{kept.inscatter, std::move(kept.exposures)},
            GradedDirect{kept.direct},
            {kDepths, kRises, 1, std::move(kept.openWater)}};
}

glm::vec3 primariesDownwelling(const WaterSpectra& water, Grade grade) {
    constexpr double kFrom = -2.0, kTo = 2.0;
    const glm::dvec3 above = transmitted(water, 0, kFrom, grade) * glm::dvec3{1.0};
    const glm::dvec3 below = transmitted(water, 0, kTo, grade) * glm::dvec3{1.0};
    return glm::vec3(glm::log(above / below) / (kTo - kFrom));
}

}  // namespace aquarama::scene
