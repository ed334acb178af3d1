// SPDX-License-Identifier: Apache-2.0
// Mouths open, gill covers lift, and fish breathe.
#include "common/body/face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/body/cage.h"
#include "common/body/fin_motion.h"
#include "tests/support/all_species.h"

namespace aquarama::body {
namespace {

constexpr std::array kSizes{0.05F, 0.1F, 0.3F, 1.3F};  // metres

class FaceOf : public testing::TestWithParam<std::string> {
  protected:
    // (s, y, z) of all control points.
    [[nodiscard]] std::vector<glm::vec3> posed(FacePose pose) const {
        std::vector<glm::vec3> points;
        for (std::size_t i = 0; i < body_.cage.vertices.size(); ++i) {
            const CageVertex& vertex = body_.cage.vertices[i];
            const bool isBody = vertex.part == CagePart::Body;
            points.push_back(
                vertex.rest +
                (isBody ? faceOffset(body_.fins.style, body_.fins.points[i], pose) : glm::vec3(0)));
        }
        return points;
    }
    [[nodiscard]] glm::vec3 normalOf(const std::vector<glm::vec3>& points, std::size_t face) const {
        const auto& corners = body_.cage.faces[face];
        return glm::cross(points[corners[2]] - points[corners[0]],
                          points[corners[3]] - points[corners[1]]);
    }
    // Whether a face is of the skin, neither inside the mouth nor at its lips.
    [[nodiscard]] bool isSkin(std::size_t face) const {
        return std::ranges::all_of(body_.cage.faces[face], [&](std::uint16_t corner) {
            return body_.cage.vertices[corner].mouth == 0;
        });
    }
    // Of ring 0; column 0 is in the middle of the upper lip, 6 of the lower.
    [[nodiscard]] static float gapeBetween(const std::vector<glm::vec3>& points,
                                           int upper,
                                           int lower) {
        return glm::distance(points[static_cast<std::size_t>(upper)],
                             points[static_cast<std::size_t>(lower)]);
    }

    const config::Species species_ = test::castMember(GetParam());
    const FishBody body_ = makeBody(species_);
};

INSTANTIATE_TEST_SUITE_P(Cast,
                         FaceOf,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& name) { return name.param; });

TEST_P(FaceOf, atRestIsTheCageItself) {
    const std::vector<glm::vec3> points = posed({});
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(points[i], body_.cage.vertices[i].rest) << i;
}

TEST_P(FaceOf, hasLipsThatMeetAndOpenFromTheFront) {
    const std::vector<glm::vec3> shut = posed({}), open = posed({.mouth = 1});
    const float jaw = glm::distance(species_.mouth.front, species_.mouth.joint);
    for (const auto& [upper, lower] : {std::pair{0, 7}, {1, 6}, {2, 5}, {3, 4}, {11, 8}, {10, 9}})
        EXPECT_LT(gapeBetween(shut, upper, lower), species_.mouth.lip) << upper;
    const float wide = gapeBetween(open, 0, 7);
    EXPECT_GT(wide, 0.8F * std::sin(species_.mouth.gapeRadians) * jaw);
    EXPECT_LT(gapeBetween(open, 3, 4), 0.5F * wide) << "the corner hardly opens";
    EXPECT_GT(gapeBetween(posed({.mouth = 0.5F}), 0, 7), 0.35F * wide);
}

// Every point goes its way evenly: no jump between two breaths or two frames.
TEST_P(FaceOf, opensEvenly) {
    constexpr int kSteps = 50;
    const float most =
        1.2F / kSteps * (species_.mouth.gapeRadians * 0.2F + species_.mouth.protrusion + 0.002F);
    std::vector<glm::vec3> before = posed({});
    for (int step = 1; step <= kSteps; ++step) {
        const std::vector<glm::vec3> now =
            posed({.mouth = static_cast<float>(step) / kSteps, .gill = 0});
        for (std::size_t i = 0; i < now.size(); ++i)
            ASSERT_LT(glm::distance(now[i], before[i]), most) << i;
        before = now;
    }
}

TEST_P(FaceOf, foldsNoSkinAndStretchesItLittle) {
    const std::vector<glm::vec3> rest = posed({});
    for (const FacePose pose : {FacePose{.mouth = 0.5F, .gill = 0.5F}, {.mouth = 1, .gill = 1}}) {
        const std::vector<glm::vec3> points = posed(pose);
        for (std::size_t f = 0; f < body_.cage.faces.size(); ++f) {
            if (!isSkin(f)) continue;
            EXPECT_GT(glm::dot(normalOf(points, f), normalOf(rest, f)), 0) << f;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto a = body_.cage.faces[f][k], b = body_.cage.faces[f][(k + 1) % 4];
                const float stretch =
                    glm::distance(points[a], points[b]) / glm::distance(rest[a], rest[b]);
                EXPECT_GT(stretch, 0.4F) << a << '-' << b;
                EXPECT_LT(stretch, 2.0F) << a << '-' << b;
            }
        }
    }
}

TEST_P(FaceOf, leavesEyesAndFinsInTheirPlace) {
    const std::vector<glm::vec3> open = posed({.mouth = 1, .gill = 0});
    for (std::size_t i = 0; i < open.size(); ++i) {
        const glm::vec3 rest = body_.cage.vertices[i].rest;
        if (rest.x > species_.mouth.joint.x) {
            EXPECT_EQ(open[i], rest) << i;
        }
    }
    const std::vector<glm::vec3> lifted = posed({.mouth = 0, .gill = 1});
    for (std::size_t i = 0; i < lifted.size(); ++i) {
        const glm::vec3 rest = body_.cage.vertices[i].rest;
        if (rest.x > species_.gill.s + 0.012F) {
            EXPECT_EQ(lifted[i], rest) << i;
        }
    }
}

TEST_P(FaceOf, liftsBothGillCoversOutwards) {
    const std::vector<glm::vec3> lifted = posed({.mouth = 0, .gill = 1});
    float right = 0, left = 0;
    for (std::size_t i = 0; i < lifted.size(); ++i) {
        const glm::vec3 rest = body_.cage.vertices[i].rest;
        const float out = lifted[i].z - rest.z;
        EXPECT_GE(out * rest.z, 0) << i;
        right = std::max(right, out);
        left = std::min(left, out);
    }
    EXPECT_GT(right, 0.4F * species_.gill.flare);
    EXPECT_LE(right, species_.gill.flare + 1e-6F);
    EXPECT_NEAR(left, -right, 1e-6F);
}

// Whole tenths of a hertz: then time may restart after ten seconds (kFinSeconds).
TEST(Breath, isSlowerTheLargerTheFishAndOfWholeTenths) {
    float before = kMostBreathHertz + 1;
    for (const float metres : kSizes) {
        const float hertz = breathHertz(metres);
        EXPECT_LT(hertz, before) << metres;
        EXPECT_NEAR(10 * hertz, std::round(10 * hertz), 1e-4F);
        before = hertz;
    }
    EXPECT_NEAR(breathHertz(0.1F), 1.4F, 0.35F);
    EXPECT_NEAR(breathHertz(1.3F), 0.5F, 0.15F);
}

// The least and the most of a pose over one period of the breath.
struct Range {
    float least = 1, most = 0;
};
Range mouthOver(float metres, float speed, float spread, float mouth) {
    Range range;
    for (int i = 0; i < 1000; ++i) {
        const FacePose pose = facePose({.seconds = 0.01F * static_cast<float>(i),
                                        .lengthMetres = metres,
                                        .speed = speed,
                                        .spread = spread,
                                        .mouth = mouth,
                                        .id = 5});
        range.least = std::min(range.least, pose.mouth);
        range.most = std::max(range.most, pose.mouth);
        EXPECT_GE(pose.gill, 0);
        EXPECT_LE(pose.gill, 1);
    }
    return range;
}

TEST(Breath, isDeepAtRestAndFlatAtSpeed) {
    for (const float metres : kSizes) {
        const Range rests = mouthOver(metres, 0, 0, 0), swims = mouthOver(metres, 3, 0, 0);
        EXPECT_NEAR(rests.least, 0, 1e-3F);
        EXPECT_NEAR(rests.most, kRestingBreath, 1e-3F);
        EXPECT_NEAR(swims.most, kSwimmingBreath, 1e-3F);
        EXPECT_NEAR(mouthOver(metres, 3, 1, 0).most, kRestingBreath, 1e-3F) << "fins held out";
        EXPECT_NEAR(mouthOver(metres, 0, 0, 1).least, 1, 1e-6F) << "wide open it stays so";
        EXPECT_GE(mouthOver(metres, 0, 0, 0.5F).least, 0.5F);
    }
}

TEST(Breath, goesOnOverTheRestartOfTimeAndDiffersFromFishToFish) {
    const auto at = [](float seconds, std::uint32_t id) {
        return facePose({.seconds = seconds, .lengthMetres = 0.2F, .id = id}).mouth;
    };
    EXPECT_NEAR(at(0, 3), at(kFinSeconds, 3), 1e-4F);
    EXPECT_NEAR(at(0.37F, 3), at(0.37F + 1 / breathHertz(0.2F), 3), 1e-4F);
    EXPECT_GT(std::abs(at(1, 3) - at(1, 4)), 0.01F);
}

}  // namespace
}  // namespace aquarama::body
