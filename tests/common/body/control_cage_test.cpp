// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/body/cage.h"
#include "common/body/fish_body.h"
#include "common/body/spine.h"
#include "tests/common/body/bend.h"
#include "tests/support/all_species.h"

namespace aquarama::body {
namespace {

// A body of the cast, made once.
const FishBody& bodyOf(const std::string& name) {
    static std::map<std::string, FishBody> bodies;
    const auto found = bodies.find(name);
    return found != bodies.end()
               ? found->second
               : bodies.emplace(name, makeBody(test::castMember(name))).first->second;
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

std::vector<glm::vec3> restOf(const FishBody& body) {
    std::vector<glm::vec3> points;
    for (const CageVertex& vertex : body.cage.vertices) points.push_back(positionOf(vertex));
    return points;
}

std::vector<glm::vec3> posed(const FishBody& body, const NodalPoints& nodes) {
    std::vector<glm::vec3> points(kControlPoints);
    poseCage(body, nodes, points);
    return points;
}

double volumeOf(const ControlCage& cage, const std::vector<glm::vec3>& points) {
    double volume = 0;
    for (const auto& face : cage.faces) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(points.at(face.at(k))); };
        for (const std::size_t k : {1U, 2U})
            volume += glm::dot(corner(0), glm::cross(corner(k), corner(k + 1))) / 6;
    }
    return volume;
}

class CageOf : public testing::TestWithParam<std::string> {
  protected:
    const config::Species species_ = test::castMember(GetParam());
    const FishBody& body_ = bodyOf(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Cast,
                         CageOf,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& name) { return name.param; });

TEST_P(CageOf, hasThePapersNumberOfPointsAndTheTopologyOfAll) {
    EXPECT_EQ(body_.cage.vertices.size(), std::size_t{kControlPoints});
    EXPECT_EQ(body_.cage.faces.size(), std::size_t{kCageFaces});
    EXPECT_EQ(body_.cage.faces, bodyOf(test::kCast[0]).cage.faces);
}

TEST(ControlCage, isOneClosedSurfaceWithEulerCharacteristicTwo) {
    const auto edges = directedEdges(bodyOf(test::kCast[0]).cage);
    for (const auto& [edge, uses] : edges) {
        EXPECT_EQ(uses, 1) << edge.first << '-' << edge.second;
        EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << '-' << edge.second;
    }
    EXPECT_EQ(kControlPoints - static_cast<int>(edges.size() / 2) + kCageFaces, 2);
}

TEST(ControlCage, hasOnlyTheValencesOfItsConstruction) {
    std::vector<int> valence(kControlPoints);
    for (const auto& face : bodyOf(test::kCast[0]).cage.faces)
        for (const auto vertex : face) ++valence.at(vertex);
    EXPECT_EQ(std::ranges::count(valence, 3), 36);
    EXPECT_EQ(std::ranges::count(valence, 4), 362);
    EXPECT_EQ(std::ranges::count(valence, 5), 28);
}

TEST(ControlCage, creasesOnlyItsOwnEdgesAndEachOnce) {
    const ControlCage& cage = bodyOf(test::kCast[0]).cage;
    const auto edges = directedEdges(cage);
    std::set<Edge> seen;
    for (const CageCrease& crease : cage.creases) {
        const Edge edge{crease.edge[0], crease.edge[1]};
        EXPECT_TRUE(edges.contains(edge));
        EXPECT_TRUE(seen.insert(edge).second);
        EXPECT_GT(crease.sharpness, 0.0F);
    }
    EXPECT_FALSE(seen.empty());
}

struct Weight {
    double metres, kilograms;  // of an animal, from the length-weight relations of its kind
};
const std::map<std::string, Weight> kWeights{{"bigeye_scad", {0.24, 0.17}},
                                             {"clownfish", {0.09, 0.016}},
                                             {"moorish_idol", {0.18, 0.17}},
                                             {"blue_tang", {0.22, 0.25}},
                                             {"parrotfish", {0.32, 0.70}},
                                             {"trumpetfish", {0.50, 0.25}},
                                             {"blacktip_reef_shark", {1.30, 15}},
                                             {"fusilier", {0.26, 0.23}},
                                             {"green_chromis", {0.07, 0.0065}},
                                             {"powder_blue_tang", {0.18, 0.15}},
                                             {"sea_goldie", {0.09, 0.0095}}};

TEST_P(CageOf, facesOutwardAndWeighsWhatItsAnimalWeighs) {
    const auto [metres, kilograms] = kWeights.at(GetParam());
    const double weight = volumeOf(body_.cage, restOf(body_)) * std::pow(metres, 3) * 1025;
    EXPECT_NEAR(weight / kilograms, 1, 0.25) << weight << " kg";
}

TEST_P(CageOf, isItsOwnMirrorImage) {
    for (const CageVertex& vertex : body_.cage.vertices) {
        const glm::vec3 image = vertex.rest * glm::vec3(1, 1, -1);
        EXPECT_TRUE(std::ranges::any_of(body_.cage.vertices,
                                        [&](const CageVertex& other) {
                                            return glm::distance(other.rest, image) < 1e-6F &&
                                                   other.part == vertex.part &&
                                                   other.fin == vertex.fin;
                                        }))
            << vertex.rest.x << ' ' << vertex.rest.y << ' ' << vertex.rest.z;
    }
}

TEST_P(CageOf, knowsWhichVerticesAreFins) {
    std::map<CagePart, int> count;
    for (const CageVertex& vertex : body_.cage.vertices) {
        ++count[vertex.part];
        EXPECT_EQ(vertex.part == CagePart::Body, vertex.fin == glm::vec2(0))
            << "a fin's vertex is above its root, where p and q are not both zero";
        EXPECT_GE(std::min(vertex.fin.x, vertex.fin.y), 0.0F);
        EXPECT_LE(std::max(vertex.fin.x, vertex.fin.y), 1.0F);
    }
    EXPECT_EQ(count[CagePart::FirstDorsal] + count[CagePart::SecondDorsal], 46);
    EXPECT_EQ(count[CagePart::SecondDorsal], species_.fins.secondDorsal ? 14 : 0);
    EXPECT_EQ(count[CagePart::Anal], 24);
    EXPECT_EQ(count[CagePart::Pelvic], 16);
    EXPECT_EQ(count[CagePart::Pectoral], 24);
    EXPECT_EQ(count[CagePart::Caudal], 48);
}

// Each ring lies behind the one before it along every column, so that the skin does not fold over.
// The lips are no such ring: a snout may reach over them.
TEST_P(CageOf, bodyRunsFromHeadToTailInEveryColumn) {
    const auto station = [&](int ring, int column) {
        return body_.cage.vertices.at(static_cast<std::size_t>(ring * kTubeColumns + column))
            .rest.x;
    };
    for (int column = 0; column < kTubeColumns; ++column)
        for (int ring = 2; ring <= kBodyEndRing; ++ring)
            EXPECT_GT(station(ring, column), station(ring - 1, column)) << ring << ' ' << column;
}

// A point of the profile's table, linear between its stations.
float profileAt(const FishBody& body, const std::vector<float>& values, float s) {
    return interpolate(body.profileStations, values, s);
}

TEST_P(CageOf, finsAreWhereTheyBelong) {
    for (const CageVertex& vertex : body_.cage.vertices) {
        const glm::vec3 at = vertex.rest;
        const float back = profileAt(body_, body_.profileDorsal, at.x);
        const float belly = -profileAt(body_, body_.profileVentral, at.x);
        const float flank = profileAt(body_, body_.profileHalfWidth, at.x);
        switch (vertex.part) {
            case CagePart::FirstDorsal:
            case CagePart::SecondDorsal:
                EXPECT_GT(at.y, back - 0.01F) << at.x;
                EXPECT_LT(std::abs(at.z), 0.006F);
                break;
            case CagePart::Anal:
                EXPECT_LT(at.y, belly + 0.01F) << at.x;
                EXPECT_LT(std::abs(at.z), 0.006F);
                break;
            case CagePart::Caudal:
                EXPECT_GT(at.x, body_.profileStations.back());
                EXPECT_LT(std::abs(at.z), 0.006F);
                break;
            case CagePart::Pelvic:
                EXPECT_LT(at.y, belly * 0.6F) << at.x;
                break;
            case CagePart::Pectoral:
                EXPECT_GT(std::abs(at.z), flank * 0.8F) << at.x;
                break;
            case CagePart::Eye:
                ADD_FAILURE() << "eyes are no part of the cage";
                break;
            case CagePart::Body:
                EXPECT_LE(std::abs(at.z), flank * 1.05F + 0.001F) << at.x;
                EXPECT_LE(at.y, back * 1.05F + 0.001F) << at.x;
                EXPECT_GE(at.y, belly * 1.05F - 0.001F) << at.x;
        }
    }
}

TEST_P(CageOf, reachesAsFarAsItsFile) {
    glm::vec2 least(1);
    glm::vec2 most(-1);
    glm::vec2 drawnLeast(1);
    glm::vec2 drawnMost(-1);
    const config::Fins& fins = species_.fins;
    for (const config::Fin& fin :
         {fins.firstDorsal, fins.secondDorsal.value_or(fins.firstDorsal), fins.anal, fins.caudal})
        for (const glm::vec2& point : fin.edge) {
            drawnLeast = glm::min(drawnLeast, point);
            drawnMost = glm::max(drawnMost, point);
        }
    for (const CageVertex& vertex : body_.cage.vertices) {
        if (vertex.part == CagePart::Pelvic || vertex.part == CagePart::Pectoral) continue;
        least = glm::min(least, glm::vec2(vertex.rest));
        most = glm::max(most, glm::vec2(vertex.rest));
    }
    EXPECT_FLOAT_EQ(least.x, 0);
    EXPECT_NEAR(most.x, drawnMost.x, 0.005);
    EXPECT_NEAR(most.y, drawnMost.y, 0.015) << "a ray may fall beside the peak";
    EXPECT_NEAR(least.y, drawnLeast.y, 0.015);
}

TEST_P(CageOf, restNodesGiveTheRestCage) {
    const auto points = posed(body_, body_.restNodes);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(points[i], positionOf(body_.cage.vertices[i])), 1e-6F) << i;
}

TEST_P(CageOf, followsTheNodesThroughARigidMotion) {
    const float c = 0.6F;
    const float s = 0.8F;
    const auto move = [&](glm::vec3 p) {
        return glm::vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z) + glm::vec3(3, -2, 1);
    };
    NodalPoints nodes = body_.restNodes;
    for (glm::vec3& node : nodes) node = move(node);
    const auto points = posed(body_, nodes);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(points[i], move(positionOf(body_.cage.vertices[i]))), 1e-5F) << i;
}

// Bent along a circle, the axis keeps its length and every section stays square to it, so that a
// point keeps its height and its distance from the axis.
TEST_P(CageOf, bendsAlongAnArcWithoutShearing) {
    const float radius = 0.8F;
    NodalPoints nodes = body_.restNodes;
    for (glm::vec3& node : nodes) node = bentToTheRight(node, radius);
    const auto points = posed(body_, nodes);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const CageVertex& vertex = body_.cage.vertices[i];
        if (vertex.part != CagePart::Body) continue;
        EXPECT_NEAR(points[i].y, vertex.rest.y, 1e-6F);
        EXPECT_LT(glm::distance(points[i], bentToTheRight(positionOf(vertex), radius)), 0.01F) << i;
    }
}

// As far as a sharp turn goes, to either side, the skin keeps what it holds and stretches no
// edge by much.
TEST_P(CageOf, staysSoundWhenBentSharply) {
    const auto atRest = restOf(body_);
    const double volume = volumeOf(body_.cage, atRest);
    for (const float radius : {-0.6F, 0.6F}) {
        NodalPoints nodes = body_.restNodes;
        for (glm::vec3& node : nodes) node = bentToTheRight(node, radius);
        const auto points = posed(body_, nodes);
        EXPECT_NEAR(volumeOf(body_.cage, points) / volume, 1, 0.05);
        for (const auto& [edge, uses] : directedEdges(body_.cage)) {
            const auto a = static_cast<std::size_t>(edge.first);
            const auto b = static_cast<std::size_t>(edge.second);
            const float stretch =
                glm::distance(points[a], points[b]) / glm::distance(atRest[a], atRest[b]);
            EXPECT_GT(stretch, 0.5F) << a << '-' << b;
            EXPECT_LT(stretch, 1.6F) << a << '-' << b;
        }
    }
}

}  // namespace
}  // namespace aquarama::body
