// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/level_buffers.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/units/error.h"

namespace aquarama {

namespace {

RecordedPoint quantised(glm::vec3 point) {
    RecordedPoint recorded{};
    for (int axis = 0; axis < 3; ++axis) {
        const float value = std::round(point[axis] / kPoseUnit);
        if (!(std::abs(value) <= 32767))
            throw Error("a control point lies further than a body length from its fish");
        recorded.at(static_cast<std::size_t>(axis)) = static_cast<std::int16_t>(value);
    }
    return recorded;
}

void addPosed(const FishBody& body, const NodalPose& pose, std::vector<RecordedPoint>& points) {
    NodalPoints nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n)
        nodes.at(n) = glm::vec3(pose.at(n)[0], pose.at(n)[1], pose.at(n)[2]) * kPoseUnit;
    std::vector<glm::vec3> cage(kControlPoints);
    poseCage(body, nodes, cage);
    std::ranges::transform(cage, std::back_inserter(points), quantised);
}

}  // namespace

std::vector<RecordedPoint> recordedPoints(const FishBody& body, const Repertoire& repertoire) {
    std::vector<RecordedPoint> points;
    points.reserve(std::size_t{kActions} * kPhases * kControlPoints);
    for (const ActionSegment& segment : repertoire.segments) {
        if (segment.controlPoints.size() == kPhases) {
            for (const ControlPointPose& pose : segment.controlPoints)
                for (const auto& [x, y, z] : pose) points.push_back({x, y, z, 0});
        } else {
            for (const NodalPose& pose : segment.nodes) addPosed(body, pose, points);
        }
    }
    return points;
}

float reachOf(const std::vector<RecordedPoint>& points) {
    float reach = 0.0F;
    for (const auto& [x, y, z, unused] : points)
        reach = std::max(reach, glm::length(glm::vec3(x, y, z)));
    return reach * kPoseUnit;
}

LevelBuffers::LevelBuffers(const LimitTable& table)
    : vertexCount{table.vertices.size()},
      bodyIndices{static_cast<GLsizei>(table.bodyIndices)},
      finIndices{static_cast<GLsizei>(table.indices.size() - table.bodyIndices)},
      firstEntries{makeBuffer(table.firstEntry, "stencil offsets")},
      entries{makeBuffer(table.entries, "stencil entries")},
      places{makeBuffer(table.vertices, "skin places")},
      indices{makeBuffer(table.indices, "fish indices")} {
    const unsigned array = vertexArray.name();
    glVertexArrayElementBuffer(array, indices.name());
    glVertexArrayVertexBuffer(array, 0, places.name(), 0, sizeof(SkinPlace));
    for (const unsigned attribute : {0U, 1U, 2U}) {
        glEnableVertexArrayAttrib(array, attribute);
        glVertexArrayAttribBinding(array, attribute, 0);
    }
    glVertexArrayAttribFormat(array, 0, 4, GL_FLOAT, GL_FALSE, offsetof(SkinPlace, rest));
    glVertexArrayAttribFormat(array, 1, 2, GL_FLOAT, GL_FALSE, offsetof(SkinPlace, fin));
    glVertexArrayAttribIFormat(array, 2, 1, GL_UNSIGNED_INT, offsetof(SkinPlace, part));
}

}  // namespace aquarama
