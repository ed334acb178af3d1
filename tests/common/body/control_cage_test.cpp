// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/body/fish_body.h"
#include "common/config/species.h"

namespace aquarama {
namespace {

const FishBody& scad() {
    static const FishBody body =
        makeBody(readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"));
    return body;
}

using Edge = std::pair<int, int>;

std::map<Edge, int> directedEdges(const ControlCage& cage) {
    std::map<Edge, int> edges;
    for (const auto& face : cage.faces)
        for (std::size_t k = 0; k < 4; ++k) ++edges[{face[k], face[(k + 1) % 4]}];
    return edges;
}

// Rest coordinates (s, y, z) to positions, nose at the origin, body along -x.
glm::vec3 positionOf(const CageVertex& vertex) {
    return {-vertex.rest.x, vertex.rest.y, vertex.rest.z};
}

double volumeOf(const ControlCage& cage) {
    double volume = 0;
    for (const auto& face : cage.faces) {
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(positionOf(cage.vertices[face.at(k)]));
        };
        for (const std::size_t k : {1U, 2U})
            volume += glm::dot(corner(0), glm::cross(corner(k), corner(k + 1))) / 6;
    }
    return volume;
}

TEST(ControlCage, hasThePapersNumberOfPoints) {
    EXPECT_EQ(scad().cage.vertices.size(), std::size_t{kControlPoints});
    EXPECT_EQ(scad().cage.faces.size(), std::size_t{kCageFaces});
}

TEST(ControlCage, isOneClosedSurfaceWithEulerCharacteristicTwo) {
    const auto edges = directedEdges(scad().cage);
    for (const auto& [edge, uses] : edges) {
        EXPECT_EQ(uses, 1) << edge.first << '-' << edge.second;
        EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << '-' << edge.second;
    }
    EXPECT_EQ(kControlPoints - static_cast<int>(edges.size() / 2) + kCageFaces, 2);
}

TEST(ControlCage, hasOnlyTheValencesOfItsConstruction) {
    std::vector<int> valence(kControlPoints);
    for (const auto& face : scad().cage.faces)
        for (const auto vertex : face) ++valence.at(vertex);
    EXPECT_EQ(std::ranges::count(valence, 3), 36);
    EXPECT_EQ(std::ranges::count(valence, 4), 362);
    EXPECT_EQ(std::ranges::count(valence, 5), 28);
}

TEST(ControlCage, facesOutwardAndWeighsWhatAScadWeighs) {
    const double length = scad().typicalLengthMetres;
    const double kilograms = volumeOf(scad().cage) * length * length * length * 1025;
    EXPECT_NEAR(kilograms, 0.155, 0.005);  // a living one of 0.24 m: about 0.17, with its food
}

TEST(ControlCage, isItsOwnMirrorImage) {
    for (const CageVertex& vertex : scad().cage.vertices) {
        const glm::vec3 image = vertex.rest * glm::vec3(1, 1, -1);
        EXPECT_TRUE(std::ranges::any_of(scad().cage.vertices,
                                        [&](const CageVertex& other) {
                                            return glm::distance(other.rest, image) < 1e-6F &&
                                                   other.part == vertex.part &&
                                                   other.fin == vertex.fin;
                                        }))
            << vertex.rest.x << ' ' << vertex.rest.y << ' ' << vertex.rest.z;
    }
}

TEST(ControlCage, knowsWhichVerticesAreFins) {
    std::map<CagePart, int> count;
    for (const CageVertex& vertex : scad().cage.vertices) {
        ++count[vertex.part];
        EXPECT_EQ(vertex.part == CagePart::Body, vertex.fin == glm::vec2(0))
            << "a fin's vertex is above its root, where p and q are not both zero";
        EXPECT_GE(std::min(vertex.fin.x, vertex.fin.y), 0.0F);
        EXPECT_LE(std::max(vertex.fin.x, vertex.fin.y), 1.0F);
    }
    EXPECT_EQ(count[CagePart::FirstDorsal], 32);
    EXPECT_EQ(count[CagePart::SecondDorsal], 14);
    EXPECT_EQ(count[CagePart::Anal], 24);
    EXPECT_EQ(count[CagePart::Pelvic], 16);
    EXPECT_EQ(count[CagePart::Pectoral], 24);
    EXPECT_EQ(count[CagePart::Caudal], 48);
}

TEST(ControlCage, creasesOnlyItsOwnEdgesAndEachOnce) {
    const auto edges = directedEdges(scad().cage);
    std::set<Edge> seen;
    for (const CageCrease& crease : scad().cage.creases) {
        const Edge edge{crease.edge[0], crease.edge[1]};
        EXPECT_TRUE(edges.contains(edge));
        EXPECT_TRUE(seen.insert(edge).second);
        EXPECT_GT(crease.sharpness, 0.0F);
    }
    EXPECT_FALSE(seen.empty());
}

std::vector<glm::vec3> posed(const NodalPoints& nodes) {
    std::vector<glm::vec3> points(kControlPoints);
    poseCage(scad(), nodes, points);
    return points;
}

TEST(PoseCage, restNodesGiveTheRestCage) {
    const auto points = posed(scad().restNodes);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(points[i], positionOf(scad().cage.vertices[i])), 1e-6F) << i;
}

TEST(PoseCage, followsTheNodesThroughARigidMotion) {
    const float c = 0.6F;
    const float s = 0.8F;
    const auto move = [&](glm::vec3 p) {
        return glm::vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z) + glm::vec3(3, -2, 1);
    };
    NodalPoints nodes = scad().restNodes;
    for (glm::vec3& node : nodes) node = move(node);
    const auto points = posed(nodes);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(points[i], move(positionOf(scad().cage.vertices[i]))), 1e-5F) << i;
}

// Bent along a circle, the axis keeps its length and every section stays square to it, so that a
// point keeps its height and its distance from the axis.
TEST(PoseCage, bendsAlongAnArcWithoutShearing) {
    const float radius = 0.8F;
    const auto bend = [&](glm::vec3 p) {
        const float angle = -p.x / radius;
        return glm::vec3(
            -(radius - p.z) * std::sin(angle), p.y, radius - (radius - p.z) * std::cos(angle));
    };
    NodalPoints nodes = scad().restNodes;
    for (glm::vec3& node : nodes) node = bend(node);
    const auto points = posed(nodes);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const CageVertex& vertex = scad().cage.vertices[i];
        if (vertex.part != CagePart::Body) continue;
        EXPECT_NEAR(points[i].y, vertex.rest.y, 1e-6F);
        EXPECT_LT(glm::distance(points[i], bend(positionOf(vertex))), 0.01F) << i;
    }
}

}  // namespace
}  // namespace aquarama
