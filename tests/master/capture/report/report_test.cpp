// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "master/capture/measure/course.h"
#include "master/capture/report/closure.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/gait_figures.h"
#include "master/capture/report/inspect.h"
#include "master/capture/report/tables.h"
#include "tests/support/scad.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::size_t countOf(const std::string& words, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++count;
    return count;
}

// As it is read from a file of a species whose control points are not recorded.
Repertoire withoutControlPoints() {
    Repertoire repertoire = scadRepertoire();
    for (ActionSegment& segment : repertoire.segments) segment.controlPoints.clear();
    return repertoire;
}

// A swimmer of which everything is known: no tail beat, a speed and a turn in each cycle.
ActionSegment evenSegment(float periodSeconds, float stride, float turnRadians) {
    ActionSegment segment;
    segment.periodSeconds = periodSeconds;
    const float half = turnRadians / kPhases / 2;
    segment.increments.fill({{std::cos(half), 0, std::sin(half), 0}, {stride / kPhases, 0, 0}});
    return segment;
}

TEST(Report, isOnePageWithAllItsPicturesInside) {
    for (const Repertoire& repertoire : {scadRepertoire(), withoutControlPoints()}) {
        const std::string page = reportPage(repertoire);
        EXPECT_EQ(countOf("<svg ", page), kCapturedActions + kGaits + 5);
        EXPECT_EQ(countOf("</svg>", page), countOf("<svg ", page));
        EXPECT_EQ(countOf("<figure", page), countOf("</figure>", page));
        EXPECT_EQ(page.find("src="), std::string::npos) << "something lies outside";
        for (const char* nonsense : {"nan", "inf\"", "inf<", "(null)"})
            EXPECT_EQ(page.find(nonsense), std::string::npos) << nonsense;
        EXPECT_NE(page.find(repertoire.species.substr(1, 5)), std::string::npos);
        for (int i = 0; i < kCapturedActions; ++i)
            EXPECT_NE(page.find(nameOf(static_cast<Action>(i))), std::string::npos);
        EXPECT_EQ(page.find(">glide<"), std::string::npos) << "a glide is derived, not captured";
    }
}

TEST(Report, isWrittenUnderTheNameOfTheSpecies) {
    const fs::path folder = fs::path(testing::TempDir()) / "aquarama_report";
    const fs::path page = writeReport(scadRepertoire(), folder);
    EXPECT_EQ(page.filename(), "bigeye_scad.html");
    EXPECT_EQ(contentOf(page), reportPage(scadRepertoire()));
    fs::remove_all(folder);
}

TEST(Inspect, listsTheSevenCapturedSegmentsAndWhatTheFileHolds) {
    Repertoire repertoire = withoutControlPoints();
    repertoire.response = {.swimDrag = {0.25F, 0.75F, 1.25F}, .glideDrag = 0.5F, .brakeRate = 3.0F};
    const auto bytes = encodeRepertoire(repertoire);
    const std::string text = inspectRepertoire(bytes, "a file");
    for (int i = 0; i < kCapturedActions; ++i)
        EXPECT_EQ(countOf(std::string("\n  ") + nameOf(static_cast<Action>(i)), text), 1U);
    EXPECT_EQ(text.find("\n  glide"), std::string::npos);
    EXPECT_NE(text.find("control points not recorded"), std::string::npos);
    EXPECT_NE(text.find("0.500 gliding, 0.250, 0.750, 1.250 more"), std::string::npos);
    EXPECT_NE(text.find("format version " + std::to_string(formatVersionOf(bytes))),
              std::string::npos);
}

TEST(SpeedLine, goesThroughGaitsThatLieOnOne) {
    Repertoire repertoire = scadRepertoire();
    // 0.6 f - 0.2 at 2, 3 and 5 Hz.
    repertoire.segments[0] = evenSegment(1 / 2.0F, 1.0F / 2, 0);
    repertoire.segments[1] = evenSegment(1 / 3.0F, 1.6F / 3, 0);
    repertoire.segments[2] = evenSegment(1 / 5.0F, 2.8F / 5, 0);
    const SpeedLine line = fitSpeed(repertoire);
    EXPECT_NEAR(line.slope, 0.6, 1e-5);
    EXPECT_NEAR(line.intercept, -0.2, 1e-5);
    EXPECT_NEAR(line.rSquared, 1, 1e-6);
}

TEST(Turn, radiusIsThatOfTheCircleItGoesRound) {
    const float turn = 0.5F;
    const float radius = 1.5F;
    ActionSegment segment = evenSegment(1, radius * turn, turn);
    EXPECT_NEAR(turnRadius(segment), 1.5, 0.01);
    EXPECT_NEAR(peakTurnRate(segment), 0.5, 1e-3);
}

TEST(Drift, aStraightCycleHasNoneAndATwistedOneAsMuchAsItIsRepeated) {
    const Drift none = driftAfter(evenSegment(1, 0.5F, 0), 100);
    EXPECT_NEAR(none.headingRadians, 0, 1e-9);
    EXPECT_NEAR(none.leanRadians, 0, 1e-6);
    EXPECT_NEAR(none.climb, 0, 1e-9);
    EXPECT_NEAR(driftAfter(evenSegment(1, 0.5F, 0.01F), 100).headingRadians, 1, 1e-3);
    ActionSegment turn = evenSegment(1, 0.5F, 1);
    turn.playsToEnd = true;
    EXPECT_NEAR(driftAfter(turn, 100).headingRadians, 0, 1e-6) << "beyond its own hundred turns";
}

TEST(Seam, isSeenWhereACycleDoesNotClose) {
    ActionSegment segment = segmentOf(Action::ForwardMedium);
    EXPECT_LT(seamOf(segment).atTheJoin, 0.001);
    // The nose slides to the left and jumps back.
    for (std::size_t k = 0; k < kPhases; ++k)
        segment.nodes[k][0][2] = static_cast<std::int16_t>(-50 * static_cast<int>(k));
    EXPECT_GT(seamOf(segment).atTheJoin, 0.01);
    EXPECT_LT(seamOf(segment).elsewhere, 0.001);
}

TEST(FishView, aLeftTurnBendsTheTailToTheLeftOfThePaper) {
    const ActionSegment& turn = segmentOf(Action::TurnLeftSharp);
    const auto phases = replayAlongX(turn, 1);
    const FishView start = viewFromAbove(turn, phases.front(), 0);
    const auto reach = [](const FishView& view) {
        return std::ranges::max(view.outline, {}, &glm::dvec2::x).x -
               std::ranges::min(view.outline, {}, &glm::dvec2::x).x;
    };
    EXPECT_NEAR(reach(start), 0.92, 0.05) << "to the fork of the tail";
    // Up on the paper is to the left of a fish that heads to the right.
    EXPECT_LT(viewFromAbove(turn, phases.back(), kPhases).outline.front().y, -0.5);
}

TEST(FishView, withoutControlPointsFollowsTheNodalPoints) {
    const Repertoire bare = withoutControlPoints();
    const auto medium = static_cast<std::size_t>(Action::ForwardMedium);
    const ActionSegment& segment = bare.segments.at(medium);
    const auto phases = replayAlongX(segment, 1);
    const FishView view = viewFromAbove(segment, phases[0], 0);
    EXPECT_EQ(view.outline.front(), fromAbove(phases[0].nodes[0]));
    EXPECT_TRUE(view.pectorals.empty());
    const FishView skin = viewFromAbove(scadRepertoire().segments.at(medium), phases[0], 0);
    EXPECT_EQ(skin.midline, view.midline);
    EXPECT_EQ(skin.pectorals.size(), 2U);
}

}  // namespace
}  // namespace aquarama
