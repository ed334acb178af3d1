// SPDX-License-Identifier: Apache-2.0
#include "calibration/light/level_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/picture.h"

namespace aquarama::light {

namespace {

using Kind = config::ScanPattern::Kind;

Light meanBlack(const scan::CameraView& view) {
    Light sum;
    float count = 0;
    for (const scan::SampledPicture& picture : view.samples) {
        if (!isBlack(picture.pattern)) continue;
        if (count == 0) sum = darkness(picture.light.sizePixels);
        for (std::size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] += picture.light.rgb[i];
        ++count;
    }
    for (glm::vec3& rgb : sum.rgb) rgb /= count;
    return sum;
}

bool isInBand(int at, int samples) {
    return std::ranges::any_of(kBands, [&](double band) {
        const int first = firstOfBand(band, samples);
        return at >= first && at < first + kBandWidth;
    });
}

}  // namespace

int firstOfBand(double at, int samples) {
    return static_cast<int>(at * samples) - kBandWidth / 2;
}

bool isHeldOut(glm::ivec2 size, std::size_t index) {
    const int i = static_cast<int>(index);
    return isInBand(i % size.x, size.x) || isInBand(i / size.x, size.y);
}

LevelSamples::LevelSamples(const scan::CameraView& view) : view_{view}, black_{meanBlack(view)} {
    for (std::size_t c = 0; c < view.channels.size(); ++c)
        whites_.push_back(levelOf(config::bitOf(c), glm::vec3(1)));
}

bool LevelSamples::isWhole() const {
    return !black_.rgb.empty() && std::ranges::find(whites_, nullptr) == whites_.end() &&
           std::ranges::none_of(view_.channels,
                                [](const auto& channel) { return channel.place.empty(); });
}

const scan::SampledPicture* LevelSamples::level(glm::vec3 light) const {
    return levelOf((std::uint64_t{1} << channels()) - 1, light);
}

std::vector<const scan::SampledPicture*> LevelSamples::greys() const {
    std::vector<const scan::SampledPicture*> greys;
    for (const auto& sample : view_.samples) {
        const float grey = sample.pattern.light.x;
        if (grey > 0 && grey < 1 && level(glm::vec3(grey)) == &sample) greys.push_back(&sample);
    }
    std::ranges::sort(greys, {}, [](const auto* sample) { return sample->pattern.light.x; });
    return greys;
}

glm::dvec3 LevelSamples::whites(std::uint64_t lit, std::size_t index) const {
    glm::dvec3 sum(0);
    for (std::size_t c = 0; c < whites_.size(); ++c)
        if (config::contains(lit, c) && whites_[c] != nullptr) sum += white(c, index);
    return sum;
}

glm::dvec2 LevelSamples::place(std::size_t channel, std::size_t index) const {
    const auto width = static_cast<std::size_t>(black_.sizePixels.x);
    const std::size_t pixel = scan::pixelOfSample(
        view_, static_cast<int>(index % width), static_cast<int>(index / width));
    return glm::dvec2(view_.channels[channel].place[pixel]);
}

const scan::SampledPicture* LevelSamples::levelOf(std::uint64_t lit, glm::vec3 light) const {
    const auto found = std::ranges::find_if(view_.samples, [&](const auto& sample) {
        return sample.pattern.kind == Kind::Level && sample.pattern.lit == lit &&
               sample.pattern.light == light && sample.pattern.step == 0;
    });
    return found == view_.samples.end() ? nullptr : &*found;
}

namespace {

// The noise of the camera in the dark. A camera counts values below zero as zero, so that the mean
// of dark pixels is more than their light.
class DarkNoise {
  public:
    // By the differences of neighbouring samples in the first picture of black. Without such a
    // picture there is no noise.
    explicit DarkNoise(const scan::CameraView& view) {
        if (view.black.rgb.empty()) return;
        for (int colour = 0; colour < 3; ++colour)
            sigma_[colour] = sigmaOf(spreadsOf(view, colour));
    }
    // Subtracts from a picture what the noise adds in the mean of a neighbourhood, as a single
    // sample is noisy itself.
    void leave(Light& light) const {
        const Light means = meansOf(light);
        for (std::size_t i = 0; i < light.rgb.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double mean = double(means.rgb[i][c]);
                if (sigma_[c] > 0)
                    light.rgb[i][c] -=
                        static_cast<float>(mean - sigma_[c] * cutOff(mean / sigma_[c]).light);
            }
    }

  private:
    // The means of the 5 x 5 samples around each, without those that are NaN.
    static Light meansOf(const Light& light) {
        constexpr int kReach = 2;
        Light means = darkness(light.sizePixels);
        for (int y = 0; y < light.sizePixels.y; ++y)
            for (int x = 0; x < light.sizePixels.x; ++x) {
                float count = 0;
                for (int j = std::max(0, y - kReach);
                     j <= std::min(light.sizePixels.y - 1, y + kReach);
                     ++j)
                    for (int i = std::max(0, x - kReach);
                         i <= std::min(light.sizePixels.x - 1, x + kReach);
                         ++i) {
                        const glm::vec3 rgb = light.at(i, j);
                        if (std::isnan(rgb.x + rgb.y + rgb.z)) continue;
                        means.at(x, y) += rgb;
                        ++count;
                    }
                means.at(x, y) /= std::max(1.0F, count);
            }
        return means;
    }
    // The mean of the pixels of a sample, and their squared deviation.
    struct Spread {
        double mean = 0, square = 0;
    };
    static std::vector<Spread> spreadsOf(const scan::CameraView& view, int colour) {
        Light means = darkness(view.sizePixels / view.sampleStep);
        std::vector<Spread> spreads(means.rgb.size());
        const auto width = static_cast<std::size_t>(means.sizePixels.x);
        for (std::size_t i = 0; i < spreads.size(); ++i) {
            const std::size_t pixel =
                scan::pixelOfSample(view, static_cast<int>(i % width), static_cast<int>(i / width));
            const glm::vec3 left = view.black.rgb[pixel - 1], here = view.black.rgb[pixel],
                            right = view.black.rgb[pixel + 1];
            means.rgb[i] = (left + here + right) / 3.0F;
            spreads[i].square = std::pow(double((here - (left + right) / 2.0F)[colour]), 2) / 1.5;
        }
        means = meansOf(means);
        for (std::size_t i = 0; i < spreads.size(); ++i)
            spreads[i].mean = double(means.rgb[i][colour]);
        return spreads;
    }
    // Normal noise of the standard deviation one about a light, cut off below zero: the light of a
    // mean, and its variance.
    struct CutOff {
        double light = 0, variance = 0;
    };
    static CutOff cutOff(double mean) {
        constexpr double kLeast = 0.08,
                         kFar = 5;  // where little is left, and where nothing is cut off
        if (mean > kFar) return {mean, 1};
        const auto density = [](double x) {
            return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
        };
        const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
        double light = mean = std::max(mean, kLeast);
        for (int i = 0; i < 8; ++i)  // Newton
            light -= (light * below(light) + density(light) - mean) / below(light);
        return {light, (light * light + 1) * below(light) + light * density(light) - mean * mean};
    }
    // The noise that has this spread. Values far off, such as edges, are no noise.
    static double sigmaOf(const std::vector<Spread>& spreads) {
        constexpr double kMost = 25;  // variances
        double sigma = 0;
        for (const Spread& spread : spreads) sigma += spread.square;
        sigma = std::sqrt(sigma / std::max<double>(1, double(spreads.size())));
        for (int i = 0; i < 12 && sigma > 0; ++i) {
            double seen = 0, expected = 0;
            for (const Spread& spread : spreads) {
                if (spread.square > kMost * sigma * sigma) continue;
                seen += spread.square;
                expected += cutOff(spread.mean / sigma).variance;
            }
            sigma = expected > 0 ? std::sqrt(seen / expected) : 0;
        }
        return sigma;
    }

    glm::dvec3 sigma_{0};
};

// The correction of a camera's response: a factor for each of its values, by pictures of one wall
// in several exposures (Debevec and Malik 1997).
class CameraCurve {
  public:
    // Without such pictures it changes nothing.
    explicit CameraCurve(const scan::CameraView& view) {
        const LevelSamples levels(view);
        if (!levels.isWhole()) return;
        for (const scan::SampledPicture& picture : view.samples)
            if (picture.pattern.kind == Kind::Level && picture.pattern.step > 0)
                add(picture, levels);
        solve();
    }
    [[nodiscard]] glm::vec3 corrected(glm::vec3 light) const {
        for (int c = 0; c < 3; ++c) light[c] *= static_cast<float>(std::exp(at(double(light[c]))));
        return light;
    }

  private:
    static constexpr Eigen::Index kKnots = 12;
    using Row = Eigen::Matrix<double, kKnots, 1>;

    // Of the knots' values, linear between them over the camera's codes.
    static void put(Row& row, double light, double sign) {
        const double place = srgbFromLinear(std::clamp(light, 0.0, 1.0)) * double{kKnots - 1};
        const auto low = std::min<Eigen::Index>(kKnots - 2, static_cast<Eigen::Index>(place));
        const double t = place - static_cast<double>(low);
        row(low) += sign * (1 - t);
        row(low + 1) += sign * t;
    }
    [[nodiscard]] double at(double light) const {
        Row row = Row::Zero();
        put(row, std::isnan(light) ? 0 : light, 1);
        return row.dot(knots_);
    }
    void add(const scan::SampledPicture& picture, const LevelSamples& levels) {
        constexpr double kLeast = 0.003;  // where codes are too coarse
        for (std::size_t i = 0; i < picture.light.rgb.size(); ++i) {
            const glm::dvec3 full =
                levels.whites(picture.pattern.lit, i) + glm::dvec3(levels.black().rgb[i]);
            const glm::dvec3 less(picture.light.rgb[i]);
            for (int c = 0; c < 3; ++c)
                if (full[c] > less[c] && full[c] < 0.9 && less[c] > kLeast)
                    add(less[c], full[c], less[c] * double(picture.scale));
        }
    }
    // Adds one light in two exposures; `again` is the first one scaled to the second exposure.
    void add(double less, double full, double again) {
        constexpr double kMost = 0.25;  // farther off are tags, and what has moved
        if (std::abs(std::log(full / again)) > kMost) return;
        Row row = Row::Zero();
        put(row, less, 1);
        put(row, full, -1);
        normal_ += row * row.transpose();
        right_ += std::log(full / again) * row;
        ++count_;
    }
    void solve() {
        if (count_ == 0) return;
        const double smooth = 0.02 * static_cast<double>(count_);
        for (Eigen::Index i = 1; i + 1 < kKnots; ++i) {
            Row row = Row::Zero();
            row(i - 1) = row(i + 1) = 1;
            row(i) = -2;
            normal_ += smooth * row * row.transpose();
        }
        normal_(kKnots - 1, kKnots - 1) += static_cast<double>(count_);  // the brightest stays
        knots_ = normal_.ldlt().solve(right_);
    }

    Row knots_ = Row::Zero(), right_ = Row::Zero();
    Eigen::Matrix<double, kKnots, kKnots> normal_ = Eigen::Matrix<double, kKnots, kKnots>::Zero();
    std::size_t count_ = 0;
};

}  // namespace

scan::CameraView linearised(scan::CameraView view) {
    const DarkNoise noise(view);
    for (scan::SampledPicture& picture : view.samples)
        if (isBlack(picture.pattern)) noise.leave(picture.light);
    const CameraCurve curve(view);
    for (scan::SampledPicture& picture : view.samples)
        for (glm::vec3& light : picture.light.rgb) light = picture.scale * curve.corrected(light);
    return view;
}

}  // namespace aquarama::light
