// SPDX-License-Identifier: Apache-2.0
// Eyes, whips, spines and barbels stay on the fish that bears them.
#include "common/skin/attachments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/skin/limit_table.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/all_species.h"

namespace aquarama::skin {
namespace {

struct Made {
    body::FishBody body;
    LimitTable table;
};

const Made& madeOf(const std::string& name) {
    static std::map<std::string, Made> all;
    const auto found = all.find(name);
    if (found != all.end()) return found->second;
    const body::FishBody body = body::makeBody(test::castMember(name));
    return all.emplace(name, Made{body, makeLimitTable(body, 2)}).first->second;
}

glm::vec3 nearestOnEdge(glm::vec3 a, glm::vec3 b, glm::vec3 p) {
    const float share = glm::dot(p - a, b - a) / std::max(glm::dot(b - a, b - a), 1e-20F);
    return glm::mix(a, b, std::clamp(share, 0.0F, 1.0F));
}

glm::vec3 nearestOf(const std::array<glm::vec3, 3>& t, glm::vec3 p) {
    const glm::vec3 b = t[1] - t[0], c = t[2] - t[0], normal = glm::cross(b, c);
    const float square = glm::dot(normal, normal);
    const float v = glm::dot(glm::cross(p - t[0], c), normal) / square;
    const float w = glm::dot(glm::cross(b, p - t[0]), normal) / square;
    if (v >= 0 && w >= 0 && v + w <= 1) return t[0] + v * b + w * c;
    const std::array edges{
        nearestOnEdge(t[0], t[1], p), nearestOnEdge(t[1], t[2], p), nearestOnEdge(t[2], t[0], p)};
    return *std::ranges::min_element(
        edges, {}, [&](glm::vec3 one) { return glm::distance(one, p); });
}

class AttachmentsOf : public testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] std::vector<SkinPoint> posed(const body::NodalPoints& nodes) const {
        std::vector<glm::vec3> cage(body::kControlPoints);
        body::poseCage(body_, nodes, cage);
        std::vector<SkinPoint> points;
        for (std::size_t i = 0; i < table_.vertices.size(); ++i)
            points.push_back(skinPoint(table_, i, cage));
        return points;
    }
    [[nodiscard]] std::vector<body::NodalPoints> poses() const {
        std::vector<body::NodalPoints> all{body_.restNodes};
        for (int k = 0; k < 4; ++k)
            all.push_back(test::sway(
                body_, 0.12F, 0.15F * static_cast<float>(k - 2), 0.17F * static_cast<float>(k)));
        return all;
    }
    [[nodiscard]] bool isEye(std::size_t vertex) const {
        return table_.vertices[vertex].part == static_cast<std::uint32_t>(body::CagePart::Eye);
    }
    // How far a place is over the skin, or under it: less than nothing.
    [[nodiscard]] float over(const std::vector<SkinPoint>& points, glm::vec3 place) const {
        float nearest = 1, sign = 1;
        for (std::size_t t = 0; t < table_.indices.size(); t += 3) {
            if (table_.indices[t] >= table_.skinVertices) continue;
            const std::array corners{points[table_.indices[t]].position,
                                     points[table_.indices[t + 1]].position,
                                     points[table_.indices[t + 2]].position};
            if (glm::distance(corners[0], place) > nearest + 0.2F) continue;
            const glm::vec3 from = place - nearestOf(corners, place);
            if (glm::length(from) >= nearest) continue;
            nearest = glm::length(from);
            const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            sign = glm::dot(from, normal) < 0 ? -1.0F : 1.0F;
        }
        return sign * nearest;
    }

    const body::FishBody& body_ = madeOf(GetParam()).body;
    const LimitTable& table_ = madeOf(GetParam()).table;
};

INSTANTIATE_TEST_SUITE_P(Cast,
                         AttachmentsOf,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& name) { return name.param; });

TEST_P(AttachmentsOf, eyesSitInTheSkinInEveryPose) {
    const float radius = body_.face.eye.z;
    for (const body::NodalPoints& nodes : poses()) {
        const auto points = posed(nodes);
        int balls = 0;
        for (std::size_t i = table_.skinVertices; i < points.size(); ++i) {
            if (!isEye(i)) continue;
            const float rho = glm::length(table_.vertices[i].fin);
            const float height = over(points, points[i].position) / radius;
            if (rho == 0) {
                ++balls;
                EXPECT_GT(height, 0.6F * body_.eyeBulge);
                EXPECT_LT(height, 1.4F * body_.eyeBulge + 0.05F);
            }
            if (rho > 1.05F) {
                EXPECT_LT(height, 0.01F) << "the rim shows, at " << rho;
            }
        }
        EXPECT_EQ(balls, 2);
    }
}

TEST_P(AttachmentsOf, eyesStayRoundAndLookOutwards) {
    for (const body::NodalPoints& nodes : poses()) {
        const auto points = posed(nodes);
        glm::vec3 middle{};
        for (std::size_t i = table_.skinVertices; i < points.size(); ++i) {
            if (!isEye(i)) continue;
            const glm::vec2 at = table_.vertices[i].fin;
            if (at == glm::vec2(0)) {
                middle = points[i].position;
                EXPECT_GT(over(points, middle + 0.001F * points[i].normal), over(points, middle));
                continue;
            }
            const float across = glm::distance(points[i].position, middle) / body_.face.eye.z;
            EXPECT_GT(across, 0.85F * glm::length(at));
            EXPECT_LT(across, 1.6F * glm::length(at) + 0.3F);
        }
    }
}

TEST_P(AttachmentsOf, threadsAreRootedInTheirFish) {
    constexpr std::size_t kSides = 4;
    for (const body::NodalPoints& nodes : poses()) {
        const auto points = posed(nodes);
        std::size_t first = table_.skinVertices;
        while (first < points.size() && isEye(first)) ++first;
        for (const body::BodyThread& thread : body_.threads) {
            const glm::vec3 root = 0.5F * (points[first].position + points[first + 2].position);
            EXPECT_LT(std::abs(over(points, root)), 0.012F)
                << "root of a thread at s " << thread.at.front().x;
            const std::uint32_t part = table_.vertices[first].part;
            EXPECT_EQ(part == static_cast<std::uint32_t>(body::CagePart::FirstDorsal),
                      thread.isOfFirstDorsal);
            first += kSides * (threadSteps(thread) + 1);
        }
    }
}

TEST_P(AttachmentsOf, goWithTheWholeFish) {
    const auto rest = posed(body_.restNodes);
    const auto move = [](glm::vec3 p) {
        return glm::vec3(0.6F * p.x + 0.8F * p.z, p.y, -0.8F * p.x + 0.6F * p.z) +
               glm::vec3(1, -2, 3);
    };
    body::NodalPoints nodes = body_.restNodes;
    for (glm::vec3& node : nodes) node = move(node);
    const auto points = posed(nodes);
    for (std::size_t i = table_.skinVertices; i < points.size(); ++i)
        EXPECT_LT(glm::distance(points[i].position, move(rest[i].position)), 1e-4F) << i;
}

TEST_P(AttachmentsOf, areTheSameAtEveryLevel) {
    const LimitTable coarse = makeLimitTable(body_, 0);
    ASSERT_EQ(coarse.vertices.size() - coarse.skinVertices,
              table_.vertices.size() - table_.skinVertices);
    for (std::size_t i = coarse.skinVertices, j = table_.skinVertices; i < coarse.vertices.size();
         ++i, ++j)
        ASSERT_EQ(coarse.vertices[i].rest, table_.vertices[j].rest);
}

// Of the fin that bears it, a whip passes the ripple on.
TEST(MoorishIdol, whipWavesWithItsFin) {
    const std::string idol = "moorish_idol";
    const auto& [body, table] = madeOf(idol);
    std::vector<glm::vec3> cage(body::kControlPoints);
    body::poseCage(body, body.restNodes, cage);
    const std::size_t tip = table.vertices.size() - 1;
    const glm::vec3 still = skinPoint(table, tip, cage).position;
    EXPECT_NEAR(still.x, -1.31F, 0.01F);
    for (std::size_t i = 0; i < cage.size(); ++i)
        if (body.cage.vertices[i].part == body::CagePart::FirstDorsal)
            cage[i].z += 0.02F * body.cage.vertices[i].fin.y;
    EXPECT_NEAR(skinPoint(table, tip, cage).position.z - still.z, 0.04F, 0.005F);
}

TEST(Trumpetfish, hasTheSpinesOfItsKindAndABarbel) {
    EXPECT_EQ(madeOf("trumpetfish").body.threads.size(), 10U);
}

}  // namespace
}  // namespace aquarama::skin
