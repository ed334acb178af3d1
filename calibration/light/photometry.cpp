// SPDX-License-Identifier: Apache-2.0
#include "calibration/light/photometry.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "calibration/geometry/smooth_fit.h"
#include "calibration/light/level_samples.h"
#include "common/base/picture.h"
#include "common/base/statistics.h"

namespace aquarama::light {

namespace {

constexpr std::size_t kLeastSamples = 200;  // of a channel

// A sample that a channel lights at a known place.
struct Sample {
    std::size_t index = 0;
    glm::dvec2 place{};
};

std::vector<Sample> samplesOf(const LevelSamples& levels, std::size_t channel) {
    std::vector<Sample> samples;
    for (std::size_t index = 0; index < levels.black().rgb.size(); ++index) {
        const glm::dvec2 place = levels.place(channel, index);
        if (!std::isnan(place.x + place.y + luminance(levels.white(channel, index))))
            samples.push_back({index, place});
    }
    return samples;
}

double medianWhite(const LevelSamples& levels,
                   std::size_t channel,
                   const std::vector<Sample>& samples) {
    std::vector<double> whites;
    whites.reserve(samples.size());
    for (const Sample& sample : samples)
        whites.push_back(luminance(levels.white(channel, sample.index)));
    return quantile(std::move(whites), 0.5);
}

// A sample with the known luminance of each channel's white there, with the light that the screen
// reflects on itself.
struct Mixed {
    std::size_t index = 0;
    Eigen::VectorXd whites;
};

// `medians`: of the channels' whites. Nothing where it is not known, or is not on the screen.
std::optional<Mixed> mixedAt(const LevelSamples& levels,
                             const std::vector<double>& medians,
                             std::size_t index) {
    // A channel gives more than this share of its white to the places that it lights, and less by
    // way of the screen. More light at an unknown place is a border, a tag or the crew's tape.
    constexpr double kUnlit = 0.2, kScreen = 0.5;
    Mixed sample{index, Eigen::VectorXd(static_cast<Eigen::Index>(medians.size()))};
    bool isLit = false;
    for (std::size_t c = 0; c < medians.size(); ++c) {
        const double white = luminance(levels.white(c, index));
        const bool isHere = !std::isnan(levels.place(c, index).x);
        if (!(white < kUnlit * medians[c]) && (!isHere || std::isnan(white))) return std::nullopt;
        isLit = isLit || (isHere && white > kScreen * medians[c]);
        sample.whites(static_cast<Eigen::Index>(c)) = white;
    }
    return isLit ? std::optional(std::move(sample)) : std::nullopt;
}

std::vector<Mixed> mixedOf(const LevelSamples& levels, const std::vector<double>& medians) {
    std::vector<Mixed> mixed;
    for (std::size_t index = 0; index < levels.black().rgb.size(); ++index)
        if (!isHeldOut(levels.black().sizePixels, index))
            if (auto sample = mixedAt(levels, medians, index)) mixed.push_back(std::move(*sample));
    return mixed;
}

// The light of each channel (columns) for one unit of its white's luminance, from samples that all
// channels light together: light adds up.
class Unmixing {
  public:
    explicit Unmixing(const std::vector<Mixed>& samples, std::size_t channels)
        : samples_{samples}, channels_{static_cast<Eigen::Index>(channels)} {}

    [[nodiscard]] Eigen::Matrix3Xd of(const std::function<glm::dvec3(std::size_t)>& light) const {
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(channels_, channels_);
        Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(channels_, 3);
        for (const Mixed& sample : samples_) {
            const glm::dvec3 seen = light(sample.index);
            if (std::isnan(seen.x + seen.y + seen.z)) continue;
            normal.selfadjointView<Eigen::Lower>().rankUpdate(sample.whites);
            right += sample.whites * Eigen::RowVector3d(seen.x, seen.y, seen.z);
        }
        return normal.selfadjointView<Eigen::Lower>().ldlt().solve(right).transpose();
    }
    // The number of samples in which a channel's white is separable from the others.
    [[nodiscard]] std::vector<double> apart(const std::vector<double>& medians) const {
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(channels_, channels_);
        for (const Mixed& sample : samples_) normal += sample.whites * sample.whites.transpose();
        const Eigen::MatrixXd inverse = normal.completeOrthogonalDecomposition().pseudoInverse();
        std::vector<double> apart;
        for (Eigen::Index c = 0; c < channels_; ++c)
            apart.push_back(1 /
                            (inverse(c, c) * std::pow(medians[static_cast<std::size_t>(c)], 2)));
        return apart;
    }

  private:
    const std::vector<Mixed>& samples_;
    Eigen::Index channels_;
};

double sentCode(double light) {
    return std::round(255 * srgbFromLinear(light)) / 255;
}

// Light of a channel's own colours at a code of grey.
struct Response {
    double code = 0;
    glm::dvec3 light{};
};

// Extends a response to codes that the camera cannot measure: on logarithms the slope continues to
// change as above, but stays at least one.
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

// A response from codes to light, interpolated on logarithms, where a power is a straight line.
std::vector<float> responseOf(const std::vector<Response>& levels, int colour) {
    constexpr std::size_t kCodes = 257;
    std::vector<glm::dvec2> points;
    points.reserve(levels.size() + 2);
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

glm::dvec3 columnOf(const Eigen::Matrix3Xd& lights, std::size_t channel) {
    const auto column = lights.col(static_cast<Eigen::Index>(channel));
    return {column(0), column(1), column(2)};
}

// The full red, green and blue of each channel, scaled so that their sum is white. Nothing where a
// picture is missing.
std::vector<glm::dmat3> primariesOf(const LevelSamples& levels,
                                    const Unmixing& unmixing,
                                    const std::vector<glm::dvec3>& whites) {
    std::vector<glm::dmat3> primaries(whites.size());
    for (int colour = 0; colour < 3; ++colour) {
        glm::vec3 light(0);
        light[colour] = 1;
        const scan::SampledPicture* picture = levels.level(light);
        if (picture == nullptr) return {};
        const Eigen::Matrix3Xd lights =
            unmixing.of([&](std::size_t index) { return levels.light(*picture, index); });
        for (std::size_t c = 0; c < primaries.size(); ++c)
            primaries[c][colour] = columnOf(lights, c);
    }
    for (std::size_t c = 0; c < primaries.size(); ++c) {
        const glm::dvec3 scale = whites[c] / (primaries[c] * glm::dvec3(1));
        for (int colour = 0; colour < 3; ++colour) primaries[c][colour] *= scale;
    }
    return primaries;
}

// The colour of a channel's white, for one unit of luminance.
glm::dvec3 tintOf(const LevelSamples& levels,
                  std::size_t channel,
                  const std::vector<Sample>& samples) {
    glm::dvec3 sum(0);
    for (const Sample& sample : samples) sum += levels.white(channel, sample.index);
    return sum / luminance(sum);
}

// Whether each colour of a level is clearly brighter than in the level before, and darker than
// white. Otherwise the picture shows another level than it should.
bool rises(glm::dvec3 before, glm::dvec3 light) {
    constexpr double kLeast = 1.03;
    for (int colour = 0; colour < 3; ++colour)
        if (light[colour] <= 0 || light[colour] >= 1 || light[colour] < kLeast * before[colour])
            return false;
    return true;
}

// The light of each channel's own colours at the levels of the scan, rising; nothing where they do
// not rise.
std::vector<std::vector<Response>> levelsOf(const std::vector<ChannelLight>& channels,
                                            const LevelSamples& levels,
                                            const Unmixing& unmixing) {
    std::vector<std::vector<Response>> responses(channels.size());
    for (const scan::SampledPicture* picture : levels.greys()) {
        const Eigen::Matrix3Xd lights =
            unmixing.of([&](std::size_t index) { return levels.light(*picture, index); });
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const glm::dvec3 light = glm::inverse(channels[c].primaries) * columnOf(lights, c);
            if (!rises(responses[c].empty() ? glm::dvec3(0) : responses[c].back().light, light))
                return {};
            responses[c].push_back({sentCode(double(picture->pattern.light.x)), light});
        }
    }
    return responses;
}

// Responses of all channels whose primaries are set. False where levels are missing or do not rise.
bool setResponses(std::vector<ChannelLight>& channels,
                  const LevelSamples& levels,
                  const Unmixing& unmixing) {
    constexpr std::size_t kLeastLevels = 3;
    const auto responses = levelsOf(channels, levels, unmixing);
    if (responses.empty() || responses.front().size() < kLeastLevels) return false;
    for (std::size_t c = 0; c < channels.size(); ++c)
        for (int colour = 0; colour < 3; ++colour)
            channels[c].response.at(static_cast<std::size_t>(colour)) =
                responseOf(responses[c], colour);
    return true;
}

geometry::SmoothField whiteOf(const LevelSamples& levels,
                              std::size_t channel,
                              const std::vector<Sample>& samples,
                              glm::dvec2 size) {
    constexpr int kCellsAcross = 32, kRounds = 3;
    // Shares of the median.
    constexpr double kNoise = 0.01, kFar = 0.03;
    constexpr geometry::Smoothness kSmoothness{.bend = 0.03, .size = 30};
    const double median = medianWhite(levels, channel, samples);
    std::vector<geometry::Measured> measured;
    for (const Sample& sample : samples) {
        const double white = luminance(levels.white(channel, sample.index));
        measured.push_back({sample.place / size, {white / median, 0}, 1 / kNoise});
    }
    const glm::ivec2 cells(kCellsAcross, static_cast<int>(kCellsAcross * size.y / size.x));
    geometry::SmoothField field =
        geometry::smoothFit(std::move(measured), cells, kSmoothness, kFar, kRounds).first;
    for (double& control : field.controls()) control *= median;
    return field;
}

// Terms of the light of the room at a sample. It changes smoothly over the camera's picture, as
// does the transmission of the camera's lens.
constexpr Eigen::Index kRoomTerms = 6;
Eigen::Matrix<double, kRoomTerms, 1> roomTerms(glm::ivec2 size, std::size_t index) {
    const auto width = static_cast<std::size_t>(size.x);
    const glm::dvec2 at = glm::dvec2(index % width, index / width) / glm::dvec2(size) - 0.5;
    return {1, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y};
}

// The blacks as shares of white, fitted together with the unknown light of the room.
void setBlacks(std::vector<ChannelLight>& channels,
               const LevelSamples& levels,
               const std::vector<Mixed>& samples) {
    const auto count = static_cast<Eigen::Index>(channels.size());
    const Eigen::Index terms = count + kRoomTerms;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
    for (const Mixed& sample : samples) {
        const double black = luminance(glm::dvec3(levels.black().rgb[sample.index]));
        if (std::isnan(black)) continue;
        Eigen::VectorXd row(terms);
        row << sample.whites, roomTerms(levels.black().sizePixels, sample.index);
        // Where it is brighter, a camera of few codes counts better.
        const double weight = sample.whites.sum();
        normal += weight * row * row.transpose();
        right += weight * black * row;
    }
    const Eigen::VectorXd solved = normal.completeOrthogonalDecomposition().solve(right);
    for (Eigen::Index c = 0; c < count; ++c)
        channels[static_cast<std::size_t>(c)].black = std::clamp(solved(c), 0.0, 0.1);
}

// Sets all but the whites. False where the pictures are not sufficient.
bool setLight(std::vector<ChannelLight>& channels,
              const LevelSamples& levels,
              const std::vector<std::vector<Sample>>& samples) {
    std::vector<double> medians;
    std::vector<glm::dvec3> tints;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        medians.push_back(medianWhite(levels, c, samples[c]));
        tints.push_back(tintOf(levels, c, samples[c]));
    }
    const std::vector<Mixed> mixed = mixedOf(levels, medians);
    const Unmixing unmixing(mixed, channels.size());
    if (std::ranges::any_of(unmixing.apart(medians),
                            [](double apart) { return !(apart >= kLeastSamples); }))
        return false;
    const std::vector<glm::dmat3> primaries = primariesOf(levels, unmixing, tints);
    if (primaries.empty()) return false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        channels[c].primaries = primaries[c];
        if (!(std::abs(glm::determinant(primaries[c])) > 1e-6)) return false;
    }
    setBlacks(channels, levels, mixed);
    return setResponses(channels, levels, unmixing);
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
    const scan::CameraView view = linearised(std::move(seen));
    const LevelSamples levels(view);
    if (!levels.isWhole()) return std::nullopt;
    std::vector<std::vector<Sample>> samples;
    for (std::size_t c = 0; c < levels.channels(); ++c) {
        samples.push_back(samplesOf(levels, c));
        if (samples.back().size() < kLeastSamples) return std::nullopt;
    }
    std::vector<ChannelLight> channels(levels.channels());
    if (!setLight(channels, levels, samples)) return std::nullopt;
    for (std::size_t c = 0; c < channels.size(); ++c)
        channels[c].white = whiteOf(levels, c, samples[c], rig.channels[c].sizePixels);
    return channels;
}

}  // namespace aquarama::light
