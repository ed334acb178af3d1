// SPDX-License-Identifier: Apache-2.0
// Fish of few triangles, and how meshes hang on coarser ones.
#include "render_node/surface/few_triangles.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/skin/limit_table.h"
#include "tests/support/all_species.h"

namespace aquarama::surface {
namespace {

TEST(FewTriangles, haveTwentyToFortyOfWhichEachIsReal) {
    for (const std::string& name : test::allSpeciesNames()) {
        const body::FishBody body = body::makeBody(test::castMember(name));
        const FewTriangles few = makeFewTriangles(body, skin::makeLimitTable(body, 0));
        EXPECT_GE(few.indices.size() / 3, 20U) << name;
        EXPECT_LE(few.indices.size() / 3, 40U) << name;
        EXPECT_GT(few.bodyIndices, 0U);
        ASSERT_GE(few.cage.size(), std::size_t{body::kControlPoints});
        for (const FewTriangles::Place& place : few.cage) {
            const auto& w = place.weights;
            EXPECT_NEAR(w[0] + w[1] + w[2], 1.0F, 1e-5F) << name;
            for (const float weight : w) EXPECT_GE(weight, -1e-5F) << name;
            EXPECT_NEAR(glm::length(place.normal), 1.0F, 1e-4F) << name;
        }
    }
}

// From the side: body and fins, half of the sum over both faces.
double sideArea(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> indices) {
    double area = 0;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        const glm::vec3 a = points[indices[t]];
        area += 0.25 * std::abs(static_cast<double>(
                           glm::cross(points[indices[t + 1]] - a, points[indices[t + 2]] - a).z));
    }
    return area;
}

// Seen from the side their bodies cover what the fish's do.
TEST(FewTriangles, coverAboutAsMuchAsTheFish) {
    for (const std::string& name : test::allSpeciesNames()) {
        const body::FishBody body = body::makeBody(test::castMember(name));
        const FewTriangles few = makeFewTriangles(body, skin::makeLimitTable(body, 0));
        const skin::LimitTable mesh = skin::makeLimitTable(body, 1);
        std::vector<glm::vec3> fine, coarse;
        for (const skin::SkinPlace& vertex : mesh.vertices) fine.emplace_back(vertex.rest);
        for (const FewTriangles::Vertex& vertex : few.vertices)
            coarse.emplace_back(vertex.place.rest);
        const double all = sideArea(fine, std::span(mesh.indices).first(mesh.bodyIndices));
        const double kept = sideArea(coarse, std::span(few.indices).first(few.bodyIndices));
        EXPECT_NEAR(kept / all, 1.0, 0.2) << name;
    }
}

// The coarser level's triangles, cut where the finer one's vertices are, are the same surface: all
// its vertices are there, and each new one is in the middle of two.
TEST(CoarserLevel, parentsAreNeighboursOfTheCoarserMesh) {
    const body::FishBody body = body::makeBody(test::castMember("bigeye_scad"));
    skin::LimitTable coarser = skin::makeLimitTable(body, 0);
    for (int level = 1; level <= 2; ++level) {
        const skin::LimitTable table = skin::makeLimitTable(body, level);
        const auto parents = skin::coarserParents(body, level, coarser);
        ASSERT_EQ(parents.size(), table.vertices.size());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < table.skinVertices; ++i) {
            const auto& [a, b] = parents[i];
            kept += a == b ? 1 : 0;
            if (a == b) {
                EXPECT_EQ(a, i);
                continue;
            }
            EXPECT_EQ(parents[a][0], a) << "a parent is a vertex of the coarser level";
            EXPECT_EQ(parents[b][0], b);
            const glm::vec3 middle =
                0.5F * glm::vec3(table.vertices[a].rest + table.vertices[b].rest);
            EXPECT_LT(glm::distance(middle, glm::vec3(table.vertices[i].rest)), 0.05F);
        }
        EXPECT_EQ(kept, coarser.skinVertices);
        coarser = table;
    }
}

}  // namespace
}  // namespace aquarama::surface
