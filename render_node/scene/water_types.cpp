// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/water_types.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace aquarama::scene {

namespace {

// Evenly from 400 to 700 nm, 1/m.
template <std::size_t N>
using Samples = std::array<double, N>;

template <std::size_t N>
double sampled(const Samples<N>& samples, double nanometres) {
    const double place = (nanometres - 400.0) / 300.0 * (N - 1);
    const auto left = static_cast<std::size_t>(std::clamp(place, 0.0, N - 2.0));
    const double share = place - static_cast<double>(left);
    return samples[left] * (1.0 - share) + samples[left + 1] * share;
}

// Williamson and Hollins 2022, Applied Optics 61(33) 9951, data doi 10.6084/m9.figshare.20290782:
// b, c and Kd, read at 20 wavelengths; a = c - b.
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

// Jerlov 1976, table XXVII, as updated by Austin and Petzold 1984: Kd of the clearest types. Pure
// water: Pope and Fry 1997.
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

// a and b of I and IA are derived, not measured: b = b_w + b_p 550 / lambda with sea water's own
// b_w = 0.0076 (400 / lambda)^4.32 (Morel 1974) and b_p of clear ocean water at 550 nm; a from
// Kirk's (Kd mu)^2 = a^2 + 0.256 a b with the mean cosine mu = 0.9; never clearer than 0.95 of pure
// water.
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

void copy(WaterSpectra& water, const MeasuredWater& measured) {
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = wavelengthOf(band);
        water.absorption[band] = sampled(measured.absorption, nm);
        water.scattering[band] = sampled(measured.scattering, nm);
        water.downwelling[band] = sampled(measured.downwelling, nm);
    }
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
        const glm::dvec3 rgb = rec709FromXyz * observer(wavelengthOf(band)) * kDaylight[band];
        for (int c = 0; c < 3; ++c) water.weights[c][band] = rgb[c];
        white += rgb;
    }
    for (int c = 0; c < 3; ++c)
        for (double& weight : water.weights[c]) weight /= white[c];
}

// Edges at 505 and 590 nm, 8 nm soft: of such triples the one that errs least over seven pigments.
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

double wavelengthOf(std::size_t band) {
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

}  // namespace aquarama::scene
