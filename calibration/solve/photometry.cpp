// SPDX-License-Identifier: Apache-2.0
#include "calibration/solve/photometry.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "calibration/solve/smooth_fit.h"
#include "calibration/solve/statistics.h"
#include "common/base/picture.h"

namespace aquarama::solve {

namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;

constexpr std::ptrdiff_t kLeastSamples = 200;  // where a channel is alone

double luminance(glm::dvec3 rgb) {
    return glm::dot(rgb, {0.2126, 0.7152, 0.0722});
}

// The thinned-out pictures of a view that tell of one channel.
class ChannelSamples {
  public:
    ChannelSamples(const scan::CameraView& view, std::size_t channel)
        : view_{view}, channel_{channel}, black_{levelOf(view, 0, glm::vec3(0))} {
        for (std::size_t c = 0; c < view.channels.size(); ++c)
            whites_.push_back(levelOf(view, std::uint64_t{1} << c, glm::vec3(1)));
    }

    [[nodiscard]] const scan::SampledPicture* level(glm::vec3 light) const {
        const auto found = std::ranges::find_if(view_.samples, [&](const auto& sample) {
            return isLit(sample.pattern) && sample.pattern.kind == Kind::Level &&
                   sample.pattern.light == light;
        });
        return found == view_.samples.end() ? nullptr : &*found;
    }
    [[nodiscard]] bool isWhole() const {
        return black_ != nullptr && whites_[channel_] != nullptr &&
               !view_.channels[channel_].place.empty();
    }
    [[nodiscard]] const Light& black() const { return black_->light; }

    // A sample that the channel lights at a known place, and whether no other lights it much.
    struct Sample {
        std::size_t index = 0;
        glm::dvec2 place{};
        bool isAlone = false;
    };
    [[nodiscard]] std::vector<Sample> all() const {
        std::vector<Sample> samples;
        const glm::ivec2 size = black().sizePixels;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec2 place(
                    view_.channels[channel_].place[scan::pixelOfSample(view_, x, y)]);
                const auto index = static_cast<std::size_t>(y * size.x + x);
                if (!std::isnan(place.x + place.y + luminance(white(index))))
                    samples.push_back({index, place, isAlone(index)});
            }
        return samples;
    }
    // White of the channel alone, without black; not a number where the camera was blinded.
    [[nodiscard]] glm::dvec3 white(std::size_t index) const {
        return without(*whites_[channel_], index);
    }
    // A picture without black; and the whites of all channels that it shows, as those are seen
    // there too, by the light that the screen throws on itself.
    [[nodiscard]] glm::dvec3 light(const scan::SampledPicture& picture, std::size_t index) const {
        return without(picture, index);
    }
    [[nodiscard]] glm::dvec3 whites(std::uint64_t lit, std::size_t index) const {
        glm::dvec3 sum(0);
        for (std::size_t c = 0; c < whites_.size(); ++c)
            if (((lit >> c) & 1U) != 0 && whites_[c] != nullptr) sum += without(*whites_[c], index);
        return sum;
    }

  private:
    [[nodiscard]] bool isAlone(std::size_t index) const {
        constexpr double kBeside = 0.15;  // of its own light: what the screen throws on itself
        const double own = luminance(white(index));
        for (std::size_t c = 0; c < whites_.size(); ++c)
            if (c != channel_ && whites_[c] != nullptr &&
                !(luminance(without(*whites_[c], index)) < kBeside * own))
                return false;
        return true;
    }
    [[nodiscard]] static const scan::SampledPicture* levelOf(const scan::CameraView& view,
                                                             std::uint64_t lit,
                                                             glm::vec3 light) {
        const auto found = std::ranges::find_if(view.samples, [&](const auto& sample) {
            return sample.pattern.kind == Kind::Level && sample.pattern.lit == lit &&
                   sample.pattern.light == light && sample.pattern.step == 0;
        });
        return found == view.samples.end() ? nullptr : &*found;
    }
    [[nodiscard]] bool isLit(const ScanPattern& pattern) const {
        return ((pattern.lit >> channel_) & 1U) != 0;
    }
    [[nodiscard]] glm::dvec3 without(const scan::SampledPicture& picture, std::size_t index) const {
        return glm::dvec3(picture.light.rgb[index]) - glm::dvec3(black().rgb[index]);
    }

    const scan::CameraView& view_;
    std::size_t channel_;
    const scan::SampledPicture* black_;
    std::vector<const scan::SampledPicture*> whites_;
};

using Sample = ChannelSamples::Sample;

// How a camera's light differs from what it is taken for: a factor for each of its values, by
// pictures of one wall in several exposures (Debevec and Malik 1997).
class CameraCurve {
  public:
    // Of a view without such pictures it changes nothing.
    explicit CameraCurve(const scan::CameraView& view) {
        const ChannelSamples any(view, 0);
        if (!any.isWhole()) return;
        for (const scan::SampledPicture& picture : view.samples)
            if (picture.pattern.kind == Kind::Level && picture.pattern.step > 0) add(picture, any);
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
    void add(const scan::SampledPicture& picture, const ChannelSamples& any) {
        constexpr double kLeast = 0.003;  // where codes are too coarse
        for (std::size_t i = 0; i < picture.light.rgb.size(); ++i) {
            const glm::dvec3 full =
                any.whites(picture.pattern.lit, i) + glm::dvec3(any.black().rgb[i]);
            const glm::dvec3 less(picture.light.rgb[i]);
            for (int c = 0; c < 3; ++c)
                if (full[c] > less[c] && full[c] < 0.9 && less[c] > kLeast)
                    add(less[c], full[c], less[c] * double(picture.scale));
        }
    }
    // One light in two exposures; `again` is the first as the second should have it.
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

// The view with its samples corrected, all in the exposure of the first picture.
scan::CameraView corrected(scan::CameraView view) {
    const CameraCurve curve(view);
    for (scan::SampledPicture& picture : view.samples)
        for (glm::vec3& light : picture.light.rgb) light = picture.scale * curve.corrected(light);
    return view;
}

// Light of some samples, and the luminance of white there.
struct Sum {
    glm::dvec3 light{0};
    double white = 0;
    void add(glm::dvec3 more, glm::dvec3 whites) {
        const double luminous = luminance(whites);
        if (std::isnan(luminance(more)) || std::isnan(luminous)) return;
        light += more;
        white += luminous;
    }
    [[nodiscard]] glm::dvec3 share() const { return white > 0 ? light / white : glm::dvec3(0); }
};

Sum sumOf(const scan::SampledPicture& picture,
          const ChannelSamples& channel,
          const std::vector<Sample>& samples) {
    Sum sum;
    for (const Sample& sample : samples)
        if (sample.isAlone)
            sum.add(channel.light(picture, sample.index),
                    channel.whites(picture.pattern.lit, sample.index));
    return sum;
}

// Levels that a scan shows beside the whole of its colours, and the codes they are sent in.
constexpr std::array kLevels{0.005F, 0.025F, 0.18F, 0.5F, 0.8F};

double sentCode(double light) {
    return std::round(255 * srgbFromLinear(light)) / 255;
}

// Light of a channel's own colours at a code of grey.
struct Response {
    double code = 0;
    glm::dvec3 light{};
};

// Codes below those that a camera can measure: along logarithms the slope goes on changing as it
// does above them, but for light that is no steeper than its code.
void addDark(std::vector<glm::dvec2>& points) {
    constexpr int kSteps = 6;
    const double first = (points[1].y - points[0].y) / (points[1].x - points[0].x);
    const double second = (points[2].y - points[1].y) / (points[2].x - points[1].x);
    const double bend = std::max(0.0, 2 * (second - first) / (points[2].x - points[0].x));
    const double middle = (points[0].x + points[1].x) / 2;
    for (int i = 0; i < kSteps; ++i) {
        const double step = std::log(2.0) / 2, x = points.front().x - step;
        const double slope = std::max(std::min(1.0, first), first + bend * (x + step / 2 - middle));
        points.insert(points.begin(), {x, points.front().y - slope * step});
    }
}

// From codes to light; between what is measured along logarithms, where a power is a straight line.
std::vector<float> responseOf(const std::vector<Response>& levels, int colour) {
    constexpr std::size_t kCodes = 257;
    std::vector<glm::dvec2> points;
    for (const Response& level : levels)
        points.emplace_back(std::log(level.code), std::log(level.light[colour]));
    addDark(points);
    points.emplace_back(0, 0);
    std::vector<double> codes;
    for (std::size_t i = 1; i < kCodes; ++i)
        codes.push_back(std::log(static_cast<double>(i) / double{kCodes - 1}));
    std::vector<float> response{0};
    for (const double light : risingCurve(points, codes))
        response.push_back(static_cast<float>(std::exp(light)));
    response.back() = 1;
    return response;
}

// White of what a picture shows, where the channel is alone.
glm::dvec3 whiteBeside(const scan::SampledPicture& picture,
                       const ChannelSamples& channel,
                       const std::vector<Sample>& samples) {
    Sum sum;
    for (const Sample& sample : samples) {
        const glm::dvec3 whites = channel.whites(picture.pattern.lit, sample.index);
        if (sample.isAlone) sum.add(whites, whites);
    }
    return sum.share();
}

// Full red, green and blue, scaled so that their sum is white.
std::optional<glm::dmat3> primariesOf(const ChannelSamples& channel,
                                      const std::vector<Sample>& samples) {
    glm::dmat3 own(0.0);
    glm::dvec3 white(0);
    for (int colour = 0; colour < 3; ++colour) {
        glm::vec3 light(0);
        light[colour] = 1;
        const scan::SampledPicture* picture = channel.level(light);
        if (picture == nullptr) return std::nullopt;
        own[colour] = sumOf(*picture, channel, samples).share();
        white = whiteBeside(*picture, channel, samples);
    }
    const glm::dvec3 scale = white / (own * glm::dvec3(1));
    for (int colour = 0; colour < 3; ++colour) own[colour] *= scale;
    return own / luminance(white);
}

// Whether each colour of a level is clearly brighter than that of the one before, and darker than
// white: not where a picture shows another level than it should.
bool rises(glm::dvec3 before, glm::dvec3 light) {
    constexpr double kLeast = 1.2;
    for (int colour = 0; colour < 3; ++colour)
        if (light[colour] <= 0 || light[colour] >= 1 || light[colour] < kLeast * before[colour])
            return false;
    return true;
}

bool setColours(ChannelLight& light,
                const ChannelSamples& channel,
                const std::vector<Sample>& samples) {
    const auto primaries = primariesOf(channel, samples);
    if (!primaries) return false;
    light.primaries = *primaries;
    if (!(std::abs(glm::determinant(light.primaries)) > 1e-6)) return false;
    const glm::dmat3 fromCamera = glm::inverse(light.primaries);
    std::vector<Response> levels;
    for (const float level : kLevels) {
        const scan::SampledPicture* picture = channel.level(glm::vec3(level));
        if (picture == nullptr) return false;
        const glm::dvec3 before = levels.empty() ? glm::dvec3(0) : levels.back().light;
        levels.push_back(
            {sentCode(double(level)), fromCamera * sumOf(*picture, channel, samples).share()});
        if (!rises(before, levels.back().light)) return false;
    }
    for (int colour = 0; colour < 3; ++colour)
        light.response.at(static_cast<std::size_t>(colour)) = responseOf(levels, colour);
    return true;
}

SmoothField whiteOf(const ChannelSamples& channel,
                    const std::vector<Sample>& samples,
                    glm::dvec2 size) {
    constexpr int kCellsAcross = 32, kRounds = 3;
    // Shares of the median.
    constexpr double kNoise = 0.01, kFar = 0.03;
    constexpr Smoothness kSmoothness{.bend = 0.03, .size = 30};
    std::vector<double> lights;
    for (const Sample& sample : samples) lights.push_back(luminance(channel.white(sample.index)));
    const double median = quantile(lights, 0.5);
    std::vector<Measured> measured;
    for (std::size_t i = 0; i < samples.size(); ++i)
        measured.push_back({samples[i].place / size, {lights[i] / median, 0}, 1 / kNoise});
    const glm::ivec2 cells(kCellsAcross, static_cast<int>(kCellsAcross * size.y / size.x));
    SmoothField field = smoothFit(std::move(measured), cells, kSmoothness, kFar, kRounds).first;
    for (double& control : field.controls()) control *= median;
    return field;
}

// What the picture of black has at a pixel, and the whites of the channels that light it.
struct BlackSample {
    double black = 0;
    std::vector<double> whites;
};

// Blacks as shares of white, with the light of the room as one more unknown, by least squares.
void setBlacks(std::vector<ChannelLight>& channels, const std::vector<BlackSample>& samples) {
    const auto count = static_cast<Eigen::Index>(channels.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count + 1, count + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count + 1);
    for (const BlackSample& sample : samples) {
        Eigen::VectorXd row(count + 1);
        for (Eigen::Index c = 0; c < count; ++c)
            row(c) = sample.whites[static_cast<std::size_t>(c)];
        row(count) = 1;
        normal += row * row.transpose();
        right += sample.black * row;
    }
    const Eigen::VectorXd solved = normal.completeOrthogonalDecomposition().solve(right);
    for (Eigen::Index c = 0; c < count; ++c)
        channels[static_cast<std::size_t>(c)].black = std::clamp(solved(c), 0.0, 0.1);
}

// A pixel of the camera, where every channel that lights it is understood.
std::optional<BlackSample> blackSampleAt(const config::Rig& rig,
                                         const scan::CameraView& view,
                                         const std::vector<ChannelLight>& channels,
                                         std::size_t pixel) {
    // Of its white a channel gives more than this to all that it lights, and less by way of the
    // screen.
    constexpr double kUnlit = 0.2;
    BlackSample sample;
    bool isLit = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const glm::dvec2 place(view.channels[c].place[pixel]);
        const bool isHere = !std::isnan(place.x + place.y);
        const double middle = channels[c].white.at({0.5, 0.5});
        if (!isHere && double(view.channels[c].light[pixel]) > kUnlit * middle) return std::nullopt;
        isLit = isLit || isHere;
        const glm::dvec2 size(rig.channels[c].sizePixels);
        sample.whites.push_back(isHere ? channels[c].white.at(place / size) : 0);
    }
    return isLit ? std::optional(std::move(sample)) : std::nullopt;
}

std::vector<BlackSample> blackSamples(const config::Rig& rig,
                                      const scan::CameraView& view,
                                      const std::vector<ChannelLight>& channels) {
    const ChannelSamples any(view, 0);
    const Light& black = any.black();
    std::vector<BlackSample> samples;
    for (int y = 0; y < black.sizePixels.y; ++y)
        for (int x = 0; x < black.sizePixels.x; ++x) {
            auto sample = blackSampleAt(rig, view, channels, scan::pixelOfSample(view, x, y));
            if (!sample || std::isnan(black.at(x, y).x)) continue;
            sample->black = luminance(glm::dvec3(black.at(x, y)));
            samples.push_back(std::move(*sample));
        }
    return samples;
}

}  // namespace

namespace {

// Slopes of a curve through points: those of parabolas through three, and no steeper than what
// keeps the curve rising.
std::vector<double> slopesOf(const std::vector<glm::dvec2>& points) {
    const std::size_t last = points.size() - 1;
    std::vector<double> chord(last), slope(points.size());
    for (std::size_t i = 0; i < last; ++i)
        chord[i] = (points[i + 1].y - points[i].y) / (points[i + 1].x - points[i].x);
    slope.front() = chord.front();
    slope.back() = chord.back();
    for (std::size_t i = 1; i < last; ++i) {
        const double before = points[i].x - points[i - 1].x, behind = points[i + 1].x - points[i].x;
        slope[i] = (before * chord[i] + behind * chord[i - 1]) / (before + behind);
        slope[i] = std::min(slope[i], 3 * std::min(chord[i - 1], chord[i]));
    }
    if (last < 2) return slope;
    slope.front() = std::clamp(2 * chord.front() - slope[1], 0.0, 3 * chord.front());
    slope.back() = std::clamp(2 * chord.back() - slope[last - 1], 0.0, 3 * chord.back());
    return slope;
}

}  // namespace

std::vector<double> risingCurve(const std::vector<glm::dvec2>& points,
                                const std::vector<double>& at) {
    assert(points.size() >= 2);
    const std::vector<double> slope = slopesOf(points);
    std::vector<double> curve;
    std::size_t i = 0;
    for (const double x : at) {
        while (i + 2 < points.size() && x > points[i + 1].x) ++i;
        const double width = points[i + 1].x - points[i].x, t = (x - points[i].x) / width;
        const double s = 1 - t;
        curve.push_back(t < 0 ? points[i].y + slope[i] * (x - points[i].x)
                              : points[i].y * s * s * (1 + 2 * t) +
                                    points[i + 1].y * t * t * (1 + 2 * s) +
                                    width * t * s * (slope[i] * s - slope[i + 1] * t));
    }
    return curve;
}

std::optional<std::vector<ChannelLight>> measureLight(const config::Rig& rig,
                                                      scan::CameraView seen) {
    const scan::CameraView view = corrected(std::move(seen));
    std::vector<ChannelLight> channels(rig.channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const ChannelSamples channel(view, c);
        if (!channel.isWhole()) return std::nullopt;
        const std::vector<Sample> samples = channel.all();
        const auto alone = std::ranges::count_if(samples, &Sample::isAlone);
        if (alone < kLeastSamples || !setColours(channels[c], channel, samples))
            return std::nullopt;
        channels[c].white = whiteOf(channel, samples, rig.channels[c].sizePixels);
    }
    setBlacks(channels, blackSamples(rig, view, channels));
    return channels;
}

}  // namespace aquarama::solve
