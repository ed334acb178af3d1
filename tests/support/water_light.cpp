// SPDX-License-Identifier: Apache-2.0
#include "tests/support/water_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

namespace aquarama::test {

namespace {

using std::numbers::pi;

constexpr double kIndex = 1.34;
constexpr double kSunShare = 0.8;  // of the irradiance just below the surface
constexpr double kDiscTangent = 0.1;
constexpr double kSunRadius = 3.0 * pi / 180.0;  // as the waves spread it

// Fournier and Forand, as Mobley, Sundman and Boss 2002 give it.
double fournierForand(double angle) {
    constexpr double kParticleIndex = 1.10;
    constexpr double kSlope = 3.5835;
    constexpr double kNu = (3 - kSlope) / 2;
    const auto delta = [](double psi) {
        const double s = std::sin(psi / 2);
        return 4.0 / (3.0 * (kParticleIndex - 1) * (kParticleIndex - 1)) * s * s;
    };
    const double d = delta(angle);
    const double back = delta(pi);
    const double s2 = std::pow(std::sin(angle / 2), 2);
    const double power = std::pow(d, kNu);
    const double backPower = std::pow(back, kNu);
    const double cosine = std::cos(angle);
    return (kNu * (1 - d) - (1 - power) + (d * (1 - power) - kNu * (1 - d)) / s2) /
               (4 * pi * (1 - d) * (1 - d) * power) +
           (1 - backPower) / (16 * pi * (back - 1) * backPower) * (3 * cosine * cosine - 1);
}

// splitmix64: Steele, Lea and Flood 2014.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_{seed} {}
    double unit() {
        state_ += 0x9e3779b97f4a7c15;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111eb;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
    }

  private:
    std::uint64_t state_;
};

class Mean {
  public:
    void add(double value) {
        sum_ += value;
        squares_ += value * value;
        ++count_;
    }
    [[nodiscard]] Estimate estimate() const {
        const double mean = sum_ / count_;
        const double variance = std::max(squares_ / count_ - mean * mean, 0.0);
        return {mean, std::sqrt(variance / count_)};
    }

  private:
    double sum_ = 0, squares_ = 0;
    double count_ = 0;
};

glm::dvec3 turned(glm::dvec3 d, double angle, double around) {
    const glm::dvec3 aside = std::abs(d.y) < 0.99 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
    const glm::dvec3 u = glm::normalize(glm::cross(aside, d));
    const glm::dvec3 v = glm::cross(d, u);
    return glm::normalize(d * std::cos(angle) +
                          (u * std::cos(around) + v * std::sin(around)) * std::sin(angle));
}

// Faces the eye, which is at the origin of its plane.
struct Disc {
    glm::dvec3 centre{}, normal{};
    double radius = 0;
    [[nodiscard]] std::optional<double> hitAfter(glm::dvec3 from, glm::dvec3 way) const {
        const double towards = glm::dot(way, normal);
        if (towards == 0) return {};
        const double t = glm::dot(centre - from, normal) / towards;
        if (t <= 0 || glm::length(from + way * t - centre) > radius) return {};
        return t;
    }
};

struct Light {
    const ForwardPhase& phase;
    glm::dvec3 sun{0, 1, 0};
    double albedo = 0;
    double hidden = 1e9;  // deeper than this no path comes back
    // Sun's irradiance across its rays, and the radiance of the sky within Snell's window.
    [[nodiscard]] double sunAcross() const { return kSunShare / sun.y; }
    [[nodiscard]] static double skyRadiance() { return (1 - kSunShare) * kIndex * kIndex / pi; }
};

const double kWindowCosine = std::sqrt(1 - 1 / (kIndex * kIndex));

// A path of light, followed backwards from where it has just been scattered (or received): what it
// brings. It ends at the disc.
double followed(const Light& light,
                const Disc& disc,
                glm::dvec3 place,
                glm::dvec3 way,
                bool isScattered,
                Random& random) {
    double brought = 0;
    double weight = 1;
    bool atCollision = isScattered;
    while (true) {
        if (atCollision) {
            weight *= light.albedo;
            const double towardsSun = glm::dot(way, light.sun);
            if (!disc.hitAfter(place, light.sun))
                brought += weight * light.phase.towardsSun(towardsSun) * light.sunAcross() *
                           std::exp(place.y / light.sun.y);
            if (weight < 0.2) {  // Russian roulette
                if (random.unit() > 0.5) return brought;
                weight *= 2;
            }
            way = turned(way, light.phase.angleAt(random.unit()), 2 * pi * random.unit());
        }
        const double flight = -std::log(1 - random.unit());
        const auto hit = disc.hitAfter(place, way);
        const double toSurface =
            way.y > 0 ? -place.y / way.y : std::numeric_limits<double>::infinity();
        if (hit && *hit < std::min(flight, toSurface)) return brought;
        atCollision = flight < toSurface;
        if (!atCollision) {
            if (way.y > kWindowCosine) return brought + weight * Light::skyRadiance();
            place += way * toSurface;
            place.y = -1e-12;
            way.y = -way.y;
            continue;
        }
        place += way * flight;
        if (-place.y > light.hidden) return brought;
    }
}

constexpr double kNoReturn = 12;  // optical depth below the eye

}  // namespace

ForwardPhase::ForwardPhase(double peakRadians) {
    constexpr int kSteps = 3000;
    for (int i = 0; i <= kSteps; ++i)
        angles_.push_back(1e-6 * std::pow(pi / 1e-6, static_cast<double>(i) / kSteps));
    angles_.back() = pi;
    shares_.assign(angles_.size(), 0);
    for (std::size_t i = 1; i < angles_.size(); ++i) {
        const double middle = std::sqrt(angles_[i - 1] * angles_[i]);
        shares_[i] = shares_[i - 1] + 2 * pi * std::sin(middle) * fournierForand(middle) *
                                          (angles_[i] - angles_[i - 1]);
    }
    const double whole = shares_.back();
    for (double& share : shares_) share /= whole;
    peakShare_ = peakRadians > 0 ? shareWithin(peakRadians) : 0;
    for (double& share : shares_) share = std::max((share - peakShare_) / (1 - peakShare_), 0.0);
    constexpr int kShares = 1 << 15;
    std::size_t at = 1;
    for (int i = 0; i <= kShares; ++i) {
        const double share = static_cast<double>(i) / kShares;
        while (at + 1 < shares_.size() && shares_[at] < share) ++at;
        const double t = (share - shares_[at - 1]) / std::max(shares_[at] - shares_[at - 1], 1e-12);
        angleOfShare_.push_back(angles_[at - 1] +
                                std::clamp(t, 0.0, 1.0) * (angles_[at] - angles_[at - 1]));
    }
    // Towards a disc rather than a point: what is scattered by `angle` within the disc, a ring of
    // angles about the way after the other.
    constexpr int kTable = 720;
    for (int i = 0; i <= kTable; ++i) {
        const double away = pi * i / kTable;
        double sum = 0;
        for (std::size_t ring = 1; ring < angles_.size(); ++ring) {
            const double angle = std::sqrt(angles_[ring - 1] * angles_[ring]);
            const double cosine = (std::cos(kSunRadius) - std::cos(away) * std::cos(angle)) /
                                  std::max(std::sin(away) * std::sin(angle), 1e-12);
            const double within = std::acos(std::clamp(cosine, -1.0, 1.0)) / pi;
            sum += within * (shares_[ring] - shares_[ring - 1]);
        }
        sun_.push_back(sum / (2 * pi * (1 - std::cos(kSunRadius))));
    }
}

double ForwardPhase::angleAt(double share) const {
    const double place = share * static_cast<double>(angleOfShare_.size() - 1);
    const auto left = std::min(static_cast<std::size_t>(place), angleOfShare_.size() - 2);
    const double t = place - static_cast<double>(left);
    return angleOfShare_[left] * (1 - t) + angleOfShare_[left + 1] * t;
}

double ForwardPhase::towardsSun(double cosine) const {
    const double place =
        std::acos(std::clamp(cosine, -1.0, 1.0)) / pi * static_cast<double>(sun_.size() - 1);
    const auto left = std::min(static_cast<std::size_t>(place), sun_.size() - 2);
    const double t = place - static_cast<double>(left);
    return sun_[left] * (1 - t) + sun_[left + 1] * t;
}

double ForwardPhase::shareWithin(double radians) const {
    const auto above = std::ranges::lower_bound(angles_, radians);
    return shares_[static_cast<std::size_t>(above - angles_.begin())];
}

Estimate scatteredIn(const ForwardPhase& phase,
                     const SeenWater& seen,
                     glm::dvec3 towardsSun,
                     int paths,
                     std::uint64_t seed) {
    const glm::dvec3 eye{0, -seen.depth, 0};
    const glm::dvec3 way = seen.direction;
    const double range = way.y > 0 ? std::min(seen.range, seen.depth / way.y) : seen.range;
    const Disc disc{eye + way * seen.range, way, kDiscTangent * seen.range};
    const Light light{phase, towardsSun, seen.albedo, seen.depth + kNoReturn};
    const double scattered = 1 - std::exp(-range);  // the first flight always ends in the ray
    Random random{seed};
    Mean mean;
    for (int i = 0; i < paths; ++i) {
        const double flight = -std::log(1 - scattered * random.unit());
        mean.add(scattered * followed(light, disc, eye + way * flight, way, true, random));
    }
    return mean.estimate();
}

Estimate transmitted(const ForwardPhase& phase,
                     double albedo,
                     double range,
                     double radius,
                     int paths,
                     std::uint64_t seed) {
    const Disc disc{{0, 0, -range}, {0, 0, -1}, radius * range};
    Random random{seed};
    Mean mean;
    for (int i = 0; i < paths; ++i) {
        glm::dvec3 place{0.0};
        glm::dvec3 way{0, 0, -1};
        double weight = 1;
        double arrived = 0;
        while (weight > 1e-3 && glm::length(place) < 3 * range) {
            const double flight = -std::log(1 - random.unit());
            const auto hit = disc.hitAfter(place, way);
            if (hit && *hit < flight) {
                arrived = way.z < 0 ? weight : 0;
                break;
            }
            place += way * flight;
            weight *= albedo;
            way = turned(way, phase.angleAt(random.unit()), 2 * pi * random.unit());
        }
        mean.add(arrived);
    }
    return mean.estimate();
}

Estimate irradiance(const ForwardPhase& phase,
                    double albedo,
                    double depth,
                    glm::dvec3 towardsSun,
                    int paths,
                    std::uint64_t seed) {
    const Light light{phase, towardsSun, albedo, depth + kNoReturn};
    const Disc none{{0, 1e9, 0}, {0, 1, 0}, 0};
    Random random{seed};
    Mean mean;
    for (int i = 0; i < paths; ++i) {
        const double sine = std::sqrt(random.unit());
        const glm::dvec3 up = turned({0, 1, 0}, std::asin(sine), 2 * pi * random.unit());
        mean.add(pi * followed(light, none, {0, -depth, 0}, up, false, random));
    }
    Estimate all = mean.estimate();
    all.mean += kSunShare * std::exp(-depth / towardsSun.y);
    return all;
}

}  // namespace aquarama::test
