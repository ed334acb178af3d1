// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/fish_view.h"

#include <algorithm>
#include <array>

#include "common/body/cage_topology.h"

namespace aquarama {

namespace {

// The column of either side that is widest, and how the pectoral fins' vertices follow each other
// round their margin (see common/body/cage_topology.h).
constexpr std::size_t kRightFlank = 3;
constexpr std::size_t kLeftFlank = 10;

std::vector<glm::vec3> cageAt(const FishBody& body, const NodeVectors& nodes) {
    NodalPoints points{};
    std::ranges::transform(nodes, points.begin(), [](const glm::dvec3& n) { return glm::vec3(n); });
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    poseCage(body, points, cage);
    return cage;
}

// Convex enough: its corners sorted round their middle.
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
    std::ranges::sort(points, [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    const auto isRightTurn = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0;
    };
    std::vector<glm::dvec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= start + 2 &&
                   isRightTurn(hull[hull.size() - 2], hull.back(), point))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

std::vector<glm::dvec2> pectoral(const FishBody& body,
                                 const std::vector<glm::vec3>& cage,
                                 bool isRight) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < cage.size(); ++i) {
        const CageVertex& vertex = body.cage.vertices[i];
        if (vertex.part == CagePart::Pectoral && (vertex.rest.z > 0) == isRight)
            points.push_back(fromAbove(glm::dvec3(cage[i])));
    }
    return hullOf(std::move(points));
}

}  // namespace

glm::dvec2 fromAbove(const glm::dvec3& world) {
    return {world.x, world.z};
}

FishView viewFromAbove(const FishBody& body, const ReplayedPhase& phase) {
    const std::vector<glm::vec3> cage = cageAt(body, phase.nodes);
    const auto ringPoint = [&](std::size_t ring, std::size_t column) {
        return fromAbove(glm::dvec3(cage.at(ring * kTubeColumns + column)));
    };
    const glm::dvec2 nose = fromAbove(phase.nodes[0]);
    FishView view{.outline = {nose}, .pectorals = {}, .midline = {nose}, .eyes = {}};
    for (std::size_t ring = 0; ring < kTubeRings; ++ring) {
        view.outline.push_back(ringPoint(ring, kRightFlank));
        view.midline.push_back((ringPoint(ring, kRightFlank) + ringPoint(ring, kLeftFlank)) / 2.0);
    }
    for (std::size_t ring = kTubeRings; ring-- > 0;)
        view.outline.push_back(ringPoint(ring, kLeftFlank));
    view.midline.push_back(fromAbove((phase.nodes[21] + phase.nodes[22]) / 2.0));
    view.pectorals = {pectoral(body, cage, false), pectoral(body, cage, true)};
    for (const std::size_t column : {kLeftFlank, kRightFlank}) {
        std::size_t ring = 0;  // the ring nearest to the eye
        while (body.cage.vertices.at((ring + 1) * kTubeColumns + column).rest.x < body.eye.x)
            ++ring;
        view.eyes.push_back(ringPoint(ring, column));
    }
    return view;
}

}  // namespace aquarama
