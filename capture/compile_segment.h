// SPDX-License-Identifier: Apache-2.0
// From a recording of the simulation to an action segment of a repertoire (the paper's eq. 6-9).
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "capture/biomechanical_fish.h"
#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

// One cycle of an action as the simulation swam it: nodal points in the world at each phase.
struct RecordedCycle {
    double periodSeconds = 0;
    bool playsToEnd = false;  // a turn, see motion::ActionSegment
    // Unit vector in the world: the direction of travel over the beat, or over the last beat before
    // a turn.
    glm::dvec3 course{1, 0, 0};
    // Poses in body lengths, at the phases 0 to kPhases, both included: kPhases + 1 of them.
    std::vector<NodeVectors> poses;
    // The pectoral fins at the same phases, left and right: opened, carried by the stroke, twisted,
    // radians. Empty: they lie at rest.
    std::vector<std::array<glm::dvec3, 2>> fins;
};

// The angle from one horizontal vector to the other, about the vertical, left positive, -pi .. pi.
[[nodiscard]] inline double yawRadians(const glm::dvec3& from, const glm::dvec3& to) {
    return std::atan2(glm::cross(from, to).y, glm::dot(from, to));
}

// The segment of a recording: body-frame increments (eq. 6, 7) and deformations (eq. 8), without
// control points. It is closed: repeated any number of times it neither jumps nor drifts. A
// symmetry that the exact motion has is given to it. All throw Error where a nodal point is farther
// from the body frame's origin, along an axis, than a body length, which 16 bits cannot hold.
//
// A gait straight on or backwards: the motion lies in a horizontal plane, and half a beat later it
// is its mirror image.
[[nodiscard]] motion::ActionSegment compileForward(const RecordedCycle& recording);
// A gait straight on or backwards by rowing: the path is level, and left and right move alike. On a
// slope: they move alike.
[[nodiscard]] motion::ActionSegment compileRowed(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileRowedSlope(const RecordedCycle& recording);
// A fish that hovers, turns or pitches in one place by rowing: as above, but a pivot's left and
// right differ. What it drifts in a cycle is taken from it.
[[nodiscard]] motion::ActionSegment compileHover(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compilePivot(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compilePitch(const RecordedCycle& recording);
// A gait on a curve: the path is level; a roll into the bend is in the poses. So it is in a turn.
[[nodiscard]] motion::ActionSegment compileCurve(const RecordedCycle& recording);
// A gait on a slope: half a beat later the motion is its mirror image, left and right exchanged.
[[nodiscard]] motion::ActionSegment compileSlope(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileLeftTurn(const RecordedCycle& recording);
// A fast start: the motion lies in a horizontal plane. It is not closed.
[[nodiscard]] motion::ActionSegment compileStart(const RecordedCycle& recording);

// A left turn or fast start, for a given time, begun in a tail beat or out of rest. What follows is
// measured while the fish swims on at the medium gait, after a fast start at the fast one: its way
// from the end of the turn on, in the world, over some beats.
struct EnteredTurn {
    RecordedCycle turn;
    double speedBefore = 0;  // body lengths a second
    glm::dvec3 wayAfter{1, 0, 0};
    double secondsAfter = 0;
};
// The swimming after a turn or a fast start: its speed p, and its SpeedResponse::swimDrag.
struct SwimsOn {
    double speed = 0;
    double drag = 0;
};
// Compiles a turn by eq. 6 and 7. The speed after the turn is that from which a fish that obeys the
// law of motion::SpeedResponse swims the measured way.
[[nodiscard]] motion::TurnPath compileEntered(const EnteredTurn& entered, const SwimsOn& on);
// The path half-way between two, on one course before the turn.
[[nodiscard]] motion::TurnPath blended(const motion::TurnPath& a, const motion::TurnPath& b);
[[nodiscard]] motion::TurnPath mirroredLeftRight(const motion::TurnPath& path);

// A segment with left and right exchanged, or top and bottom: the fish and its muscles have both
// symmetries, so its motions have them too. Control points are not exchanged: add them afterwards.
[[nodiscard]] motion::ActionSegment mirroredLeftRight(const motion::ActionSegment& segment);
[[nodiscard]] motion::ActionSegment mirroredTopBottom(const motion::ActionSegment& segment);

// Adds the control points that belong to the nodal points of each phase (eq. 9).
void addControlPoints(const body::FishBody& body, motion::ActionSegment& segment);

}  // namespace aquarama::capture
