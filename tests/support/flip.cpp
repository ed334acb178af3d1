// SPDX-License-Identifier: Apache-2.0
#include "tests/support/flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::test {

namespace {

// Columns of linear Rec. 709 to XYZ (D65).
const glm::dmat3 kXyzFromRgb{{10135552.0 / 24577794, 871024.0 / 4096299, 79184.0 / 4096299},
                             {8788810.0 / 24577794, 8788810.0 / 12288897, 4394405.0 / 36866691},
                             {4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382}};
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1.0);

struct Image {
    glm::ivec2 size{};
    std::vector<glm::dvec3> values;
    [[nodiscard]] glm::dvec3 at(int x, int y) const {  // the border goes on for ever
        const glm::ivec2 p = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), size - 1);
        return values[static_cast<std::size_t>(p.y * size.x + p.x)];
    }
};

Image mapped(Image image, const std::function<glm::dvec3(glm::dvec3)>& to) {
    std::ranges::transform(image.values, image.values.begin(), to);
    return image;
}

Image linearOf(const Picture& picture) {
    Image image{picture.sizePixels, {}};
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        glm::dvec3 colour;
        for (int c = 0; c < 3; ++c) {
            const double code = picture.rgb[i + static_cast<std::size_t>(c)] / 255.0;
            colour[c] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        }
        image.values.push_back(colour);
    }
    return image;
}

glm::dvec3 opponentFromLinear(glm::dvec3 rgb) {  // YCxCz
    const glm::dvec3 n = kXyzFromRgb * rgb / kWhite;
    return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

glm::dvec3 linearFromOpponent(glm::dvec3 c) {
    const double y = (c.x + 16.0) / 116.0;
    const glm::dvec3 n{y + c.y / 500.0, y, y - c.z / 200.0};
    return glm::inverse(kXyzFromRgb) * (n * kWhite);
}

// CIELAB, with chroma that grows with lightness (Hunt).
glm::dvec3 perceived(glm::dvec3 rgb) {
    const glm::dvec3 n = kXyzFromRgb * glm::clamp(rgb, 0.0, 1.0) / kWhite;
    glm::dvec3 f;
    constexpr double kDelta = 6.0 / 29.0;
    for (int c = 0; c < 3; ++c)
        f[c] = n[c] > kDelta * kDelta * kDelta ? std::cbrt(n[c])
                                               : n[c] / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    const double lightness = 116.0 * f.y - 16.0;
    return {
        lightness, 0.01 * lightness * 500.0 * (f.x - f.y), 0.01 * lightness * 200.0 * (f.y - f.z)};
}

double hyab(glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

// A kernel that is a product, along x and along y, for each channel.
Image filtered(const Image& image,
               const std::vector<glm::dvec3>& alongX,
               const std::vector<glm::dvec3>& alongY) {
    const int radius = static_cast<int>(alongX.size()) / 2;
    Image across{image.size, {}}, all{image.size, {}};
    const auto pass =
        [&](const Image& from, Image& to, const std::vector<glm::dvec3>& weights, glm::ivec2 step) {
            for (int y = 0; y < image.size.y; ++y)
                for (int x = 0; x < image.size.x; ++x) {
                    glm::dvec3 sum{};
                    for (int k = -radius; k <= radius; ++k)
                        sum += weights[static_cast<std::size_t>(k + radius)] *
                               from.at(x + k * step.x, y + k * step.y);
                    to.values.push_back(sum);
                }
        };
    pass(image, across, alongX, {1, 0});
    pass(across, all, alongY, {0, 1});
    return all;
}

// What the eye's contrast sensitivity leaves, by channel: achromatic, red-green, and blue-yellow,
// which is a sum of two Gaussians.
struct Gaussian {
    double a, b;
};
std::vector<double> kernelOf(const Gaussian& g, int radius, double pixelsPerDegree) {
    std::vector<double> kernel;
    for (int k = -radius; k <= radius; ++k) {
        const double degrees = k / pixelsPerDegree;
        kernel.push_back(std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / g.b));
    }
    return kernel;
}

Image sensed(const Image& opponent, double pixelsPerDegree) {
    constexpr Gaussian kLight{1.0, 0.0047}, kRedGreen{1.0, 0.0053}, kWide{34.1, 0.04},
        kNarrow{13.5, 0.025};
    const int radius = static_cast<int>(std::ceil(
        3.0 * std::sqrt(kWide.b / (2.0 * std::numbers::pi * std::numbers::pi)) * pixelsPerDegree));
    const auto blurred = [&](const Gaussian& first, const Gaussian& second, const Gaussian& third) {
        std::vector<glm::dvec3> weights;
        glm::dvec3 sum{};
        const auto x = kernelOf(first, radius, pixelsPerDegree),
                   y = kernelOf(second, radius, pixelsPerDegree),
                   z = kernelOf(third, radius, pixelsPerDegree);
        for (std::size_t k = 0; k < x.size(); ++k) {
            weights.emplace_back(x[k], y[k], z[k]);
            sum += weights.back();
        }
        for (glm::dvec3& weight : weights) weight /= sum;
        return filtered(opponent, weights, weights);
    };
    // The share of each of the two Gaussians in the whole kernel: its height times its sum.
    const auto mass = [&](const Gaussian& g) {
        const auto kernel = kernelOf(g, radius, pixelsPerDegree);
        const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
        return g.a * std::sqrt(std::numbers::pi / g.b) * sum * sum;
    };
    const double wide = mass(kWide) / (mass(kWide) + mass(kNarrow));
    Image result = blurred(kLight, kRedGreen, kWide);
    const Image narrow = blurred(kLight, kRedGreen, kNarrow);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i].z = wide * result.values[i].z + (1.0 - wide) * narrow.values[i].z;
    return result;
}

std::vector<double> colourDifference(const Image& a, const Image& b, double pixelsPerDegree) {
    constexpr double kExponent = 0.7, kKnee = 0.4, kKneeValue = 0.95;
    const double most = std::pow(hyab(perceived({0, 1, 0}), perceived({0, 0, 1})), kExponent);
    const auto lab = [&](const Image& opponent) {
        return mapped(sensed(opponent, pixelsPerDegree),
                      [](glm::dvec3 c) { return perceived(linearFromOpponent(c)); });
    };
    const Image one = lab(a), other = lab(b);
    std::vector<double> differences;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const double d = std::pow(hyab(one.values[i], other.values[i]), kExponent);
        const double knee = kKnee * most;
        differences.push_back(d < knee
                                  ? d * kKneeValue / knee
                                  : kKneeValue + (d - knee) / (most - knee) * (1.0 - kKneeValue));
    }
    return differences;
}

// Edges and points: first and second derivatives of a Gaussian as wide as what the eye resolves,
// positive and negative weights summing to one each.
struct Features {
    std::vector<double> edges, points;
};

std::vector<glm::dvec3> sameForAll(const std::vector<double>& weights) {
    std::vector<glm::dvec3> all;
    for (const double weight : weights) all.emplace_back(weight);
    return all;
}

Features featuresOf(const Image& opponent, double pixelsPerDegree) {
    constexpr double kWidthDegrees = 0.082;
    const double sigma = 0.5 * kWidthDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> smooth, first, second;
    for (int k = -radius; k <= radius; ++k) {
        const double g = std::exp(-k * k / (2.0 * sigma * sigma));
        smooth.push_back(g);
        first.push_back(-k * g);
        second.push_back((k * k / (sigma * sigma) - 1.0) * g);
    }
    const double sum = std::accumulate(smooth.begin(), smooth.end(), 0.0);
    for (double& weight : smooth) weight /= sum;
    for (auto* kernel : {&first, &second}) {
        double positive = 0, negative = 0;
        for (const double weight : *kernel) (weight > 0 ? positive : negative) += weight;
        for (double& weight : *kernel) weight /= weight > 0 ? positive : -negative;
    }
    const Image light =
        mapped(opponent, [](glm::dvec3 c) { return glm::dvec3((c.x + 16.0) / 116.0); });
    const auto norm = [&](const std::vector<double>& kernel) {
        const Image x = filtered(light, sameForAll(kernel), sameForAll(smooth));
        const Image y = filtered(light, sameForAll(smooth), sameForAll(kernel));
        std::vector<double> norms;
        for (std::size_t i = 0; i < x.values.size(); ++i)
            norms.push_back(std::hypot(x.values[i].x, y.values[i].x));
        return norms;
    };
    return {norm(first), norm(second)};
}

}  // namespace

std::vector<double> flip(const Picture& reference, const Picture& other, double pixelsPerDegree) {
    const Image a = mapped(linearOf(reference), opponentFromLinear);
    const Image b = mapped(linearOf(other), opponentFromLinear);
    std::vector<double> result = colourDifference(a, b, pixelsPerDegree);
    const Features one = featuresOf(a, pixelsPerDegree), two = featuresOf(b, pixelsPerDegree);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double feature = std::max(std::abs(one.edges[i] - two.edges[i]),
                                        std::abs(one.points[i] - two.points[i]));
        const double amplified = std::sqrt(feature / std::numbers::sqrt2);
        result[i] = std::pow(result[i], 1.0 - amplified);
    }
    return result;
}

double meanFlip(const Picture& reference, const Picture& other) {
    const std::vector<double> all = flip(reference, other);
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

}  // namespace aquarama::test
