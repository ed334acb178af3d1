// SPDX-License-Identifier: Apache-2.0
#include "master/capture/exchange/swimming_skin.h"

#include <algorithm>
#include <cassert>

#include "common/skin/limit_table.h"
#include "master/capture/measure/measure.h"

namespace aquarama::exchange {

namespace {

constexpr int kSurfaceLevel = 1;  // 1698 vertices; its normals are the limit surface's

body::NodalPoints nodesAt(const motion::ActionSegment& segment, std::size_t phase) {
    body::NodalPoints nodes{};
    std::ranges::transform(capture::poseAt(segment, phase),
                           nodes.begin(),
                           [](const glm::dvec3& node) { return glm::vec3(node); });
    return nodes;
}

SkinShape shapeOf(const body::FishBody& body,
                  const skin::LimitTable& table,
                  const body::NodalPoints& nodes,
                  float lengthMetres) {
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    body::poseCage(body, nodes, cage);
    SkinShape shape;
    for (std::size_t i = 0; i < table.vertices.size(); ++i) {
        const skin::SkinPoint point = skin::skinPoint(table, i, cage);
        shape.positions.push_back(point.position * lengthMetres);
        shape.normals.push_back(point.normal);
    }
    return shape;
}

}  // namespace

SwimmingSkin skinOf(const body::FishBody& body,
                    const motion::ActionSegment& segment,
                    double lengthMetres,
                    int shapes) {
    assert(motion::kPhases % shapes == 0);
    const skin::LimitTable table = skin::makeLimitTable(body, kSurfaceLevel);
    SwimmingSkin skin{.triangles = table.indices, .shapes = {}};
    for (int phase = 0; phase < motion::kPhases; phase += motion::kPhases / shapes)
        skin.shapes.push_back(shapeOf(body,
                                      table,
                                      nodesAt(segment, static_cast<std::size_t>(phase)),
                                      static_cast<float>(lengthMetres)));
    return skin;
}

}  // namespace aquarama::exchange
