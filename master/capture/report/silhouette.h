// SPDX-License-Identifier: Apache-2.0
// The dynamic fish as a shape to fill: its skin, and where its pectoral fins stand.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "master/capture/biomechanical_fish.h"
#include "master/capture/measure.h"

namespace aquarama::report {

enum class ViewSide { Above, Side };

// Body lengths, x to the right; from above the left of the world is up, from the side its height.
[[nodiscard]] glm::dvec2 seen(ViewSide view, const glm::dvec3& world);

using Polygon = std::vector<glm::dvec2>;

// Body and tail, and from the side the fins on back and belly.
[[nodiscard]] std::vector<Polygon> silhouetteOf(const body::FishBody& body,
                                                const capture::NodeVectors& nodes,
                                                ViewSide view);

// Each pectoral fin as a line: from above from its root out or, flat, along the body; from the side
// its chord.
[[nodiscard]] std::vector<Polygon> finLines(const capture::PectoralFins& fins,
                                            const capture::NodeVectors& nodes,
                                            ViewSide view);

// A captured fish seen from above, for drawing: all from its repertoire.

// World x to the right of the paper, world z (the right of a fish that heads along x) down.
[[nodiscard]] glm::dvec2 fromAbove(const glm::dvec3& world);

struct FishOutline {
    std::vector<glm::dvec2> outline;                 // of body and tail
    std::vector<std::vector<glm::dvec2>> pectorals;  // left and right, where recorded
    std::vector<glm::dvec2> midline;                 // from nose to tip of the tail
};

// Of a segment as `replayed` at phase k of any cycle. The outline is that of the recorded control
// points, or where the segment has none that of the rings of nodal points, which is slimmer.
[[nodiscard]] FishOutline viewFromAbove(const motion::ActionSegment& segment,
                                        const capture::ReplayedPhase& replayed,
                                        std::size_t k);

// Recorded control points in the body frame at a phase of any cycle; body lengths.
[[nodiscard]] std::vector<glm::dvec3> controlPointsAt(const motion::ActionSegment& segment,
                                                      std::size_t phase);

// The smooth curve (Catmull-Rom) through nose, centres of the five rings and middle of the tail's
// tips, evenly between them.
inline constexpr std::size_t kMidlinePoints = 49;
[[nodiscard]] std::vector<glm::dvec2> midlineFromAbove(const capture::ReplayedPhase& replayed);

}  // namespace aquarama::report
