// SPDX-License-Identifier: Apache-2.0
// How far a replica's trace is from that of the fish that it stands for.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "master/capture/report/script.h"

namespace aquarama::report {

// Shape is what the 23 nodal points do in the body frame; its error is their root mean square
// distance, in body lengths. Both begin a command at the same phase of the beat; what a transition
// makes of that phase is given as a lag, that with which the shapes after it agree best.
//
// Paths are laid over each other at the start of each command: at the body frame's origin, and at
// the heading, which is that of the nose averaged over the last beat, so that the beat's sway is
// not taken for it.
struct CommandErrors {
    ScriptCommand command;
    int firstTick = 0;
    double lagTicks = 0;                    // positive: the replica's shapes come too late
    double shapeWithin = 0;                 // after the transition, at that lag
    double shapeTransition = 0;             // the first beat, at that lag
    double shapeAsPlayed = 0;               // the whole command, at no lag
    std::optional<int> agreesAfterTicks{};  // the shapes, within 1 % of a body length over a beat

    double path = 0;            // length of the fish's own way, body lengths
    double pathErrorAtEnd = 0;  // shares of that
    double pathErrorMost = 0;
    double pathErrorAlong = 0;   // what of it lies along the fish's way, positive: ahead; by speed
    double pathErrorAcross = 0;  // and the rest: by heading
    double turn = 0;             // of the fish, radians, left positive
    double headingError = 0;     // at the end, of the replica against the fish, radians
    std::vector<glm::dvec3> replicaWay{};  // laid over the fish's: at firstTick and each tick after
};

// From the start of the script on, never laid over each other again.
struct OpenLoopErrors {
    double path = 0;  // body lengths
    double distanceAtEnd = 0;
    double distanceMost = 0;
    double headingAtEnd = 0;               // radians
    std::vector<glm::dvec3> replicaWay{};  // from the end of the run-in on
};

struct Comparison {
    std::vector<CommandErrors> commands;  // without the run-in
    std::vector<double> shapeAsPlayed;    // at each tick of them, at no lag
    std::vector<double> shapeInPhase;     // at the command's lag, and where it has none, that
    OpenLoopErrors openLoop;
};

[[nodiscard]] Comparison compare(const Script& script, const Traces& traces);

// Over some commands: shapes by the ticks that they took, a path error for each command.
struct Summary {
    std::size_t commands = 0;
    double shapeWithin = 0;  // root mean squares
    double shapeTransition = 0;
    double shapeAsPlayed = 0;
    double pathErrorMedian = 0;  // at the end, share of the path
    double pathErrorNinth = 0;   // nine of ten are within it
    double pathErrorWorst = 0;
    double pathErrorAlong = 0;  // medians of the magnitudes
    double pathErrorAcross = 0;
    double headingErrorRms = 0;     // radians
    double agreesAfterSeconds = 0;  // median, of those that come to agree
    std::size_t neverAgree = 0;
};
[[nodiscard]] Summary summarise(std::span<const CommandErrors> commands);

// Two ways laid over each other where they begin.

// Of the nose, averaged over the beat that ends at the tick; radians, left positive.
[[nodiscard]] double headingAt(const Trace& trace, std::size_t tick, double beatTicks);
[[nodiscard]] double wrapped(double radians);  // to -pi .. pi

// Of the body frame's origin, body lengths.
[[nodiscard]] double pathLength(const Trace& trace, std::size_t from, std::size_t to);

// The replica's way laid over the fish's at one tick, by place and heading. Both are kept by
// reference.
class Overlay {
  public:
    Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks);

    [[nodiscard]] glm::dvec3 at(std::size_t tick) const;  // the replica's place
    [[nodiscard]] std::vector<glm::dvec3> wayTo(std::size_t end) const;
    [[nodiscard]] double distanceAt(std::size_t tick) const;
    [[nodiscard]] double mostTo(std::size_t end) const;  // of the distances from the start on
    // Of the replica against the fish, radians.
    [[nodiscard]] double headingErrorAt(std::size_t tick, double beatTicks) const;

  private:
    const Trace& fish_;
    const Trace& replica_;
    std::size_t start_;
    double turn_;  // radians, from the replica's heading to the fish's
};

}  // namespace aquarama::report
