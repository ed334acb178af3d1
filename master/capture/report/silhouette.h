// SPDX-License-Identifier: Apache-2.0
// The dynamic fish as a shape to fill: its skin, and where its pectoral fins stand.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "common/body/fish_body.h"
#include "master/capture/dynamics/biomechanical_fish.h"

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

}  // namespace aquarama::report
