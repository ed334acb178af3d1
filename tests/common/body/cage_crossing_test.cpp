// SPDX-License-Identifier: Apache-2.0
// No part of a cage passes through another.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include "common/body/face.h"
#include "common/body/fins.h"
#include "common/body/fish_body.h"
#include "tests/common/body/bend.h"
#include "tests/support/all_species.h"

namespace aquarama::body {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

double volume(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    return glm::dot(b - a, glm::cross(c - a, d - a));
}

bool passesThrough(glm::dvec3 from, glm::dvec3 to, const Triangle& t) {
    if (volume(t[0], t[1], t[2], from) * volume(t[0], t[1], t[2], to) >= 0) return false;
    const double u = volume(from, to, t[0], t[1]);
    const double v = volume(from, to, t[1], t[2]);
    const double w = volume(from, to, t[2], t[0]);
    return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

bool cross(const Triangle& a, const Triangle& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (passesThrough(a.at(k), a.at((k + 1) % 3), b) ||
            passesThrough(b.at(k), b.at((k + 1) % 3), a))
            return true;
    return false;
}

struct Face {
    std::array<std::uint16_t, 4> vertices;
    std::array<Triangle, 2> triangles;
    glm::dvec3 least, most;
    bool isDorsal = false;
};

bool cross(const Face& a, const Face& b) {
    return std::ranges::any_of(a.triangles, [&](const Triangle& s) {
        return std::ranges::any_of(b.triangles, [&](const Triangle& t) { return cross(s, t); });
    });
}

bool areNeighbours(const Face& a, const Face& b) {
    return std::ranges::find_first_of(a.vertices, b.vertices) != a.vertices.end();
}

bool areApart(const Face& a, const Face& b) {
    return glm::any(glm::greaterThan(a.least, b.most)) ||
           glm::any(glm::greaterThan(b.least, a.most));
}

std::vector<Face> facesOf(const FishBody& body, const std::vector<glm::vec3>& points) {
    std::vector<Face> faces;
    for (const auto& corners : body.cage.faces) {
        std::array<glm::dvec3, 4> p{};
        for (std::size_t k = 0; k < 4; ++k) p.at(k) = points.at(corners.at(k));
        Face face{.vertices = corners,
                  .triangles = {Triangle{p[0], p[1], p[2]}, Triangle{p[0], p[2], p[3]}},
                  .least = glm::min(glm::min(p[0], p[1]), glm::min(p[2], p[3])),
                  .most = glm::max(glm::max(p[0], p[1]), glm::max(p[2], p[3]))};
        for (const auto corner : corners)
            face.isDorsal |= body.cage.vertices.at(corner).part == CagePart::FirstDorsal;
        faces.push_back(face);
    }
    return faces;
}

class CrossingOf : public testing::TestWithParam<std::string> {
  protected:
    // Where faces that share no vertex cross; the two halves of a lone dorsal fin may, in its
    // plane.
    static void expectNone(const FishBody& body, const NodalPoints& nodes, FacePose face = {}) {
        std::vector<glm::vec3> points(kControlPoints);
        poseCage(body, nodes, points);
        for (std::size_t i = 0; i < points.size(); ++i)
            if (body.cage.vertices[i].part == CagePart::Body)
                points[i] += turned(faceOffset(body.fins.style, body.fins.points[i], face), 0);
        const std::vector<Face> faces = facesOf(body, points);
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (std::size_t j = i + 1; j < faces.size(); ++j) {
                const Face& a = faces[i];
                const Face& b = faces[j];
                if (areApart(a, b) || areNeighbours(a, b) || (a.isDorsal && b.isDorsal)) continue;
                EXPECT_FALSE(cross(a, b))
                    << "faces " << i << " and " << j << ", at s = " << -a.triangles[0][0].x
                    << ", y = " << a.triangles[0][0].y;
            }
    }
};

INSTANTIATE_TEST_SUITE_P(Cast,
                         CrossingOf,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& name) { return name.param; });

TEST_P(CrossingOf, facesIsNowhereAtRest) {
    const FishBody body = makeBody(test::castMember(GetParam()));
    expectNone(body, body.restNodes);
}

TEST_P(CrossingOf, facesIsNowhereInAnOpenMouth) {
    const FishBody body = makeBody(test::castMember(GetParam()));
    for (const float mouth : {0.25F, 0.5F, 1.0F})
        expectNone(body, body.restNodes, {.mouth = mouth, .gill = mouth});
}

TEST_P(CrossingOf, facesIsNowhereInASharpBend) {
    const FishBody body = makeBody(test::castMember(GetParam()));
    NodalPoints nodes = body.restNodes;
    for (glm::vec3& node : nodes) node = bentToTheRight(node, 0.6F);
    expectNone(body, nodes);
}

}  // namespace
}  // namespace aquarama::body
