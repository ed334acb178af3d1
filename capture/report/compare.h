// SPDX-License-Identifier: Apache-2.0
// The errors of a replica's trace against the trace of the biomechanical fish under the same
// script.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "capture/report/script.h"

namespace aquarama::report {

// The errors of one command.
//
// The error of the shape is the root mean square distance of the 23 nodal points in the body frame,
// in body lengths; in turns and curves in a level frame of the same heading, since what is captured
// of them is a level path, with roll and pitch in the poses. Both fish begin a command at the same
// phase of the beat. The transition may shift that phase: the lag is the shift in time at which the
// shapes after the transition agree best. The transition is the first beat of the command, or half
// of a short command.
//
// For the error of the path, the replica's path is moved at the start of each command to the fish's
// place and turned to its heading. The heading is the direction of the nose, averaged over the last
// beat, so that the sway of the beat does not count.
struct CommandErrors {
    ScriptCommand command;
    int firstTick = 0;           // index in the traces of the point before the command
    double lagTicks = 0;         // positive: the replica's shapes come too late
    double shapeWithin = 0;      // after the transition, at that lag
    double shapeTransition = 0;  // in the transition, at no lag
    double shapeAsPlayed = 0;    // the whole command, at no lag
    // From the start until the shapes differ by at most 1 % of a body length over a whole beat.
    std::optional<int> agreesAfterTicks{};

    double path = 0;  // length of the fish's own path, body lengths
    // Errors of the path as shares of that length, or of a body length where the command stays in
    // its place: the distance at the end, the greatest distance,
    // and the two parts of the distance at the end. The part along the chord of the fish's path,
    // positive ahead, is mostly an error of speed; the part across it, of heading.
    double pathErrorAtEnd = 0;
    double pathErrorMost = 0;
    double pathErrorAlong = 0;
    double pathErrorAcross = 0;
    double turn = 0;          // of the fish, radians, left positive
    double headingError = 0;  // at the end, the replica's minus the fish's, radians
    // Places of the replica, moved and turned as above, at firstTick and each tick of the command.
    std::vector<glm::dvec3> replicaWay{};
};

// Errors of the uncorrected replica over the whole script: its path is moved and turned once, at
// the end of the run-in.
struct OpenLoopErrors {
    double path = 0;  // length of the fish's path, body lengths
    double distanceAtEnd = 0;
    double distanceMost = 0;
    double headingAtEnd = 0;               // the replica's minus the fish's, radians
    std::vector<glm::dvec3> replicaWay{};  // at each tick from the end of the run-in on
};

// The two series have an element for each tick after the run-in, in body lengths.
struct Comparison {
    std::vector<CommandErrors> commands;  // without the run-in
    std::vector<double> shapeAsPlayed;    // at no lag
    std::vector<double> shapeInPhase;     // at the command's lag; at no lag where that leaves it
    OpenLoopErrors openLoop;
};

// The traces must be those of the script, with its run-in. Costs one shape error for each tick of a
// command and each lag within a beat, in quarters of a tick.
[[nodiscard]] Comparison compare(const Script& script, const Traces& traces);

// Statistics over several commands. Shapes are weighted by ticks; path errors count once for each
// command.
struct Summary {
    std::size_t commands = 0;
    double shapeWithin = 0;  // this and the next two: root mean squares, body lengths
    double shapeTransition = 0;
    double shapeAsPlayed = 0;
    double pathErrorMedian = 0;  // at the end, share of the path
    double pathErrorNinth = 0;   // nine commands of ten have at most this
    double pathErrorWorst = 0;
    double pathErrorAlong = 0;  // medians of the magnitudes
    double pathErrorAcross = 0;
    double headingErrorRms = 0;     // radians
    double agreesAfterSeconds = 0;  // median of the commands whose shapes come to agree
    std::size_t neverAgree = 0;     // commands whose shapes do not
};
// All zero for no commands.
[[nodiscard]] Summary summarise(std::span<const CommandErrors> commands);

// Paths moved and turned so that they begin alike. A tick is an index of a trace.

// The direction of the nose, averaged over the beat that ends at the tick (a fraction of a tick
// counts in proportion, and the trace's start cuts it); radians, left positive.
[[nodiscard]] double headingAt(const Trace& trace, std::size_t tick, double beatTicks);
[[nodiscard]] double wrapped(double radians);  // to -pi .. pi

// Length of the path of the body frame's origin, tick by tick, body lengths; from <= to.
[[nodiscard]] double pathLength(const Trace& trace, std::size_t from, std::size_t to);

// The replica's path, moved and turned so that at the tick `start` it has the fish's place and
// heading. Keeps references: both traces must outlive it.
class Overlay {
  public:
    // `beatTicks`: the length of a beat at `start`, over which headings are averaged.
    Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks);

    [[nodiscard]] glm::dvec3 at(std::size_t tick) const;  // the replica's place
    // at() for each tick from the start to `end`.
    [[nodiscard]] std::vector<glm::dvec3> wayTo(std::size_t end) const;
    [[nodiscard]] double distanceAt(std::size_t tick) const;  // from the fish
    // From the replica's heading to the fish's at the start, radians, left positive.
    [[nodiscard]] double turnRadians() const { return turn_; }
    [[nodiscard]] double mostTo(std::size_t end) const;  // the greatest of those to `end`
    // The replica's heading minus the fish's, radians.
    [[nodiscard]] double headingErrorAt(std::size_t tick, double beatTicks) const;

  private:
    const Trace& fish_;
    const Trace& replica_;
    std::size_t start_;
    double turn_;  // radians, from the replica's heading to the fish's
};

}  // namespace aquarama::report
