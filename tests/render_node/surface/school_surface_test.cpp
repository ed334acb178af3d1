// SPDX-License-Identifier: Apache-2.0
// Where the GPU puts the vertices of fish.
#include "render_node/surface/school_surface.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render_node/surface/living_cage.h"
#include "tests/render_node/surface/surface_fixture.h"
#include "tests/support/all_species.h"

namespace aquarama::surface {
namespace {

class SchoolSurfaceTest : public test::SurfaceTest {
  protected:
    // On the CPU: eq. 13, then the stencils that limit_table_test holds against OpenSubdiv's
    // refinement.
    [[nodiscard]] std::vector<glm::vec3> expectedPositions(const motion::PresentedFish& fish,
                                                           DetailLevel level) const {
        std::vector<glm::vec3> cage(body::kControlPoints);
        test::livingCage(body_, repertoire_, fish, test::kSeconds, cage);
        const skin::LimitTable table = skin::makeLimitTable(
            body_, static_cast<int>(level) - static_cast<int>(DetailLevel::ControlMesh));
        std::vector<glm::vec3> positions(table.vertices.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            for (std::uint32_t k = table.firstEntry[i]; k < table.firstEntry[i + 1]; ++k)
                positions[i] += table.entries[k].position * cage[table.entries[k].controlPoint];
        }
        return positions;
    }

    static float largestDistance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
        float largest = a.size() == b.size() ? 0.0F : INFINITY;
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, glm::distance(a[i], b.at(i)));
        return largest;
    }
};

// Far enough into its level that nothing is left of the coarser one.
TEST_F(SchoolSurfaceTest, everyLevelLiesWhereTheCpuPutsIt) {
    std::mt19937 random{7};
    std::uniform_int_distribution<unsigned> bits;
    const std::vector<motion::FishTraits> traits{{.id = 3, .lengthMillimetres = 240}};
    SchoolSurface surface = surfaceFor(traits, {.finest = DetailLevel::CloseUp});
    for (int trial = 0; trial < 32; ++trial) {
        const auto level = static_cast<DetailLevel>(3 + trial % 4);
        const float pixels = 1.5F * detailLimits(1.0F).at(std::size_t(level));
        const glm::vec3 place{0, 0, -0.24F / (0.0016F * std::max(pixels, 30.0F))};
        motion::FishRecord record = test::recordOf(test::fishAt(place, test::anyRotation(random)));
        record.phase = static_cast<std::uint16_t>(bits(random));
        record.fromPhase = static_cast<std::uint16_t>(bits(random));
        record.segment = static_cast<std::uint8_t>(trial % motion::kSegments);
        record.speedAndSpread =
            motion::packedSpeedAndSpread(static_cast<std::int32_t>(bits(random) % 500000U),
                                         static_cast<std::uint8_t>(bits(random)));
        record.fromSegment = static_cast<std::uint8_t>(trial % 3);
        record.warpLength = trial % 2 == 0 ? 0 : 9;
        record.warpFrame = static_cast<std::uint8_t>(trial % (record.warpLength + 1));
        surface.update({.before = {}, .after = {&record, 1}});
        surface.look(clip_, {});
        ASSERT_EQ(surface.counts().atLevel.at(std::size_t(level)), 1U) << trial;
        evaluate(surface);
        const auto expected =
            expectedPositions(motion::present(record, record, 1.0F, traits[0]), level);
        EXPECT_LT(largestDistance(surfacePositions(expected.size()), expected), 1e-4F * 0.24F)
            << "level " << static_cast<int>(level);
    }
}

// Fins that row, flutter and ripple: of each species the GPU's are those of the reference.
TEST_F(SchoolSurfaceTest, everySpeciesMovesItsFinsAndItsFaceAsTheCpuDoes) {
    std::vector<SchoolSpecies> cast;
    std::vector<motion::PresentedFish> fish;
    for (const std::string& name : test::allSpeciesNames()) {
        const body::FishBody body = body::makeBody(test::castMember(name));
        motion::PresentedFish one = test::fishAt({0, 0, -1}, {1, 0, 0, 0});
        one.id = static_cast<std::uint32_t>(fish.size());
        one.speed = 0.25F * static_cast<float>(fish.size());
        one.spread = 0.2F * static_cast<float>(fish.size() % 6);
        one.mouth = 0.25F * static_cast<float>(fish.size() % 5);
        one.phase = 0.625F;
        one.action = static_cast<std::uint32_t>(fish.size());
        fish.push_back(one);
        cast.push_back({body, {}, test::swaying(body, 0.12F), {test::traitsOf(one)}});
    }
    const test::RecordedSchool recorded{fish};
    SchoolSurface surface{
        cast, SurfaceOptions{.culling = false, .levelsOfDetail = false}, programs()};
    surface.update(recorded.moment());
    surface.look(clip_, {});
    evaluate(surface);
    std::size_t first = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const skin::LimitTable table = skin::makeLimitTable(cast[i].body, 2);
        const motion::PresentedFish shown =
            motion::present(recorded.records[i], recorded.records[i], 1.0F, cast[i].fish[0]);
        std::vector<glm::vec3> cage(body::kControlPoints), expected;
        test::livingCage(cast[i].body, cast[i].repertoire, shown, test::kSeconds, cage);
        for (std::size_t v = 0; v < table.vertices.size(); ++v) {
            glm::vec3& place = expected.emplace_back(0.0F);
            for (std::uint32_t k = table.firstEntry[v]; k < table.firstEntry[v + 1]; ++k)
                place += table.entries[k].position * cage[table.entries[k].controlPoint];
        }
        EXPECT_LT(largestDistance(surfacePositions(expected.size(), first), expected),
                  2e-4F * shown.lengthMetres)
            << test::allSpeciesNames().at(i);
        first += expected.size();
    }
}

TEST_F(SchoolSurfaceTest, noFishInSightIsCulled) {
    std::mt19937 random{11};
    std::uniform_real_distribution<float> unit{-1.0F, 1.0F};
    std::vector<motion::PresentedFish> school;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 place{2 * unit(random), 2 * unit(random), -1.2F + 1.5F * unit(random)};
        motion::PresentedFish fish = test::fishAt(place, test::anyRotation(random));
        fish.phase = 0.5F + 0.49F * unit(random);
        fish.spread = static_cast<float>(i % 2);
        fish.action = static_cast<std::uint32_t>(i % motion::kActions);
        fish.id = static_cast<std::uint32_t>(i);
        school.push_back(fish);
    }
    const test::RecordedSchool recorded{school};
    SchoolSurface surface = surfaceFor(recorded.traits);
    surface.update(recorded.moment());
    surface.look(clip_, {});
    std::vector<bool> isDrawn(school.size());
    for (const DrawnFish& fish : drawn(surface)) isDrawn.at(fish.id) = true;
    std::vector<glm::vec3> points(body::kControlPoints);
    std::size_t inSight = 0;
    for (std::size_t i = 0; i < school.size(); ++i) {
        test::livingCage(body_, repertoire_, school[i], test::kSeconds, points);
        const bool isInSight = std::ranges::any_of(points, [&](glm::vec3 point) {
            const glm::vec4 clip = clip_ * glm::vec4(point, 1);
            return std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z > 0 &&
                   clip.z < clip.w;
        });
        inSight += isInSight ? 1 : 0;
        ASSERT_TRUE(isDrawn[i] || !isInSight) << i;
    }
    EXPECT_GT(inSight, 200U);  // else the test would have proved nothing
    EXPECT_LT(surface.counts().visible, school.size() - 200);
}

// The surfaces of a school that does not fit in a page go on in the next one.
TEST_F(SchoolSurfaceTest, aSchoolThatDoesNotFitInAPageGoesOnInTheNext) {
    const std::size_t vertices = skin::makeLimitTable(body_, 2).vertices.size();
    constexpr std::size_t kRoomFor = 5;
    std::vector<motion::PresentedFish> school;
    for (std::size_t i = 0; i < kRoomFor + 2; ++i) {
        school.push_back(
            test::fishAt({0, 0, -3.0F + 0.002F * static_cast<float>(i)}, {1, 0, 0, 0}));
        school.back().id = static_cast<std::uint32_t>(i);
    }
    const test::RecordedSchool recorded{school};
    SchoolSurface surface = surfaceFor(
        recorded.traits,
        {.culling = false, .levelsOfDetail = false, .pageBytes = kRoomFor * vertices * 16});
    surface.update(recorded.moment());
    surface.look(clip_, {});
    EXPECT_EQ(surface.counts().visible, school.size());
    EXPECT_EQ(surface.counts().withoutRoom, 0U);
    evaluate(surface);
    const auto expect = [&](std::size_t place, std::size_t fish) {
        EXPECT_LT(largestDistance(surfacePositions(vertices, place * vertices),
                                  expectedPositions(school[fish], DetailLevel::Hero)),
                  1e-4F * school[fish].lengthMetres);
    };
    // The page that was bound last is the second one.
    expect(0, kRoomFor);
    expect(1, kRoomFor + 1);
}

TEST_F(SchoolSurfaceTest, fishForWhichNoPageHasRoomAreCounted) {
    const std::size_t vertices = skin::makeLimitTable(body_, 2).vertices.size();
    constexpr std::size_t kRoomFor = 5;
    constexpr std::size_t kTooMany = 3;
    std::vector<motion::PresentedFish> school;
    for (std::uint32_t i = 0; i < kMostPages * kRoomFor + kTooMany; ++i) {
        school.push_back(test::fishAt({0, 0, -3}, {1, 0, 0, 0}));
        school.back().id = i;
    }
    const test::RecordedSchool recorded{school};
    SchoolSurface surface = surfaceFor(
        recorded.traits,
        {.culling = false, .levelsOfDetail = false, .pageBytes = kRoomFor * vertices * 16});
    surface.update(recorded.moment());
    surface.look(clip_, {});
    EXPECT_EQ(surface.counts().visible, school.size());
    EXPECT_EQ(surface.counts().withoutRoom, kTooMany);
}

TEST_F(SchoolSurfaceTest, anEmptySeaIsDrawnWithoutError) {
    const std::vector<motion::FishTraits> traits{{.id = 3, .lengthMillimetres = 240}};
    SchoolSurface surface = surfaceFor(traits);
    surface.update({});
    surface.look(clip_, {});
    evaluate(surface);
    EXPECT_EQ(surface.counts().visible, 0U);
    SchoolSurface nobody = surfaceFor({});
    nobody.update({});
    nobody.look(clip_, {});
    evaluate(nobody);
}

// Its skin is computed from nodal points, which are rounded to 16 bits as the control points are.
TEST_F(SchoolSurfaceTest, aSegmentWithoutControlPointsIsDrawnAllTheSame) {
    motion::Repertoire bare = repertoire_;
    bare.segments[2].controlPoints.clear();
    motion::PresentedFish fish = test::fishAt({0, 0, -1}, {1, 0, 0, 0});
    fish.action = 2;
    fish.phase = 0.5F;
    const test::RecordedSchool recorded{{&fish, 1}};
    const std::vector<SchoolSpecies> cast{{body_, {}, bare, recorded.traits}};
    SchoolSurface surface{cast, {.culling = false, .levelsOfDetail = false}, programs()};
    surface.update(recorded.moment());
    surface.look(clip_, {});
    evaluate(surface);
    const auto expected = expectedPositions(fish, DetailLevel::Hero);
    EXPECT_LT(largestDistance(surfacePositions(expected.size()), expected),
              2e-4F * fish.lengthMetres);
}

}  // namespace
}  // namespace aquarama::surface
