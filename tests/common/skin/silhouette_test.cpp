// SPDX-License-Identifier: Apache-2.0
// The skin, as it is drawn, against the proportions that field guides give.
#include <algorithm>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/skin/limit_table.h"
#include "tests/support/all_species.h"

namespace aquarama::skin {
namespace {

struct Range {
    float least, most;
};

// Vertices of the limit surface at rest, by the part of the fish.
class Drawn {
  public:
    explicit Drawn(const std::string& name) : body{body::makeBody(test::castMember(name))} {
        std::vector<glm::vec3> cage(body::kControlPoints);
        body::poseCage(body, body.restNodes, cage);
        const LimitTable table = makeLimitTable(body, 2);
        for (std::size_t i = 0; i < table.skinVertices; ++i)
            places_.push_back(skinPoint(table, i, cage).position);
        parts_.resize(places_.size(), body::CagePart::Body);
        // A triangle's part is that of its last vertex.
        for (std::size_t t = table.bodyIndices; t < table.indices.size(); t += 3)
            for (std::size_t k = 0; k < 3; ++k)
                if (table.indices[t + k] < table.skinVertices)
                    parts_[table.indices[t + k]] =
                        static_cast<body::CagePart>(table.vertices[table.indices[t + 2]].part);
    }
    [[nodiscard]] Range along(int axis, body::CagePart part) const {
        Range range{1e9F, -1e9F};
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (parts_[i] != part) continue;
            range.least = std::min(range.least, places_[i][axis]);
            range.most = std::max(range.most, places_[i][axis]);
        }
        return range;
    }
    [[nodiscard]] float depth() const {
        const Range up = along(1, body::CagePart::Body);
        return up.most - up.least;
    }
    [[nodiscard]] float standardLength() const { return body.profileStations.back(); }
    const body::FishBody body;

  private:
    std::vector<glm::vec3> places_;
    std::vector<body::CagePart> parts_;
};

void expectWithin(float value, Range range) {
    EXPECT_GE(value, range.least);
    EXPECT_LE(value, range.most);
}

// Depths in standard length: FishBase's field guide, Randall's FAO guide.
TEST(Silhouette, bodiesAreAsDeepAsTheirSpecies) {
    const Drawn clownfish("clownfish"), idol("moorish_idol"), tang("blue_tang");
    expectWithin(clownfish.standardLength() / clownfish.depth(), {2.1F, 2.5F});
    expectWithin(idol.standardLength() / idol.depth(), {1.0F, 1.45F});
    expectWithin(tang.standardLength() / tang.depth(), {1.9F, 2.3F});
}

// Compagno's proportions: first dorsal 8 to 11.4 % of the length high, eye 2 to 3 %.
TEST(Silhouette, aSharkHasTheFinsAndTheEyeOfItsKind) {
    const Drawn shark("blacktip_reef_shark");
    const float back = shark.along(1, body::CagePart::Body).most;
    expectWithin(shark.along(1, body::CagePart::FirstDorsal).most - back, {0.075F, 0.114F});
    expectWithin(2 * shark.body.face.eye.z, {0.02F, 0.03F});
    EXPECT_GT(shark.along(1, body::CagePart::Caudal).most,
              -shark.along(1, body::CagePart::Caudal).least)
        << "the upper lobe of its tail is the longer";
}

TEST(Silhouette, aMoorishIdolsWhipIsLongerThanItsBody) {
    const Drawn idol("moorish_idol");
    ASSERT_EQ(idol.body.threads.size(), 1U);
    const auto& at = idol.body.threads[0].at;
    float length = 0;
    for (std::size_t k = 1; k < at.size(); ++k) length += glm::distance(at[k - 1], at[k]);
    EXPECT_GT(length, idol.standardLength());
}

// A fish is wide as well as high: seen from the front none of them is a card.
TEST(Silhouette, everyBodyHasItsWidth) {
    for (const std::string& name : test::allSpeciesNames()) {
        const Drawn fish(name);
        const Range across = fish.along(2, body::CagePart::Body);
        const float widest = 2 * *std::ranges::max_element(fish.body.profileHalfWidth);
        EXPECT_NEAR((across.most - across.least) / widest, 1, 0.08F) << name;
    }
}

}  // namespace
}  // namespace aquarama::skin
