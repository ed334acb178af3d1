// SPDX-License-Identifier: Apache-2.0
#include "capture/report/compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "common/base/units.h"

namespace aquarama::report {

namespace {

// Errors of one command.

constexpr double kShapeGoal = 0.01;  // body lengths: shapes that differ by less agree
constexpr double kLagStep = 0.25;    // ticks: the resolution of the search for the lag

// The transition is the first beat of a command, but at most the first half of it.
int transitionTicksOf(const ScriptCommand& command) {
    return std::min(static_cast<int>(std::lround(command.beatTicks)), command.ticks / 2);
}

// One command in both traces; indices of the traces.
struct Passage {
    const Trace& fish;
    const Trace& replica;
    std::size_t first = 0;  // the point before the command's first tick
    std::size_t last = 0;   // its last tick
    std::size_t transitionEnd = 0;
    double beatTicks = 1;
};

// The pose at a fractional tick, linearly interpolated. Returns a reference into the trace at a
// whole tick, else `mixed`, which it fills: copying every pose would dominate the search for the
// lag.
const capture::NodeVectors& mixedPose(const Trace& trace,
                                      double tick,
                                      capture::NodeVectors& mixed) {
    const auto before = static_cast<std::size_t>(tick);
    const double share = tick - static_cast<double>(before);
    if (share == 0) return trace[before].pose;
    for (std::size_t i = 0; i < mixed.size(); ++i)
        mixed[i] = glm::mix(trace[before].pose[i], trace[before + 1].pose[i], share);
    return mixed;
}

// The mean squared distance of the nodal points, body lengths squared: the fish at a tick against
// the replica `lag` ticks later.
double squaredShapeError(const Passage& passage, std::size_t tick, double lag) {
    const capture::NodeVectors& pose = passage.fish[tick].pose;
    capture::NodeVectors mixed;
    const capture::NodeVectors& other =
        mixedPose(passage.replica, static_cast<double>(tick) + lag, mixed);
    double sum = 0;
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const glm::dvec3 off = pose[i] - other[i];
        sum += glm::dot(off, off);
    }
    return sum / body::kNodalPoints;
}

// Whether a fractional tick lies within the command.
bool has(const Passage& passage, double tick) {
    return tick >= static_cast<double>(passage.first) && tick <= static_cast<double>(passage.last);
}

// Root mean square over the ticks from + 1 to `to`. Ticks at which the lag leaves the command are
// left out; 0 when none remains.
double shapeError(const Passage& passage, std::size_t from, std::size_t to, double lag) {
    double sum = 0;
    int ticks = 0;
    for (std::size_t tick = from + 1; tick <= to; ++tick) {
        if (!has(passage, static_cast<double>(tick) + lag)) continue;
        sum += squaredShapeError(passage, tick, lag);
        ++ticks;
    }
    return std::sqrt(sum / std::max(ticks, 1));
}

// The lag of at most half a beat, either way, at which the shapes agree best after the transition.
// It tries 0, -1, +1, -2, ... steps, so that of equally good lags the smallest wins.
double bestLag(const Passage& passage) {
    // Steps to either side: half a beat.
    const int steps = static_cast<int>(passage.beatTicks / 2 / kLagStep);
    double best = 0;
    double least = shapeError(passage, passage.transitionEnd, passage.last, 0);
    for (int i = 1; i <= 2 * steps; ++i) {
        const double lag = kLagStep * (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
        const double error = shapeError(passage, passage.transitionEnd, passage.last, lag);
        if (error < least) {
            least = error;
            best = lag;
        }
    }
    return best;
}

// The first tick of the command from which on the shapes agree over a beat, at that lag.
std::optional<int> agreementOf(const Passage& passage, double lag) {
    const auto beat = static_cast<std::size_t>(std::ceil(passage.beatTicks));
    for (std::size_t from = passage.first; from + beat <= passage.last; ++from)
        if (shapeError(passage, from, from + beat, lag) <= kShapeGoal)
            return static_cast<int>(from - passage.first);
    return std::nullopt;
}

// `beatBefore` is the length of a beat in ticks before the command: its heading is averaged over
// it.
CommandErrors errorsOf(const ScriptCommand& command, const Passage& passage, double beatBefore) {
    const auto& [fish, replica, first, last, transitionEnd, beat] = passage;
    CommandErrors errors{.command = command, .firstTick = static_cast<int>(first)};
    errors.lagTicks = bestLag(passage);
    errors.shapeTransition = shapeError(passage, first, transitionEnd, 0);
    errors.shapeWithin = shapeError(passage, transitionEnd, last, errors.lagTicks);
    errors.shapeAsPlayed = shapeError(passage, first, last, 0);
    errors.agreesAfterTicks = agreementOf(passage, errors.lagTicks);

    // The path, and the parts of its error along and across the chord of the fish's path.
    const Overlay overlay(fish, replica, first, beatBefore);
    errors.path = pathLength(fish, first, last);
    const double scale = staysInPlace(command.manoeuvre) ? 1 : errors.path;
    errors.pathErrorAtEnd = overlay.distanceAt(last) / scale;
    errors.pathErrorMost = overlay.mostTo(last) / scale;
    const glm::dvec3 chord = fish[last].frame.origin - fish[first].frame.origin;
    const glm::dvec3 off = overlay.at(last) - fish[last].frame.origin;
    const double ahead = glm::dot(off, glm::normalize(chord));
    errors.pathErrorAlong = ahead / scale;
    errors.pathErrorAcross = glm::length(off - ahead * glm::normalize(chord)) / scale;
    errors.turn = wrapped(headingAt(fish, last, beat) - headingAt(fish, first, beatBefore));
    errors.headingError = overlay.headingErrorAt(last, beat);
    errors.replicaWay = overlay.wayTo(last);
    return errors;
}

// The errors from the index `start` to the end of the traces. The beats, in ticks, are those over
// which the headings at the start and at the end are averaged.
OpenLoopErrors openLoopOf(
    const Trace& fish, const Trace& replica, std::size_t start, double firstBeat, double lastBeat) {
    const std::size_t end = fish.size() - 1;
    const Overlay overlay(fish, replica, start, firstBeat);
    return {.path = pathLength(fish, start, end),
            .distanceAtEnd = overlay.distanceAt(end),
            .distanceMost = overlay.mostTo(end),
            .headingAtEnd = overlay.headingErrorAt(end, lastBeat),
            .replicaWay = overlay.wayTo(end)};
}

// Statistics.

// The root mean square of weighted values; 0 of none.
class RootMeanSquare {
  public:
    void add(double value, double weight) {
        sum_ += weight * value * value;
        weight_ += weight;
    }
    [[nodiscard]] double value() const { return weight_ > 0 ? std::sqrt(sum_ / weight_) : 0; }

  private:
    double sum_ = 0;
    double weight_ = 0;
};

// The least of the values such that at least this share of them is not greater; 0 of none.
double quantile(std::vector<double> values, double share) {
    assert(share >= 0);
    assert(share <= 1);
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

// Appends the errors of one command's ticks to the two series.
void addShapes(const Passage& passage, double lag, Comparison& comparison) {
    for (std::size_t tick = passage.first + 1; tick <= passage.last; ++tick) {
        const bool isThere = has(passage, static_cast<double>(tick) + lag);
        comparison.shapeAsPlayed.push_back(std::sqrt(squaredShapeError(passage, tick, 0)));
        comparison.shapeInPhase.push_back(
            std::sqrt(squaredShapeError(passage, tick, isThere ? lag : 0)));
    }
}

// A pose as it is in a frame that only heads as the fish does. The captured path of a turn or curve
// is level: its roll into the bend and its pitch are in the poses.
void level(TracePoint& point) {
    const glm::dmat3 attitude = point.frame.worldFromBody;
    const double heading = std::atan2(-attitude[0].z, attitude[0].x);
    const glm::dmat3 levelled =
        glm::mat3_cast(glm::angleAxis(-heading, glm::dvec3(0, 1, 0))) * attitude;
    for (glm::dvec3& node : point.pose) node = levelled * node;
}

Trace levelInTurns(const Script& script, Trace trace) {
    std::size_t tick = 0;
    for (const ScriptCommand& command : script)
        for (int i = 0; i < command.ticks; ++i) {
            ++tick;  // the first point is before the first command
            if (isTurn(command.manoeuvre) || isCurve(command.manoeuvre)) level(trace[tick]);
        }
    return trace;
}

}  // namespace

Comparison compare(const Script& script, const Traces& traces) {
    const Trace fish = levelInTurns(script, traces.fish);
    const Trace replica = levelInTurns(script, traces.replica);
    const Trace& loose = traces.looseReplica;
    assert(!script.empty());
    assert(fish.size() == static_cast<std::size_t>(script.front().ticks + ticksOf(script)) + 1);
    assert(replica.size() == fish.size());
    assert(loose.size() == fish.size());
    Comparison comparison;
    auto first = static_cast<std::size_t>(script.front().ticks);
    comparison.openLoop =
        openLoopOf(fish, loose, first, script.front().beatTicks, script.back().beatTicks);
    // Command 0 is the run-in; each command begins where the one before ends.
    for (std::size_t i = 1; i < script.size(); ++i) {
        const std::size_t last = first + static_cast<std::size_t>(script[i].ticks);
        const auto transition = static_cast<std::size_t>(transitionTicksOf(script[i]));
        const Passage passage{fish, replica, first, last, first + transition, script[i].beatTicks};
        comparison.commands.push_back(errorsOf(script[i], passage, script[i - 1].beatTicks));
        addShapes(passage, comparison.commands.back().lagTicks, comparison);
        first = last;
    }
    return comparison;
}

Summary summarise(std::span<const CommandErrors> commands) {
    Summary summary{.commands = commands.size()};
    RootMeanSquare within, transition, asPlayed, heading;
    std::vector<double> paths, along, across;
    std::vector<double> agreements;
    // Shapes are weighted by the ticks to which they belong.
    for (const CommandErrors& errors : commands) {
        const int transitionTicks = transitionTicksOf(errors.command);
        within.add(errors.shapeWithin, errors.command.ticks - transitionTicks);
        transition.add(errors.shapeTransition, transitionTicks);
        asPlayed.add(errors.shapeAsPlayed, errors.command.ticks);
        heading.add(errors.headingError, 1);
        paths.push_back(errors.pathErrorAtEnd);
        along.push_back(std::abs(errors.pathErrorAlong));
        across.push_back(errors.pathErrorAcross);
        if (errors.agreesAfterTicks)
            agreements.push_back(*errors.agreesAfterTicks / kTicksPerSecond);
        else
            ++summary.neverAgree;
    }
    summary.shapeWithin = within.value();
    summary.shapeTransition = transition.value();
    summary.shapeAsPlayed = asPlayed.value();
    summary.headingErrorRms = heading.value();
    summary.pathErrorMedian = quantile(paths, 0.5);
    summary.pathErrorNinth = quantile(paths, 0.9);
    summary.pathErrorWorst = quantile(paths, 1);
    summary.pathErrorAlong = quantile(along, 0.5);
    summary.pathErrorAcross = quantile(across, 0.5);
    summary.agreesAfterSeconds = quantile(agreements, 0.5);
    return summary;
}

double headingAt(const Trace& trace, std::size_t tick, double beatTicks) {
    assert(tick < trace.size());
    assert(beatTicks > 0);
    glm::dvec3 sum{};
    // Backwards from the tick; the last summand may be a fraction of a tick.
    double left = beatTicks;
    std::size_t at = tick;
    while (left > 0) {
        sum += std::min(left, 1.0) * trace[at].frame.worldFromBody[0];
        if (at == 0) break;
        --at;
        left -= 1;
    }
    return std::atan2(-sum.z, sum.x);
}

// std::remainder rounds to the nearest whole turn.
double wrapped(double radians) {
    return std::remainder(radians, 2 * std::numbers::pi);
}

double pathLength(const Trace& trace, std::size_t from, std::size_t to) {
    assert(from <= to);
    assert(to < trace.size());
    double length = 0;
    for (std::size_t tick = from; tick < to; ++tick)
        length += glm::distance(trace[tick].frame.origin, trace[tick + 1].frame.origin);
    return length;
}

Overlay::Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks)
    : fish_(fish),
      replica_(replica),
      start_(start),
      turn_(headingAt(fish, start, beatTicks) - headingAt(replica, start, beatTicks)) {}

// A point of the replica in the world of the fish.
glm::dvec3 Overlay::at(std::size_t tick) const {
    assert(tick < replica_.size());
    // Only the heading is corrected, about the vertical: climb and pitch remain errors.
    const glm::dvec3 way = replica_[tick].frame.origin - replica_[start_].frame.origin;
    return fish_[start_].frame.origin + glm::angleAxis(turn_, glm::dvec3(0, 1, 0)) * way;
}

std::vector<glm::dvec3> Overlay::wayTo(std::size_t end) const {
    std::vector<glm::dvec3> way;
    for (std::size_t tick = start_; tick <= end; ++tick) way.push_back(at(tick));
    return way;
}

double Overlay::distanceAt(std::size_t tick) const {
    return glm::distance(fish_[tick].frame.origin, at(tick));
}

double Overlay::mostTo(std::size_t end) const {
    double most = 0;
    for (std::size_t tick = start_; tick <= end; ++tick) most = std::max(most, distanceAt(tick));
    return most;
}

double Overlay::headingErrorAt(std::size_t tick, double beatTicks) const {
    return wrapped(headingAt(replica_, tick, beatTicks) + turn_ -
                   headingAt(fish_, tick, beatTicks));
}

}  // namespace aquarama::report
