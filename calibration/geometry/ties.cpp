// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/picture.h"
#include "common/base/statistics.h"

namespace aquarama::geometry {

namespace {

// A square of the camera's picture.
struct Window {
    glm::ivec2 corner{};
    int side = 0;
    [[nodiscard]] glm::dvec2 centre() const { return glm::dvec2(corner) + 0.5 * side; }
};

// One pixel of a window: its offset from the centre, and the place of the channel seen there.
struct Seen {
    glm::dvec2 at, place;
    double sigma;
};

std::vector<Seen> seenIn(const scan::ChannelView& view, glm::ivec2 size, const Window& window) {
    std::vector<Seen> seen;
    for (int y = window.corner.y; y < window.corner.y + window.side; ++y)
        for (int x = window.corner.x; x < window.corner.x + window.side; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                           static_cast<std::size_t>(x);
            if (std::isnan(view.place[i].x)) continue;
            seen.push_back({glm::dvec2(x + 0.5, y + 0.5) - window.centre(),
                            view.place[i],
                            static_cast<double>(0.5F * (view.sigma[i].x + view.sigma[i].y))});
        }
    return seen;
}

// The fit of a surface of second degree to the places of a window.
struct Fit {
    glm::dvec2 centre{};
    double residual = 0;  // root of the mean square of both coordinates
};

Fit fitted(const std::vector<Seen>& seen, double scale) {
    Eigen::Matrix<double, Eigen::Dynamic, 6> terms(static_cast<Eigen::Index>(seen.size()), 6);
    Eigen::Matrix<double, Eigen::Dynamic, 2> places(static_cast<Eigen::Index>(seen.size()), 2);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const glm::dvec2 at = seen[i].at / scale;
        const auto row = static_cast<Eigen::Index>(i);
        terms.row(row) << 1, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y;
        places.row(row) << seen[i].place.x, seen[i].place.y;
    }
    const Eigen::Matrix<double, 6, 6> normal = terms.transpose() * terms;
    const Eigen::Matrix<double, 6, 2> factors = normal.ldlt().solve(terms.transpose() * places);
    const double square = (terms * factors - places).squaredNorm();
    return {{factors(0, 0), factors(0, 1)},
            std::sqrt(square / (2.0 * static_cast<double>(seen.size())))};
}

// Drops places far from the median of the window, where a first fit has large residuals.
std::vector<Seen> withoutOutliers(const std::vector<Seen>& seen, double scale, const Fit& first) {
    if (first.residual < 0.3) return seen;
    const auto middle = [&](auto get) {
        std::vector<double> values;
        for (const Seen& one : seen) values.push_back(get(one));
        return median(values);
    };
    const glm::dvec2 median(middle([](const Seen& one) { return one.place.x; }),
                            middle([](const Seen& one) { return one.place.y; }));
    std::vector<Seen> kept;
    for (const Seen& one : seen)
        if (glm::distance(one.place, median) < 4 * scale) kept.push_back(one);
    return kept;
}

std::optional<Tie> tieIn(const scan::ChannelView& view, glm::ivec2 size, const Window& window) {
    constexpr double kLeastShare = 0.7;    // of the window
    constexpr double kMostResidual = 0.6;  // pixels: more is an edge, not a surface
    const double scale = 0.5 * window.side;
    std::vector<Seen> seen = seenIn(view, size, window);
    const auto isEnough = [&] {
        return static_cast<double>(seen.size()) >= kLeastShare * window.side * window.side;
    };
    if (!isEnough()) return std::nullopt;
    Fit fit = fitted(seen, scale);
    seen = withoutOutliers(seen, scale, fit);
    if (!isEnough()) return std::nullopt;
    fit = fitted(seen, scale);
    if (fit.residual > kMostResidual) return std::nullopt;
    // The value at the centre of such a surface is as exact as the mean of a third of its pixels.
    const double sigma = std::sqrt(3.0 / static_cast<double>(seen.size())) *
                         std::max(fit.residual, seen.front().sigma);
    return Tie{.seen = window.centre(), .place = fit.centre, .sigma = sigma};
}

// The number of pixels where any channel is seen.
double seenPixels(const scan::CameraView& view) {
    double count = 0;
    const auto pixels =
        static_cast<std::size_t>(view.sizePixels.x) * static_cast<std::size_t>(view.sizePixels.y);
    for (std::size_t i = 0; i < pixels; ++i)
        count += std::ranges::any_of(view.channels, [i](const scan::ChannelView& channel) {
            return !channel.place.empty() && !std::isnan(channel.place[i].x);
        });
    return count;
}

}  // namespace

std::vector<Tie> tiesOf(const scan::CameraView& view, std::uint32_t camera, std::size_t most) {
    constexpr int kHeldOutOf = 5;
    const int side =
        std::max(4, static_cast<int>(std::sqrt(seenPixels(view) / static_cast<double>(most))));
    const glm::ivec2 windows = view.sizePixels / side;
    std::vector<Tie> ties;
    for (int row = 0; row < windows.y; ++row)
        for (int column = 0; column < windows.x; ++column)
            for (std::uint32_t channel = 0; channel < view.channels.size(); ++channel) {
                if (view.channels[channel].place.empty()) continue;
                auto tie = tieIn(view.channels[channel],
                                 view.sizePixels,
                                 {glm::ivec2(column, row) * side, side});
                if (!tie) continue;
                tie->camera = camera;
                tie->channel = channel;
                tie->heldOut = (column + 2 * row) % kHeldOutOf == 0;
                tie->window = static_cast<std::uint32_t>(row * windows.x + column);
                ties.push_back(*tie);
            }
    return ties;
}

namespace {

// Light along a line through a place: samples in steps; the first is `from` steps from the place.
struct LightProfile {
    std::vector<double> light;
    long from = 0;
};
constexpr double kProfileStep = 0.5;  // pixels

// The profile of the part of the line that lies in the picture.
LightProfile profileAlong(const Light& room, glm::dvec2 at, glm::dvec2 outwards, double reach) {
    const glm::dvec2 size(room.sizePixels);
    const auto steps = static_cast<long>(reach / kProfileStep);
    LightProfile profile;
    for (long i = -steps; i <= steps; ++i) {
        const glm::dvec2 place = at + outwards * (kProfileStep * static_cast<double>(i));
        const bool isInside =
            place.x >= 0 && place.y >= 0 && place.x <= size.x && place.y <= size.y;
        if (!isInside && profile.light.empty()) continue;
        if (!isInside) break;
        if (profile.light.empty()) profile.from = i;
        profile.light.push_back(luminance(glm::dvec3(bilinear(room, place))));
    }
    return profile;
}

// The index, between samples, where a profile falls most steeply; nothing where it falls too
// little.
std::optional<double> steepest(const std::vector<double>& light) {
    constexpr long kHalf = 3;               // samples that a side of an edge is averaged over
    constexpr double kLeastContrast = 0.3;  // of the light inside
    const auto samples = static_cast<long>(light.size());
    const auto at = [&](long i) { return light[static_cast<std::size_t>(i)]; };
    std::vector<double> fall(light.size(), 0.0);
    for (long i = kHalf; i < samples - kHalf; ++i)
        for (long k = 1; k <= kHalf; ++k)
            fall[static_cast<std::size_t>(i)] += at(i - k) - at(i + k);
    const auto best = std::ranges::max_element(fall);
    const long index = best - fall.begin();
    if (index <= kHalf || index >= samples - kHalf - 1) return std::nullopt;
    const double inside = at(std::max(0L, index - 2 * kHalf));
    if (inside <= 0 || *best < kLeastContrast * static_cast<double>(kHalf) * inside)
        return std::nullopt;
    // The top of the parabola through three samples.
    const double before = *(best - 1), after = *(best + 1);
    const double bend = before - 2 * *best + after;
    return static_cast<double>(index) + (bend < 0 ? 0.5 * (before - after) / bend : 0);
}

// The distance from `at`, along a line, of the steepest fall of light from inside to outside;
// pixels.
std::optional<double> edgeAlong(const Light& room,
                                glm::dvec2 at,
                                glm::dvec2 outwards,
                                double reach) {
    const LightProfile profile = profileAlong(room, at, outwards, reach + 4 * kProfileStep);
    const auto index = steepest(profile.light);
    if (!index) return std::nullopt;
    return kProfileStep * (*index + static_cast<double>(profile.from));
}

// A point of the outline in the camera's picture.
struct OutlinePoint {
    glm::dvec3 base;
    glm::dvec2 seen;
};

std::optional<glm::dvec2> seenBy(const LensParameters& lens,
                                 const PoseParameters& pose,
                                 glm::dvec3 point) {
    const Three<double> there{point.x, point.y, point.z};
    if (inFrame(pose.data(), there)[2] <= 0) return std::nullopt;
    const Two<double> seen = pixelOf(lens.data(), pose.data(), there);
    return glm::dvec2(seen[0], seen[1]);
}

// The direction of the outline at one of its points, from its nearest neighbour that is not too
// near.
glm::dvec2 alongOutline(const std::vector<OutlinePoint>& outline, const OutlinePoint& at) {
    constexpr double kNearest = 1.5;  // pixels
    double least = std::numeric_limits<double>::infinity();
    glm::dvec2 way(1, 0);
    for (const OutlinePoint& other : outline) {
        const double distance = glm::distance(other.seen, at.seen);
        if (distance < kNearest || distance >= least) continue;
        least = distance;
        way = (other.seen - at.seen) / distance;
    }
    return way;
}

// The part of the outline that is before the camera.
std::vector<OutlinePoint> predictedOutline(const BumpyScreen& screen,
                                           const LensParameters& lens,
                                           const PoseParameters& pose) {
    std::vector<OutlinePoint> outline;
    for (const glm::dvec3& base : screen.screen().border(0))
        if (const auto seen = seenBy(lens, pose, screen.at(screen.screen().unrolled(base)).point))
            outline.push_back({base, *seen});
    return outline;
}

// The direction across the outline, which runs `along` there, out of the screen.
glm::dvec2 outwards(glm::dvec2 along, glm::dvec2 fromInside) {
    const glm::dvec2 across(-along.y, along.x);
    return glm::dot(across, fromInside) < 0 ? -across : across;
}

}  // namespace

std::vector<OutlineTie> outlineTies(const Light& room,
                                    std::uint32_t camera,
                                    const BumpyScreen& screen,
                                    const LensParameters& lens,
                                    const PoseParameters& pose,
                                    double reach) {
    std::vector<OutlineTie> ties;
    if (room.rgb.empty()) return ties;
    const std::vector<OutlinePoint> outline = predictedOutline(screen, lens, pose);
    constexpr std::size_t kTies = 1000;
    // Odd, since the points of two edges may alternate.
    const std::size_t step = (outline.size() / kTies) | 1U;
    for (std::size_t i = 0; i < outline.size(); i += step) {
        const OutlinePoint& point = outline[i];
        const glm::dvec2 unrolled = screen.screen().unrolled(point.base);
        const auto inside =
            seenBy(lens, pose, screen.at(glm::mix(unrolled, glm::dvec2(0.5), 0.02)).point);
        if (!inside) continue;
        const glm::dvec2 across = outwards(alongOutline(outline, point), point.seen - *inside);
        const auto off = edgeAlong(room, point.seen, across, reach);
        if (!off) continue;
        ties.push_back({.camera = camera,
                        .unrolled = unrolled,
                        .base = point.base,
                        .baseNormal = glm::normalize(screen.screen().normalAt(point.base)),
                        .seen = point.seen + *off * across,
                        .across = across});
    }
    return ties;
}

namespace {

// The light across a strip of tape, in steps to both sides of its expected place.
constexpr double kMarkStepMetres = 0.002;
constexpr int kMarkReach = 150;  // steps
using MarkProfile = std::array<double, 2 * kMarkReach + 1>;

// The places of a camera's picture near a mark, on the tangent plane of the screen there.
class SeenMark {
  public:
    SeenMark(const BumpyScreen& screen,
             const LensParameters& lens,
             const PoseParameters& pose,
             const wall::MarkPlace& place)
        : screen_{screen}, lens_{lens}, pose_{pose}, place_{place} {}
    [[nodiscard]] std::optional<glm::dvec2> at(double inwards, double along) const {
        const glm::dvec3 base = place_.at(inwards, along);
        return seenBy(lens_, pose_, screen_.at(screen_.screen().unrolled(base)).point);
    }
    // The mean profile of a few lines; nothing where one of them leaves the picture.
    [[nodiscard]] std::optional<MarkProfile> profile(const Light& room) const {
        constexpr std::array kLines{0.3, 0.4, 0.5, 0.6, 0.7};  // shares of the strip's length
        MarkProfile light{};
        for (int i = -kMarkReach; i <= kMarkReach; ++i)
            for (const double line : kLines) {
                const auto seen = at(line * wall::kMarkLengthMetres, i * kMarkStepMetres);
                if (!seen || seen->x < 0 || seen->y < 0 || seen->x > room.sizePixels.x ||
                    seen->y > room.sizePixels.y)
                    return std::nullopt;
                light.at(static_cast<std::size_t>(i + kMarkReach)) +=
                    luminance(glm::dvec3(bilinear(room, *seen))) / kLines.size();
            }
        return light;
    }

  private:
    const BumpyScreen& screen_;
    const LensParameters& lens_;
    const PoseParameters& pose_;
    const wall::MarkPlace& place_;
};

// The step where a profile first crosses a level, from a given step in a direction; nothing where
// it does not.
std::optional<double> crossing(const MarkProfile& light, int from, int direction, double level) {
    for (int i = from; i > 0 && i + 1 < static_cast<int>(light.size()); i += direction) {
        const double here = light.at(static_cast<std::size_t>(i)),
                     next = light.at(static_cast<std::size_t>(i + direction));
        if (next < level) continue;
        return i + direction * (level - here) / (next - here);
    }
    return std::nullopt;
}

// The place of a dark strip as wide as tape, in metres from the middle of the profile.
std::optional<double> stripIn(const MarkProfile& light) {
    constexpr double kMostLight = 0.5;                     // of what is beside it
    constexpr double kLeastWidth = 0.6, kMostWidth = 1.5;  // of the tape's
    MarkProfile values = light;
    const double white = median(values);
    const auto darkest = std::ranges::min_element(light);
    if (white <= 0 || *darkest > kMostLight * white) return std::nullopt;
    const double level = (white + *darkest) / 2;
    const auto index = static_cast<int>(darkest - light.begin());
    const auto left = crossing(light, index, -1, level), right = crossing(light, index, 1, level);
    if (!left || !right) return std::nullopt;
    const double width = (*right - *left) * kMarkStepMetres / wall::kMarkWidthMetres;
    if (width < kLeastWidth || width > kMostWidth) return std::nullopt;
    return ((*left + *right) / 2 - kMarkReach) * kMarkStepMetres;
}

}  // namespace

std::vector<MarkTie> markTies(const Light& room,
                              std::uint32_t camera,
                              config::ScreenShape shape,
                              const BumpyScreen& screen,
                              const LensParameters& lens,
                              const PoseParameters& pose) {
    constexpr double kStuckMetres = 0.001;
    constexpr double kInwards = wall::kMarkLengthMetres / 2;
    std::vector<MarkTie> ties;
    if (room.rgb.empty()) return ties;
    for (const wall::MarkPlace& place : wall::markPlaces(shape, screen.screen())) {
        const SeenMark mark(screen, lens, pose, place);
        const auto profile = mark.profile(room);
        const auto off = profile ? stripIn(*profile) : std::nullopt;
        if (!off) continue;
        const auto seen = mark.at(kInwards, *off), beside = mark.at(kInwards, *off + kStuckMetres);
        if (!seen || !beside) continue;
        const glm::dvec2 unrolled = screen.screen().unrolled(place.at(kInwards, 0));
        const auto base = screen.screen().at(unrolled);
        if (!base) continue;
        ties.push_back({{.camera = camera,
                         .unrolled = unrolled,
                         .base = *base,
                         .baseNormal = glm::normalize(screen.screen().normalAt(*base)),
                         .seen = *seen,
                         .across = glm::normalize(*beside - *seen)},
                        glm::distance(*seen, *beside)});
    }
    return ties;
}

}  // namespace aquarama::geometry
