// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "common/body/fins.h"
#include "tests/support/all_species.h"

namespace aquarama::body {
namespace {

constexpr float kDegree = glm::pi<float>() / 180;
constexpr float kCruise = 0.8F;  // body lengths a second: between standing and hurry
constexpr FinPose kRaised{.open = 0.7F, .stroke = 0.4F, .twist = -0.5F};

class FinsOf : public testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] glm::vec3 offset(std::size_t point,
                                   const FinDrive& drive,
                                   float drift = 0) const {
        return finOffset(body_.fins, point, drive, drift);
    }
    [[nodiscard]] std::vector<std::size_t> pointsOf(CagePart part) const {
        std::vector<std::size_t> points;
        for (std::size_t i = 0; i < body_.cage.vertices.size(); ++i)
            if (body_.cage.vertices[i].part == part) points.push_back(i);
        return points;
    }
    // The point of the other side.
    [[nodiscard]] std::size_t mirrored(std::size_t point) const {
        const glm::vec3 image = body_.cage.vertices[point].rest * glm::vec3(1, 1, -1);
        const auto distance = [&](const CageVertex& v) { return glm::distance(v.rest, image); };
        const auto found = std::ranges::min_element(body_.cage.vertices, {}, distance);
        return static_cast<std::size_t>(found - body_.cage.vertices.begin());
    }
    // Where the tip of the right pectoral fin's middle ray is, from the fin's root.
    [[nodiscard]] glm::vec3 tip(const FinDrive& drive) const {
        glm::vec3 sum{};
        float count = 0;
        for (const std::size_t i : pointsOf(CagePart::Pectoral)) {
            const FinPoint& point = body_.fins.points[i];
            if (point.side < 0 || point.q < 1 || point.p != 0.5F) continue;
            sum += point.arm + offset(i, drive);
            ++count;
        }
        return sum / count;
    }

    const config::Species species_ = test::castMember(GetParam());
    const FishBody body_ = makeBody(species_);
    const config::Rowing& rowing_ = species_.finMotion.rowing;
    const FinStyle& style_ = body_.fins.style;
};

INSTANTIATE_TEST_SUITE_P(Cast,
                         FinsOf,
                         testing::ValuesIn(test::allSpeciesNames()),
                         [](const auto& name) { return name.param; });

TEST_P(FinsOf, leaveTheBodyAndTheirRootsAlone) {
    const FinDrive drive{
        .seconds = 3.3F, .speed = 0.1F, .left = kRaised, .right = kRaised, .phase = 0.3F};
    for (const std::size_t i : pointsOf(CagePart::Body))
        EXPECT_EQ(offset(i, drive, 0.1F), glm::vec3(0));
}

TEST_P(FinsOf, areMirrorImagesInTheSamePose) {
    const FinDrive drive{.seconds = 5.17F, .left = kRaised, .right = kRaised, .id = 4};
    for (const std::size_t i : pointsOf(CagePart::Pectoral)) {
        const glm::vec3 image = offset(mirrored(i), drive) * glm::vec3(1, 1, -1);
        EXPECT_LT(glm::distance(offset(i, drive), image), 1e-4F) << i;
    }
}

TEST_P(FinsOf, strokeThroughTheAngleOfTheirPoses) {
    const auto across = [&](float stroke) {
        const glm::vec3 arm = tip({.right = {.open = kRaised.open, .stroke = stroke}});
        return glm::normalize(arm - glm::dot(arm, style_.stroke) * style_.stroke);
    };
    for (const float stroke : {0.1F, 0.5F, 0.9F})
        EXPECT_NEAR(std::acos(glm::dot(across(stroke), across(-stroke))), 2 * stroke, 4 * kDegree);
}

TEST_P(FinsOf, lieFlatOnTheFlankWhenFolded) {
    if (!rowing_.rows()) return;  // a shark's do not
    const PectoralFin fin = pectoralFinOf(species_);
    const glm::vec3 root = glm::cross(style_.hinge, glm::vec3(0, 0, 1));  // along the flank
    const glm::vec3 arm = tip({.right = {.open = fin.folded}});
    EXPECT_LT(std::abs(std::atan2(arm.z, -glm::dot(arm, root))), 9 * kDegree);
}

// Straight out from the flank, against the water, however fast the fish is.
TEST_P(FinsOf, standAcrossTheWaterAndStillWhileTheFishBrakes) {
    if (!rowing_.rows()) return;  // a shark's are planes
    const glm::vec3 root = glm::cross(style_.hinge, glm::vec3(0, 0, 1));
    const glm::vec3 arm = tip({.seconds = 1.3F, .spread = 1});
    const float off = std::atan2(arm.z, -glm::dot(arm, root));
    EXPECT_GT(off, 63 * kDegree);
    EXPECT_LT(off, 120 * kDegree);
    const glm::vec3 later = tip({.seconds = 1.45F, .spread = 1, .right = kRaised});
    EXPECT_LT(glm::distance(arm, later), 1e-5F);
}

// A fish whose right side is high twists one fin up and the other down.
TEST_P(FinsOf, twistAgainstEachOtherOnATiltedFish) {
    ASSERT_NE(style_.trim, 0);
    const float twist = std::min(0.2F * kTrimGain, 1.0F) * style_.trim;
    const FinDrive tilted{.tilt = 0.2F};
    const FinDrive twisted{.left = {.twist = twist}, .right = {.twist = -twist}};
    for (const std::size_t i : pointsOf(CagePart::Pectoral))
        EXPECT_LT(glm::distance(offset(i, tilted), offset(i, twisted)), 1e-6F) << i;
}

TEST_P(FinsOf, keepTheirLength) {
    const FinDrive drive{
        .seconds = 2.71F, .speed = kCruise, .left = kRaised, .right = kRaised, .id = 2};
    for (const std::size_t i : pointsOf(CagePart::Pectoral)) {
        const FinPoint& point = body_.fins.points[i];
        const glm::vec3 moved = point.arm + offset(i, drive) * glm::vec3(1, 1, point.side);
        EXPECT_NEAR(glm::length(moved), glm::length(point.arm), 1e-5F);
    }
}

// The margins of median fins swing to either side by what the file states, and their roots do not.
TEST_P(FinsOf, rippleByTheAmplitudeThatTheFileStates) {
    struct Case {
        float speed, amplitude;
    };
    const config::FinMotion& motion = species_.finMotion;
    for (const auto& [speed, amplitude] :
         {Case{0, motion.hovering.amplitude}, Case{2, motion.swimming.amplitude}})
        for (const std::size_t i : pointsOf(CagePart::Anal)) {
            float most = 0;
            for (int k = 0; k < 40; ++k) {
                const float cycle = static_cast<float>(k) / 40;
                const float seconds =
                    motion.hovering.beatHertz > 0 ? cycle / motion.hovering.beatHertz : 0;
                const glm::vec3 off =
                    offset(i, {.seconds = seconds, .speed = speed, .phase = cycle});
                EXPECT_EQ(glm::vec2(off), glm::vec2(0));
                most = std::max(most, std::abs(off.z));
            }
            EXPECT_NEAR(most, amplitude * body_.fins.points[i].sway, 1e-4F);
        }
}

TEST_P(FinsOf, dorsalAndAnalOfATrumpetfishGoAgainstEachOther) {
    if (!species_.finMotion.hovering.isOpposed) return;
    FinTable table = body_.fins;
    FinPoint one{.p = 0.4F, .q = 1, .sway = 1, .part = static_cast<std::uint32_t>(CagePart::Anal)};
    FinPoint other = one;
    other.part = static_cast<std::uint32_t>(CagePart::SecondDorsal);
    table.points = {one, other};
    for (const float seconds : {0.0F, 0.11F, 0.3F})
        EXPECT_NEAR(finOffset(table, 0, {.seconds = seconds}, 0).z,
                    -finOffset(table, 1, {.seconds = seconds}, 0).z,
                    1e-4F);
}

// The margins of the tail lead its middle, so that it cups against the water.
TEST_P(FinsOf, tailCupsAgainstItsDrift) {
    for (const std::size_t i : pointsOf(CagePart::Caudal)) {
        const FinPoint& point = body_.fins.points[i];
        const float here = offset(i, {}, 0.1F).z;
        EXPECT_FLOAT_EQ(offset(i, {}, -0.1F).z, -here);
        if (point.q == 1 && (point.p == 0 || point.p == 1)) {
            EXPECT_GT(here, 0);
        }
        if (point.q == 1 && std::abs(point.p - 0.5F) < 0.15F) {
            EXPECT_LT(here, 0);
        }
    }
}

// In a thousandth of a second nothing jumps: neither with time, nor with speed, nor while one
// segment takes over from another.
TEST_P(FinsOf, moveWithoutAJump) {
    const auto driveAt = [](float t) {
        return FinDrive{.seconds = 4 + t,
                        .speed = -1 + 4 * t,
                        .tilt = 0.3F - 0.6F * t,
                        .spread = t < 0.5F ? 2 * t : 2 - 2 * t,
                        .left = {.open = t, .stroke = 0.5F * t, .twist = -t},
                        .right = {.open = 1 - t, .twist = t},
                        .id = 3,
                        .phase = std::fmod(0.2F + 3 * t, 1.0F),
                        .fromPhase = 0.7F,
                        .weight = t};
    };
    for (int step = 0; step < 1000; ++step) {
        const float t = static_cast<float>(step) / 1000;
        for (const CagePart part : {CagePart::Pectoral, CagePart::Pelvic, CagePart::Anal})
            for (const std::size_t i : pointsOf(part))
                ASSERT_LT(glm::distance(offset(i, driveAt(t)), offset(i, driveAt(t + 0.001F))),
                          0.012F)
                    << i << " at " << t;
    }
}

// So that time may begin anew there.
TEST_P(FinsOf, areAfterTenSecondsWhereTheyWere) {
    for (std::size_t i = 0; i < body_.fins.points.size(); ++i)
        ASSERT_LT(glm::distance(offset(i, {.seconds = 0.3F, .speed = 0.1F, .id = 5}),
                                offset(i, {.seconds = kFinSeconds + 0.3F, .speed = 0.1F, .id = 5})),
                  2e-4F);
}

TEST_P(FinsOf, headingsAreThoseOfTheBody) {
    std::vector<float> headings(kControlPoints);
    NodalPoints nodes = body_.restNodes;
    headingsOf(body_, nodes, headings);
    for (const float heading : headings) EXPECT_NEAR(heading, 0, 1e-5F);
    const float angle = 0.4F;
    for (glm::vec3& node : nodes) node = -turned(node * glm::vec3(1, -1, -1), angle);
    headingsOf(body_, nodes, headings);
    for (const float heading : headings) EXPECT_NEAR(heading, angle, 1e-4F);
}

}  // namespace
}  // namespace aquarama::body
