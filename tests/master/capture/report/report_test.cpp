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

namespace aquarama::report {
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
motion::Repertoire withoutControlPoints() {
    motion::Repertoire repertoire = test::scadRepertoire();
    for (motion::ActionSegment& segment : repertoire.segments) segment.controlPoints.clear();
    return repertoire;
}

// A swimmer of which everything is known: no tail beat, a speed and a turn in each cycle.
motion::ActionSegment evenSegment(float periodSeconds, float stride, float turnRadians) {
    motion::ActionSegment segment;
    segment.periodSeconds = periodSeconds;
    const float half = turnRadians / motion::kPhases / 2;
    segment.increments.fill(
        {{std::cos(half), 0, std::sin(half), 0}, {stride / motion::kPhases, 0, 0}});
    return segment;
}

TEST(Report, isOnePageWithAllItsPicturesInside) {
    for (const motion::Repertoire& repertoire : {test::scadRepertoire(), withoutControlPoints()}) {
        const std::string page = reportPage(repertoire);
        EXPECT_EQ(countOf("<svg ", page), motion::kCapturedActions + kGaits + 5);
        EXPECT_EQ(countOf("</svg>", page), countOf("<svg ", page));
        EXPECT_EQ(countOf("<figure", page), countOf("</figure>", page));
        EXPECT_EQ(page.find("src="), std::string::npos) << "something lies outside";
        for (const char* nonsense : {"nan", "inf\"", "inf<", "(null)"})
            EXPECT_EQ(page.find(nonsense), std::string::npos) << nonsense;
        EXPECT_NE(page.find(repertoire.species.substr(1, 5)), std::string::npos);
        for (int i = 0; i < motion::kCapturedActions; ++i)
            EXPECT_NE(page.find(motion::nameOf(static_cast<motion::Action>(i))), std::string::npos);
        EXPECT_EQ(page.find(">glide<"), std::string::npos) << "a glide is derived, not captured";
    }
}

TEST(Report, isWrittenUnderTheNameOfTheSpecies) {
    const fs::path folder = fs::path(testing::TempDir()) / "aquarama_report";
    const fs::path page = writeReport(test::scadRepertoire(), folder);
    EXPECT_EQ(page.filename(), "bigeye_scad.html");
    EXPECT_EQ(contentOf(page), reportPage(test::scadRepertoire()));
    fs::remove_all(folder);
}

TEST(Inspect, listsTheSevenCapturedSegmentsAndWhatTheFileHolds) {
    motion::Repertoire repertoire = withoutControlPoints();
    repertoire.response = {.swimDrag = {0.25F, 0.75F, 1.25F}, .glideDrag = 0.5F, .brakeRate = 3.0F};
    const auto bytes = motion::encodeRepertoire(repertoire);
    const std::string text = inspectRepertoire(bytes, "a file");
    for (int i = 0; i < motion::kCapturedActions; ++i)
        EXPECT_EQ(
            countOf(std::string("\n  ") + motion::nameOf(static_cast<motion::Action>(i)), text),
            1U);
    EXPECT_EQ(text.find("\n  glide"), std::string::npos);
    EXPECT_NE(text.find("control points not recorded"), std::string::npos);
    EXPECT_NE(text.find("0.250, 0.750, 1.250 swimming, 0.500 gliding"), std::string::npos);
    EXPECT_NE(text.find("format version " + std::to_string(formatVersionOf(bytes))),
              std::string::npos);
}

TEST(SpeedLine, goesThroughGaitsThatLieOnOne) {
    motion::Repertoire repertoire = test::scadRepertoire();
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
    motion::ActionSegment segment = evenSegment(1, radius * turn, turn);
    EXPECT_NEAR(turnRadius(segment), 1.5, 0.01);
    EXPECT_NEAR(peakTurnRate(segment), 0.5, 1e-3);
}

TEST(Drift, aStraightCycleHasNoneAndATwistedOneAsMuchAsItIsRepeated) {
    const Drift none = driftAfter(evenSegment(1, 0.5F, 0), 100);
    EXPECT_NEAR(none.headingRadians, 0, 1e-9);
    EXPECT_NEAR(none.leanRadians, 0, 1e-6);
    EXPECT_NEAR(none.climb, 0, 1e-9);
    EXPECT_NEAR(driftAfter(evenSegment(1, 0.5F, 0.01F), 100).headingRadians, 1, 1e-3);
    motion::ActionSegment turn = evenSegment(1, 0.5F, 1);
    turn.playsToEnd = true;
    EXPECT_NEAR(driftAfter(turn, 100).headingRadians, 0, 1e-6) << "beyond its own hundred turns";
}

TEST(Seam, isSeenWhereACycleDoesNotClose) {
    motion::ActionSegment segment = test::segmentOf(motion::Action::ForwardMedium);
    EXPECT_LT(seamOf(segment).atTheJoin, 0.001);
    // The nose slides to the left and jumps back.
    for (std::size_t k = 0; k < motion::kPhases; ++k)
        segment.nodes[k][0][2] = static_cast<std::int16_t>(-50 * static_cast<int>(k));
    EXPECT_GT(seamOf(segment).atTheJoin, 0.01);
    EXPECT_LT(seamOf(segment).elsewhere, 0.001);
}

TEST(FishOutline, aLeftTurnBendsTheTailToTheLeftOfThePaper) {
    const motion::ActionSegment& turn = test::segmentOf(motion::Action::TurnLeftSharp);
    const auto phases = capture::replayAlongX(turn, 1);
    const FishOutline start = viewFromAbove(turn, phases.front(), 0);
    const auto reach = [](const FishOutline& view) {
        return std::ranges::max(view.outline, {}, &glm::dvec2::x).x -
               std::ranges::min(view.outline, {}, &glm::dvec2::x).x;
    };
    EXPECT_NEAR(reach(start), 0.92, 0.05) << "to the fork of the tail";
    // Up on the paper is to the left of a fish that heads to the right.
    EXPECT_LT(viewFromAbove(turn, phases.back(), motion::kPhases).outline.front().y, -0.5);
}

TEST(FishOutline, withoutControlPointsFollowsTheNodalPoints) {
    const motion::Repertoire bare = withoutControlPoints();
    const auto medium = static_cast<std::size_t>(motion::Action::ForwardMedium);
    const motion::ActionSegment& segment = bare.segments.at(medium);
    const auto phases = capture::replayAlongX(segment, 1);
    const FishOutline view = viewFromAbove(segment, phases[0], 0);
    EXPECT_EQ(view.outline.front(), fromAbove(phases[0].nodes[0]));
    EXPECT_TRUE(view.pectorals.empty());
    const FishOutline skin =
        viewFromAbove(test::scadRepertoire().segments.at(medium), phases[0], 0);
    EXPECT_EQ(skin.midline, view.midline);
    EXPECT_EQ(skin.pectorals.size(), 2U);
}

}  // namespace
}  // namespace aquarama::report
