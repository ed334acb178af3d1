// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture/measure.h"
#include "capture/report/report_data.h"
#include "capture/report/segment_figures.h"
#include "capture/report/silhouette.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

bool hasNull(const json& data) {
    if (!data.is_structured()) return data.is_null();
    return std::ranges::any_of(data, hasNull);
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

TEST(Report, holdsTheDataOfAllItsPictures) {
    for (const motion::Repertoire& repertoire : {test::scadRepertoire(), withoutControlPoints()}) {
        const json data = json::parse(reportData(repertoire));
        const bool hasSkin = !repertoire.segments[0].controlPoints.empty();
        EXPECT_EQ(data["species"], repertoire.species);
        EXPECT_FALSE(hasNull(data)) << "what is not a number has no JSON";
        EXPECT_EQ(data["body"]["nodes"].size(), std::size_t{body::kNodalPoints});
        EXPECT_EQ(data["body"]["springs"].size(), 79U);
        EXPECT_EQ(data["body"]["muscles"].size(), 12U);
        EXPECT_EQ(data["body"]["skin"].size(), hasSkin ? std::size_t{body::kControlPoints} : 0U);
        EXPECT_EQ(data["body"]["faces"].empty(), !hasSkin);
        EXPECT_EQ(data["file"]["bytes"], motion::encodeRepertoire(repertoire).size());
        ASSERT_EQ(data["segments"].size(), std::size_t{19})
            << "a glide is derived; slopes, rowing and fast starts are not seen from above";
        for (std::size_t i = 0; i < data["segments"].size(); ++i) {
            const json& segment = data["segments"][i];
            EXPECT_EQ(segment["name"],
                      motion::nameOf(static_cast<motion::Action>(i < 15 ? i : i + 12)));
            EXPECT_EQ(segment["frames"].size(), motion::kPhases + 1);
            EXPECT_EQ(segment["views"].size(), 8U);
            EXPECT_EQ(segment["views"].back()["phase"], motion::kPhases);
            EXPECT_EQ(segment.contains("midlines"), i < kGaits);
            EXPECT_EQ(segment.contains("turn_degrees"), i >= kGaits);
        }
    }
}

TEST(Report, tellsWhatIsMeasured) {
    const motion::Repertoire& repertoire = test::scadRepertoire();
    const json data = json::parse(reportData(repertoire));
    const json& medium = data["segments"][1];
    const capture::SegmentMeasures m = capture::measure(repertoire.segments[1]);
    EXPECT_EQ(medium["speed"], m.speedBodyLengths);
    EXPECT_EQ(medium["strouhal"], m.strouhal);
    EXPECT_EQ(medium["seam_at_the_join"], seamOf(repertoire.segments[1]).atTheJoin);
    EXPECT_EQ(data["segments"][4]["radius"], turnRadius(repertoire.segments[4]));
    EXPECT_EQ(data["speed_line"]["slope"], fitSpeed(repertoire).slope);
    const double nose = medium["views"][0]["midline"][0][0];
    EXPECT_NEAR(nose, 0.385, 0.03) << "before the body frame's origin";
}

TEST(Report, isWrittenUnderTheNameOfTheSpecies) {
    const fs::path folder = fs::path(testing::TempDir()) / "aquarama_report";
    const fs::path file = writeReport(test::scadRepertoire(), folder);
    EXPECT_EQ(file.filename(), "bigeye_scad.json");
    EXPECT_EQ(contentOf(file), reportData(test::scadRepertoire()));
    fs::remove_all(folder);
}

TEST(Controllers, eachOfTheNineHasATrial) {
    const json data = json::parse(controllersData(test::scad()));
    EXPECT_FALSE(hasNull(data));
    ASSERT_EQ(data["trials"].size(), 9U);
    for (const json& trial : data["trials"]) {
        EXPECT_EQ(trial["seconds"].size(), std::size_t{kMoments + 1});
        EXPECT_EQ(trial["way"].size(), trial["seconds"].size());
        for (const json& fish : trial["fish"]) EXPECT_EQ(fish["fins"].size(), 2U);
    }
    const auto turnOf = [&](std::size_t trial) {
        const json& heading = data["trials"][trial]["heading_degrees"];
        return heading.back().get<double>() - heading.front().get<double>();
    };
    EXPECT_GT(turnOf(1), 30) << "the left turn";
    EXPECT_NEAR(turnOf(2), -turnOf(1), 3) << "the right turn is its mirror image";
}

TEST(Inspect, listsTheCapturedSegmentsAndWhatTheFileHolds) {
    motion::Repertoire repertoire = withoutControlPoints();
    repertoire.response = {.swimDrag = {0.25F, 0.75F, 1.25F},
                           .retreatDrag = 4.0F,
                           .glideDrag = 0.5F,
                           .brakeRate = 3.0F};
    const auto bytes = motion::encodeRepertoire(repertoire);
    const std::string text = inspectRepertoire(bytes, "a file");
    for (int i = 0; i < motion::kCapturedActions; ++i)
        EXPECT_EQ(
            countOf(std::string("\n  ") + motion::nameOf(static_cast<motion::Action>(i)), text),
            1U);
    EXPECT_EQ(text.find("\n  glide"), std::string::npos);
    EXPECT_NE(text.find("control points not recorded"), std::string::npos);
    EXPECT_NE(text.find("0.250, 0.750, 1.250 swimming, 4.000 retreating, 0.500 gliding"),
              std::string::npos);
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
    const Drift none = driftAfter(evenSegment(1, 0.5F, 0), false, 100);
    EXPECT_NEAR(none.headingRadians, 0, 1e-9);
    EXPECT_NEAR(none.leanRadians, 0, 1e-6);
    EXPECT_NEAR(none.climb, 0, 1e-9);
    EXPECT_NEAR(driftAfter(evenSegment(1, 0.5F, 0.01F), false, 100).headingRadians, 1, 1e-4);
    motion::ActionSegment turn = evenSegment(1, 0.5F, 1);
    turn.playsToEnd = true;
    EXPECT_NEAR(driftAfter(turn, true, 100).headingRadians, 0, 1e-6)
        << "beyond its own hundred turns";
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
