// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/level_buffers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/body/fin_motion.h"
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

NodalPoints nodesOf(const NodalPose& pose) {
    NodalPoints nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n)
        nodes.at(n) = glm::vec3(pose.at(n)[0], pose.at(n)[1], pose.at(n)[2]) * kPoseUnit;
    return nodes;
}

void addPosed(const FishBody& body,
              const NodalPoints& nodes,
              std::vector<RecordedPoint>& points) {
    std::vector<glm::vec3> cage(kControlPoints);
    poseCage(body, nodes, cage);
    std::ranges::transform(cage, std::back_inserter(points), quantised);
}

// Of the last points, one pose's.
void addHeadings(const FishBody& body,
                 const NodalPoints& nodes,
                 std::vector<RecordedPoint>& points) {
    std::array<float, kControlPoints> headings{};
    headingsOf(body, nodes, headings);
    const std::size_t first = points.size() - headings.size();
    for (std::size_t i = 0; i < headings.size(); ++i)
        points[first + i][3] = static_cast<std::int16_t>(
            std::lround(headings.at(i) / std::numbers::pi_v<float> * 32767.0F));
}

}  // namespace

std::vector<RecordedPoint> recordedPoints(const FishBody& body, const Repertoire& repertoire) {
    std::vector<RecordedPoint> points;
    points.reserve(std::size_t{kActions} * kPhases * kControlPoints);
    for (const ActionSegment& segment : repertoire.segments) {
        for (std::size_t phase = 0; phase < kPhases; ++phase) {
            const NodalPoints nodes = nodesOf(segment.nodes.at(phase));
            if (segment.controlPoints.empty()) {
                addPosed(body, nodes, points);
            } else {
                for (const auto& [x, y, z] : segment.controlPoints[phase])
                    points.push_back({x, y, z, 0});
            }
            addHeadings(body, nodes, points);
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

gl::Buffer makeFinBuffer(const FinTable& fins) {
    std::vector<std::byte> bytes(sizeof(FinStyle));
    std::memcpy(bytes.data(), &fins.style, sizeof(FinStyle));
    const auto points = std::as_bytes(std::span(fins.points));
    bytes.insert(bytes.end(), points.begin(), points.end());
    return makeBuffer(bytes, "fins");
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
