// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/compare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/units/ids.h"

namespace aquarama {

namespace {

constexpr double kShapeGoal = 0.01;  // body lengths
constexpr double kLagStep = 0.25;    // ticks

// One command in both traces.
struct Passage {
    const Trace& fish;
    const Trace& replica;
    std::size_t first = 0;  // the tick before its first
    std::size_t last = 0;
    double beatTicks = 1;

    [[nodiscard]] std::size_t transitionEnd() const {
        const auto beat = static_cast<std::size_t>(std::lround(beatTicks));
        return first + std::min(beat, (last - first) / 2);
    }
};

const NodeVectors& mixedPose(const Trace& trace, double tick, NodeVectors& mixed) {
    const auto before = static_cast<std::size_t>(tick);
    const double share = tick - static_cast<double>(before);
    if (share == 0) return trace[before].pose;
    for (std::size_t i = 0; i < mixed.size(); ++i)
        mixed[i] = glm::mix(trace[before].pose[i], trace[before + 1].pose[i], share);
    return mixed;
}

// Mean over the nodal points, body lengths squared.
double squaredShapeError(const Passage& passage, std::size_t tick, double lag) {
    const NodeVectors& pose = passage.fish[tick].pose;
    NodeVectors mixed;
    const NodeVectors& other = mixedPose(passage.replica, static_cast<double>(tick) + lag, mixed);
    double sum = 0;
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const glm::dvec3 off = pose[i] - other[i];
        sum += glm::dot(off, off);
    }
    return sum / kNodalPoints;
}

// Root mean square over the ticks (from, to], as far as the command has them at that lag.
double shapeError(const Passage& passage, std::size_t from, std::size_t to, double lag) {
    const auto most = static_cast<double>(passage.last);
    double sum = 0;
    int ticks = 0;
    for (std::size_t tick = from + 1; tick <= to; ++tick) {
        const double other = static_cast<double>(tick) + lag;
        if (other < static_cast<double>(passage.first) || other > most) continue;
        sum += squaredShapeError(passage, tick, lag);
        ++ticks;
    }
    return std::sqrt(sum / std::max(ticks, 1));
}

// That with which the shapes agree best after the transition; of equally good ones the smallest.
double bestLag(const Passage& passage) {
    const int steps = static_cast<int>(passage.beatTicks / 2 / kLagStep);
    double best = 0;
    double least = shapeError(passage, passage.transitionEnd(), passage.last, 0);
    for (int i = 1; i <= 2 * steps; ++i) {
        const double lag = kLagStep * (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
        const double error = shapeError(passage, passage.transitionEnd(), passage.last, lag);
        if (error < least) {
            least = error;
            best = lag;
        }
    }
    return best;
}

std::optional<int> agreementOf(const Passage& passage, double lag) {
    const auto beat = static_cast<std::size_t>(std::ceil(passage.beatTicks));
    for (std::size_t from = passage.first; from + beat <= passage.last; ++from)
        if (shapeError(passage, from, from + beat, lag) <= kShapeGoal)
            return static_cast<int>(from - passage.first);
    return std::nullopt;
}

// Of the nose, averaged over the beat that ends at the tick; radians, left positive.
double headingAt(const Trace& trace, std::size_t tick, double beatTicks) {
    glm::dvec3 sum{};
    double left = beatTicks;
    for (std::size_t at = tick; left > 0; --at, left -= 1) {
        sum += std::min(left, 1.0) * trace[at].frame.worldFromBody[0];
        if (at == 0) break;
    }
    return std::atan2(-sum.z, sum.x);
}

double wrapped(double radians) {
    return std::remainder(radians, 2 * std::numbers::pi);
}

double pathLength(const Trace& trace, std::size_t from, std::size_t to) {
    double length = 0;
    for (std::size_t tick = from; tick < to; ++tick)
        length += glm::distance(trace[tick].frame.origin, trace[tick + 1].frame.origin);
    return length;
}

// The replica's way laid over the fish's at one tick, by place and heading.
class Overlay {
  public:
    Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks)
        : fish_(fish),
          replica_(replica),
          start_(start),
          turn_(headingAt(fish, start, beatTicks) - headingAt(replica, start, beatTicks)) {}

    [[nodiscard]] double distanceAt(std::size_t tick) const {
        const glm::dvec3 fishWay = fish_[tick].frame.origin - fish_[start_].frame.origin;
        const glm::dvec3 way = replica_[tick].frame.origin - replica_[start_].frame.origin;
        return glm::distance(fishWay, glm::angleAxis(turn_, glm::dvec3(0, 1, 0)) * way);
    }
    [[nodiscard]] double mostUntil(std::size_t end) const {
        double most = 0;
        for (std::size_t tick = start_; tick <= end; ++tick)
            most = std::max(most, distanceAt(tick));
        return most;
    }
    [[nodiscard]] double headingErrorAt(std::size_t tick, double beatTicks) const {
        return wrapped(headingAt(replica_, tick, beatTicks) + turn_ -
                       headingAt(fish_, tick, beatTicks));
    }

  private:
    const Trace& fish_;
    const Trace& replica_;
    std::size_t start_;
    double turn_;
};

CommandErrors errorsOf(const Command& command, const Passage& passage, double beatBefore) {
    const auto& [fish, replica, first, last, beat] = passage;
    CommandErrors errors{.command = command, .firstTick = static_cast<int>(first)};
    errors.lagTicks = bestLag(passage);
    errors.shapeTransition = shapeError(passage, first, passage.transitionEnd(), 0);
    errors.shapeWithin = shapeError(passage, passage.transitionEnd(), last, errors.lagTicks);
    errors.shapeAsPlayed = shapeError(passage, first, last, 0);
    errors.agreesAfterTicks = agreementOf(passage, errors.lagTicks);

    const Overlay overlay(fish, replica, first, beatBefore);
    errors.path = pathLength(fish, first, last);
    errors.pathErrorAtEnd = overlay.distanceAt(last) / errors.path;
    errors.pathErrorMost = overlay.mostUntil(last) / errors.path;
    errors.turn = wrapped(headingAt(fish, last, beat) - headingAt(fish, first, beatBefore));
    errors.headingError = overlay.headingErrorAt(last, beat);
    return errors;
}

OpenLoopErrors openLoopOf(
    const Trace& fish, const Trace& replica, std::size_t start, double firstBeat, double lastBeat) {
    const std::size_t end = fish.size() - 1;
    const Overlay overlay(fish, replica, start, firstBeat);
    return {.path = pathLength(fish, start, end),
            .distanceAtEnd = overlay.distanceAt(end),
            .distanceMost = overlay.mostUntil(end),
            .headingAtEnd = overlay.headingErrorAt(end, lastBeat)};
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

Comparison compare(const Script& script, const Traces& traces) {
    const auto& [fish, replica, loose] = traces;
    Comparison comparison;
    auto first = static_cast<std::size_t>(script.front().ticks);
    comparison.openLoop =
        openLoopOf(fish, loose, first, script.front().beatTicks, script.back().beatTicks);
    for (std::size_t i = 1; i < script.size(); ++i) {
        const std::size_t last = first + static_cast<std::size_t>(script[i].ticks);
        const Passage passage{fish, replica, first, last, script[i].beatTicks};
        comparison.commands.push_back(errorsOf(script[i], passage, script[i - 1].beatTicks));
        for (std::size_t tick = first + 1; tick <= last; ++tick)
            comparison.shape.push_back(std::sqrt(squaredShapeError(passage, tick, 0)));
        first = last;
    }
    return comparison;
}

Summary summarise(std::span<const CommandErrors> commands) {
    Summary summary{.commands = commands.size()};
    double ticks = 0;
    std::vector<double> paths;
    std::vector<double> agreements;
    for (const CommandErrors& errors : commands) {
        const double weight = errors.command.ticks;
        ticks += weight;
        summary.shapeWithin += weight * errors.shapeWithin * errors.shapeWithin;
        summary.shapeTransition += weight * errors.shapeTransition * errors.shapeTransition;
        summary.shapeAsPlayed += weight * errors.shapeAsPlayed * errors.shapeAsPlayed;
        summary.headingErrorRms += errors.headingError * errors.headingError;
        paths.push_back(errors.pathErrorAtEnd);
        summary.pathErrorWorst = std::max(summary.pathErrorWorst, errors.pathErrorAtEnd);
        if (errors.agreesAfterTicks)
            agreements.push_back(*errors.agreesAfterTicks / kTicksPerSecond);
        else
            ++summary.neverAgree;
    }
    for (double* square : {&summary.shapeWithin, &summary.shapeTransition, &summary.shapeAsPlayed})
        *square = std::sqrt(*square / std::max(ticks, 1.0));
    summary.headingErrorRms = std::sqrt(
        summary.headingErrorRms / static_cast<double>(std::max<std::size_t>(paths.size(), 1)));
    summary.pathErrorMedian = median(std::move(paths));
    summary.agreesAfterSeconds = median(std::move(agreements));
    return summary;
}

}  // namespace aquarama
