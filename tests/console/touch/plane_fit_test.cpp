// SPDX-License-Identifier: Apache-2.0
// The plane of a tracker from three marks: any affine map is found again, and doubtful ones are
// told.
#include "console/touch/plane_fit.h"

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "console/cues/tracked_place.h"

namespace aquarama::console {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

// A rectangle of 4 x 2 m, 3 m before the eye.
config::TouchedSurface rectangle() {
    config::TouchedSurface surface;
    surface.topLeft = {-2, 1, -3};
    surface.topRight = {2, 1, -3};
    surface.bottomLeft = {-2, -1, -3};
    return surface;
}

// Where the tracker of a surface sees its own points.
SeenMarks seenBy(const config::TouchedSurface& surface,
                 glm::dvec2 one = {0.2, 0.3},
                 glm::dvec2 two = {0.8, 0.3},
                 glm::dvec2 three = {0.2, 0.9}) {
    return {{{pointAt(surface, one), one},
             {pointAt(surface, two), two},
             {pointAt(surface, three), three}}};
}

std::vector<std::string> findingsOn(const config::TouchedSurface& surface,
                                    const SeenMarks& marks = seenBy(rectangle())) {
    std::vector<std::string> texts;
    for (const PlaneFinding& finding : findingsOf(surface, marks, glm::dvec3(0))) {
        EXPECT_EQ(finding.isDoubt, finding.text.starts_with("doubtful: "));
        texts.push_back(finding.text);
    }
    return texts;
}

std::string refusalOf(const SeenMarks& marks) {
    config::TouchedSurface fitted;
    try {
        fitCorners(marks, fitted);
    } catch (const Error& problem) {
        return problem.what();
    }
    return "";
}

double crossLength(glm::dvec3 a, glm::dvec3 b) {
    return glm::length(glm::cross(a, b));
}
double crossLength(glm::dvec2 a, glm::dvec2 b) {
    return std::abs(a.x * b.y - a.y * b.x);
}

// Whether the three sides are long, and no angle is near to none.
template <class Place>
bool isFarApart(Place a, Place b, Place c) {
    const double ab = glm::length(b - a), ac = glm::length(c - a), bc = glm::length(c - b);
    const double twice = crossLength(b - a, c - a);
    return std::min({ab, ac, bc}) > 0.1 && twice > 0.15 * std::max({ab * ac, ab * bc, ac * bc});
}

// By marks anywhere on it, also of a skewed or mirrored one.
TEST(PlaneFit, anyAffineMapIsFoundAgain) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1), metres(-5, 5);
    int fitted = 0;
    for (int i = 0; i < 20'000; ++i) {
        config::TouchedSurface truth, found;
        for (glm::dvec3* corner : {&truth.topLeft, &truth.topRight, &truth.bottomLeft})
            *corner = {metres(random), metres(random), metres(random)};
        const glm::dvec2 a(share(random), share(random)), b(share(random), share(random)),
            c(share(random), share(random));
        const SeenMarks marks = seenBy(truth, a, b, c);
        if (!isFarApart(a, b, c) || !isFarApart(marks[0].point, marks[1].point, marks[2].point))
            continue;
        ++fitted;
        fitCorners(marks, found);
        ASSERT_LT(glm::length(found.topLeft - truth.topLeft), 1e-9);
        ASSERT_LT(glm::length(found.topRight - truth.topRight), 1e-9);
        ASSERT_LT(glm::length(found.bottomLeft - truth.bottomLeft), 1e-9);
    }
    EXPECT_GT(fitted, 1000);
}

TEST(PlaneFit, marksOnOneLineOrInOnePlaceAreRefused) {
    const config::TouchedSurface surface = rectangle();
    EXPECT_EQ(refusalOf(seenBy(surface)), "");
    EXPECT_THAT(refusalOf(seenBy(surface, {0.2, 0.2}, {0.8, 0.8}, {0.5, 0.52})),
                HasSubstr("lie nearly on one line"));
    EXPECT_THAT(refusalOf(seenBy(surface, {0.2, 0.2}, {0.8, 0.2}, {0.22, 0.21})),
                HasSubstr("are nearly one place"));
    SeenMarks sameShares = seenBy(surface);
    for (SeenMark& mark : sameShares) mark.share = {mark.share.x, 0.5};
    EXPECT_THAT(refusalOf(sameShares), HasSubstr("the three places that were seen"));
    SeenMarks samePoints = seenBy(surface);
    for (SeenMark& mark : samePoints) mark.point.y = 0;
    EXPECT_THAT(refusalOf(samePoints), HasSubstr("the three marks"));
}

TEST(PlaneFit, aRectangleIsToldWithItsSizeAndNoDoubt) {
    const auto findings = findingsOn(rectangle());
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_THAT(findings.front(),
                AllOf(HasSubstr("4.00 x 2.00 m"), HasSubstr("90 degrees"), HasSubstr("cm")));
}

TEST(PlaneFit, aMirroredPictureIsToldAndIsNoDoubt) {
    config::TouchedSurface mirrored = rectangle();
    std::swap(mirrored.topLeft.x, mirrored.topRight.x);
    mirrored.bottomLeft.x = mirrored.topLeft.x;
    const auto findings = findingsOn(mirrored);
    ASSERT_THAT(findings, SizeIs(2));
    EXPECT_THAT(findings.back(), AllOf(HasSubstr("mirrored"), Not(HasSubstr("doubtful"))));
    config::TouchedSurface turned = rectangle();  // hangs upside down: no mirror
    turned.topLeft = {2, -1, -3};
    turned.topRight = {-2, -1, -3};
    turned.bottomLeft = {2, 1, -3};
    EXPECT_THAT(findingsOn(turned), SizeIs(1));
}

// From above: to the right, and towards the audience.
TEST(PlaneFit, aFloorIsSeenFromAbove) {
    config::TouchedSurface floor;
    floor.peopleReachMetres = 2;
    floor.topLeft = {-2, -1.6, -3};
    floor.topRight = {2, -1.6, -3};
    floor.bottomLeft = {-2, -1.6, 0};
    EXPECT_THAT(findingsOn(floor), SizeIs(1));
    std::swap(floor.topLeft, floor.bottomLeft);
    floor.topRight.z = 0;
    EXPECT_THAT(findingsOn(floor), testing::Contains(HasSubstr("mirrored")));
}

TEST(PlaneFit, skewAndSizeAndSmallMarksAreDoubtful) {
    config::TouchedSurface skewed = rectangle();
    skewed.bottomLeft.x = 0;
    EXPECT_THAT(findingsOn(skewed), testing::Contains(HasSubstr("sides make 90 degrees")));
    config::TouchedSurface narrow = rectangle();
    narrow.topRight.x = -1.9;
    EXPECT_THAT(findingsOn(narrow), testing::Contains(HasSubstr("of that size")));
    const SeenMarks small = seenBy(rectangle(), {0.4, 0.4}, {0.55, 0.4}, {0.4, 0.55});
    EXPECT_THAT(findingsOn(rectangle(), small), testing::Contains(HasSubstr("a small part")));
    EXPECT_GT(worstOfACorner(small), worstOfACorner(seenBy(rectangle())));
}

TEST(PlaneFit, aMarkAtTheEdgeIsDoubtful) {
    const SeenMarks cut = seenBy(rectangle(), {0, 0.3}, {0.8, 0.3}, {0.2, 0.9});
    EXPECT_THAT(findingsOn(rectangle(), cut), testing::Contains(HasSubstr("at the edge")));
}

// Three marks at three corners: who is a metre beside each puts the fourth off by sqrt 3.
TEST(PlaneFit, theWorstCornerIsTheOneThatNoMarkIsAt) {
    EXPECT_NEAR(worstOfACorner(seenBy(rectangle(), {0, 0}, {1, 0}, {0, 1})), std::sqrt(3), 1e-12);
}

}  // namespace
}  // namespace aquarama::console
