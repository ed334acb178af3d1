// SPDX-License-Identifier: Apache-2.0
// Outlines of fish for figures: of the biomechanical fish, from above or from the side, and of a
// captured segment from above. Lengths are body lengths; pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "capture/biomechanical_fish.h"
#include "capture/measure.h"
#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// From where a figure shows the biomechanical fish.
enum class ViewSide { Above, Side };

// A point of the world as a point of the figure, x to the right. From above the figure's y is -z of
// the world, the left of a fish that heads along +x; from the side it is y of the world.
[[nodiscard]] glm::dvec2 seen(ViewSide view, const glm::dvec3& world);

// The corners of a closed outline, in the figure.
using Polygon = std::vector<glm::dvec2>;

// The outline of body and tail, first; from the side also the faces of the fins on back and belly.
[[nodiscard]] std::vector<Polygon> silhouetteOf(const body::FishBody& body,
                                                const capture::NodeVectors& nodes,
                                                ViewSide view);

// Each pectoral fin, left then right, as a line of two points from its root. From above it is the
// span: outward when the fin is perpendicular to the flow, backward along the body when it is
// parallel. From the side it is the chord.
[[nodiscard]] std::vector<Polygon> finLines(const capture::FinPlates& fins,
                                            const capture::NodeVectors& nodes,
                                            ViewSide view);

// A captured fish, from the data of its repertoire alone.

// World x to the right of the figure, world z (the right of a fish that heads along x) as y, which
// points down on the figure.
[[nodiscard]] glm::dvec2 fromAbove(const glm::dvec3& world);

// An outline in the coordinates of fromAbove().
struct FishOutline {
    std::vector<glm::dvec2> outline;                 // closed polygon of body and tail
    std::vector<std::vector<glm::dvec2>> pectorals;  // left and right; none without control points
    std::vector<glm::dvec2> midline;                 // from nose to tip of the tail
};

// The fish at phase k of any cycle of a segment, where `replayed` is that phase. The outline is
// that of the recorded control points. Where the segment has none, it is that of the rings of nodal
// points, which is narrower.
[[nodiscard]] FishOutline viewFromAbove(const motion::ActionSegment& segment,
                                        const capture::ReplayedPhase& replayed,
                                        std::size_t k);

// The recorded control points in the body frame at a phase, which is taken modulo kPhases. The
// segment must have control points.
[[nodiscard]] std::vector<glm::dvec3> controlPointsAt(const motion::ActionSegment& segment,
                                                      std::size_t phase);

// The smooth curve (a Catmull-Rom spline) through the nose, the centres of the five rings and the
// middle of the tips of the tail: eight points from each of these to the next, and the last one.
inline constexpr std::size_t kMidlinePoints = 49;
[[nodiscard]] std::vector<glm::dvec2> midlineFromAbove(const capture::ReplayedPhase& replayed);

}  // namespace aquarama::report
