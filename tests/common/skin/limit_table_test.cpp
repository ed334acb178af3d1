// SPDX-License-Identifier: Apache-2.0
#include "common/skin/limit_table.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include "tests/render_node/surface/test_fish.h"

namespace aquarama::skin {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

std::vector<glm::vec3> bentCage(const body::FishBody& body) {
    std::vector<glm::vec3> points(body::kControlPoints);
    body::poseCage(body, test::sway(body, 0.12F, 0.3F, 0.3F), points);
    return points;
}

// NOLINTBEGIN(readability-identifier-naming): names that OpenSubdiv calls
struct RefinedPoint {
    void Clear(void* = nullptr) { position = {}; }
    void AddWithWeight(const RefinedPoint& source, float weight) {
        position += weight * source.position;
    }
    glm::vec3 position{};
};
// NOLINTEND(readability-identifier-naming)

// Where repeated refinement, without any limit mask, takes the cage's vertices, and the points that
// the first refinement put on its faces: an oracle that shares no code with limit stencils.
struct RefinedFar {
    std::vector<glm::vec3> ofVertices, ofFaces;
};
RefinedFar refineFar(const body::FishBody& body, const std::vector<glm::vec3>& points) {
    constexpr int kLevels = 6;
    const std::vector<int> verticesPerFace(body.cage.faces.size(), 4);
    std::vector<int> corners, creaseEnds;
    std::vector<float> sharpness;
    for (const auto& face : body.cage.faces)
        corners.insert(corners.end(), face.begin(), face.end());
    for (const body::CageCrease& crease : body.cage.creases) {
        creaseEnds.insert(creaseEnds.end(), crease.edge.begin(), crease.edge.end());
        sharpness.push_back(crease.sharpness);
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = body::kControlPoints;
    descriptor.numFaces = body::kCageFaces;
    descriptor.numVertsPerFace = verticesPerFace.data();
    descriptor.vertIndicesPerFace = corners.data();
    descriptor.numCreases = static_cast<int>(sharpness.size());
    descriptor.creaseVertexIndexPairs = creaseEnds.data();
    descriptor.creaseWeights = sharpness.data();
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const std::unique_ptr<Far::TopologyRefiner> refiner{
        Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, Sdc::Options()))};
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(kLevels));

    std::vector<RefinedPoint> level(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) level[i].position = points[i];
    std::vector<int> vertexNow(points.size()), faceNow(body::kCageFaces);
    for (std::size_t i = 0; i < points.size(); ++i) vertexNow[i] = static_cast<int>(i);
    for (int l = 1; l <= kLevels; ++l) {
        std::vector<RefinedPoint> next(
            static_cast<std::size_t>(refiner->GetLevel(l).GetNumVertices()));
        Far::PrimvarRefiner(*refiner).Interpolate(l, level, next);
        const auto& parent = refiner->GetLevel(l - 1);
        for (int& vertex : vertexNow) vertex = parent.GetVertexChildVertex(vertex);
        for (int f = 0; f < body::kCageFaces; ++f) {
            int& point = faceNow[static_cast<std::size_t>(f)];
            point = l == 1 ? parent.GetFaceChildVertex(f) : parent.GetVertexChildVertex(point);
        }
        level = std::move(next);
    }
    RefinedFar result;
    for (const int i : vertexNow)
        result.ofVertices.push_back(level[static_cast<std::size_t>(i)].position);
    for (const int i : faceNow)
        result.ofFaces.push_back(level[static_cast<std::size_t>(i)].position);
    return result;
}

class LimitTableOf : public testing::TestWithParam<int> {
  protected:
    // Whether a triangle is of an eye or a thread (attachments_test).
    [[nodiscard]] bool isAttached(std::size_t firstIndex) const {
        return table_.indices[firstIndex] >= table_.skinVertices;
    }
    const body::FishBody body_ = test::scadBody();
    const LimitTable table_ = makeLimitTable(body_, GetParam());
};

TEST_P(LimitTableOf, weightsKeepPlacesAndTangentsForgetThem) {
    for (std::size_t i = 0; i < table_.vertices.size(); ++i) {
        double position = 0, u = 0, v = 0;
        for (std::uint32_t k = table_.firstEntry[i]; k < table_.firstEntry[i + 1]; ++k) {
            position += static_cast<double>(table_.entries[k].position);
            u += static_cast<double>(table_.entries[k].tangentU);
            v += static_cast<double>(table_.entries[k].tangentV);
        }
        ASSERT_NEAR(position, 1.0, 1e-5) << "vertex " << i;
        ASSERT_NEAR(u, 0.0, 1e-4) << "vertex " << i;
        ASSERT_NEAR(v, 0.0, 1e-4) << "vertex " << i;
    }
}

TEST_P(LimitTableOf, everyEdgeJoinsTwoTriangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::size_t triangles = 0;
    for (std::size_t t = 0; t < table_.indices.size(); t += 3) {
        if (isAttached(t)) continue;
        ++triangles;
        for (std::size_t k = 0; k < 3; ++k)
            ++edges[{table_.indices[t + k], table_.indices[t + (k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    const int cuts = 1 << GetParam();
    EXPECT_EQ(triangles, static_cast<std::size_t>(2 * body::kCageFaces * cuts * cuts));
}

TEST_P(LimitTableOf, normalsPointOutOfAClosedSkin) {
    const std::vector<glm::vec3> cage = bentCage(body_);
    std::vector<SkinPoint> points;
    for (std::size_t i = 0; i < table_.vertices.size(); ++i)
        points.push_back(skinPoint(table_, i, cage));
    double volume = 0;
    std::vector<glm::vec3> around(points.size());
    for (std::size_t t = 0; t < table_.indices.size(); t += 3) {
        if (isAttached(t)) continue;
        const glm::vec3 a = points[table_.indices[t]].position,
                        b = points[table_.indices[t + 1]].position,
                        c = points[table_.indices[t + 2]].position;
        const glm::vec3 area = glm::cross(b - a, c - a);
        volume += static_cast<double>(glm::dot(a, area)) / 6;
        for (std::size_t k = 0; k < 3; ++k) around[table_.indices[t + k]] += area;
    }
    // A scad of 1 m would displace some 11 litres: 0.155 kg at 0.24 m.
    EXPECT_NEAR(volume, 0.0109, 0.0015);
    // The last fold of the first dorsal fin lies flat on the back: there, and only there, a
    // vertex's triangles may look another way than the limit surface does.
    std::size_t inward = 0;
    for (std::size_t i = 0; i < table_.skinVertices; ++i)
        inward += glm::dot(points[i].normal, around[i]) > 0.0F ? 0 : 1;
    EXPECT_LE(inward, 4U) << "of " << points.size();
}

TEST_P(LimitTableOf, finTrianglesAreToldByTheirLastVertex) {
    for (std::size_t t = 0; t < table_.indices.size(); t += 3) {
        if (isAttached(t)) continue;
        const SkinPlace& last = table_.vertices[table_.indices[t + 2]];
        const bool isFin = t >= table_.bodyIndices;
        ASSERT_EQ(last.part != static_cast<std::uint32_t>(body::CagePart::Body), isFin);
        for (std::size_t k = 0; k < 3 && isFin; ++k) {
            const glm::vec2 fin = table_.vertices[table_.indices[t + k]].fin;
            ASSERT_TRUE(fin.x >= 0 && fin.x <= 1 && fin.y >= 0 && fin.y <= 1);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, LimitTableOf, testing::Values(0, 1, 2));

TEST(LimitTable, level0IsTheControlMesh) {
    const body::FishBody body = test::scadBody();
    const LimitTable table = makeLimitTable(body, 0);
    const std::vector<glm::vec3> cage = bentCage(body);
    ASSERT_EQ(table.skinVertices, cage.size());
    for (std::size_t i = 0; i < cage.size(); ++i)
        EXPECT_EQ(skinPoint(table, i, cage).position, cage[i]);
}

// Where the control mesh takes over a fish fills some 160 pixels: the tips of its fins, which
// change most, move by less than three.
TEST(LimitTable, aChangeOfLevelMovesNoVertexFar) {
    const body::FishBody body = test::scadBody();
    const std::vector<glm::vec3> cage = bentCage(body);
    const LimitTable coarse = makeLimitTable(body, 1), fine = makeLimitTable(body, 2);
    for (std::size_t i = 0; i < body::kControlPoints; ++i) {
        const glm::vec3 limit = skinPoint(coarse, i, cage).position;
        EXPECT_LT(glm::distance(limit, cage[i]), 3.0F / 160.0F) << "vertex " << i;
        EXPECT_LT(glm::distance(limit, skinPoint(fine, i, cage).position), 1e-6F) << "vertex " << i;
    }
}

TEST(LimitTable, finerLevelsLieWhereEndlessRefinementLeads) {
    const body::FishBody body = test::scadBody();
    const std::vector<glm::vec3> cage = bentCage(body);
    const RefinedFar far = refineFar(body, cage);
    for (const int level : {1, 2}) {
        const LimitTable table = makeLimitTable(body, level);
        for (std::size_t i = 0; i < body::kControlPoints; ++i) {
            const glm::vec3 limit = skinPoint(table, i, cage).position;
            ASSERT_LT(glm::distance(limit, far.ofVertices[i]), 1e-4F) << "vertex " << i;
        }
    }
    // On level 1 the vertex that a face's last triangles end in is the middle of that face.
    const LimitTable table = makeLimitTable(body, 1);
    std::size_t found = 0;
    for (std::size_t i = body::kControlPoints; i < table.skinVertices; ++i) {
        const glm::vec3 limit = skinPoint(table, i, cage).position;
        for (const glm::vec3 middle : far.ofFaces) {
            if (glm::distance(limit, middle) < 1e-4F) {
                ++found;
                break;
            }
        }
    }
    EXPECT_GE(found, far.ofFaces.size());
}

}  // namespace
}  // namespace aquarama::skin
