// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "master/study/school_path.h"
#include "master/study/study.h"

namespace aquarama::study {
namespace {

constexpr config::Day kDay{.lengthSeconds = 1200, .startsAt = 0.5, .night = 0.5};

Tick atSecond(double seconds) {
    return {static_cast<std::uint64_t>(seconds * kTicksPerSecond)};
}

TEST(DayPart, dayIsTheHalfOfItsLengthAboutNoon) {
    EXPECT_EQ(dayPartOf(kDay, atSecond(0)), DayPart::Day);
    EXPECT_EQ(dayPartOf(kDay, atSecond(299)), DayPart::Day);
    EXPECT_EQ(dayPartOf(kDay, atSecond(301)), DayPart::Night);
    EXPECT_EQ(dayPartOf(kDay, atSecond(899)), DayPart::Night);
    EXPECT_EQ(dayPartOf(kDay, atSecond(901)), DayPart::Day);
    EXPECT_EQ(dayPartOf({.lengthSeconds = 0, .startsAt = 0}, atSecond(1e4)), DayPart::Night)
        << "stands still";
}

// A second with so many large fish in each third.
WallSecond secondOf(DayPart part, std::array<std::uint32_t, kThirds> large) {
    WallSecond second;
    second.part = part;
    second.glance.large = large;
    return second;
}

WallFigures figuresOf(const std::vector<WallSecond>& seconds,
                      DayPart part,
                      const std::vector<NotedEvent>& events = {}) {
    return wallFiguresOf(seconds, events, kDay, part);
}

TEST(WallFigures, aThirdIsFullWithFiveAndAllThreeOnlyAtOnce) {
    const WallFigures figures = figuresOf({secondOf(DayPart::Day, {5, 4, 5}),
                                           secondOf(DayPart::Day, {5, 5, 4}),
                                           secondOf(DayPart::Day, {5, 5, 5}),
                                           secondOf(DayPart::Day, {0, 9, 5}),
                                           secondOf(DayPart::Night, {5, 5, 5})},
                                          DayPart::Day);
    EXPECT_EQ(figures.seconds, 4U);
    EXPECT_EQ(figures.full[0], 0.75);
    EXPECT_EQ(figures.full[1], 0.75);
    EXPECT_EQ(figures.full[2], 0.75);
    EXPECT_EQ(figures.allFull, 0.25);
}

TEST(WallFigures, theGapIsTheLongestRunOfOneThirdWithinAPartOfTheDay) {
    std::vector<WallSecond> seconds(20, secondOf(DayPart::Day, {1, 1, 0}));
    for (const std::size_t empty : {2U, 3U, 4U, 8U, 9U}) seconds[empty].glance.large[0] = 0;
    for (std::size_t i = 12; i < 20; ++i) seconds[i].part = DayPart::Night;
    const WallFigures day = figuresOf(seconds, DayPart::Day);
    EXPECT_EQ(day.gapSeconds, (std::array<std::uint64_t, kThirds>{3, 0, 12}));
    EXPECT_EQ(figuresOf(seconds, DayPart::Night).gapSeconds[2], 8U);
}

TEST(WallFigures, mediansAndQuantilesAreOfTheSecondsOfThatPart) {
    std::vector<WallSecond> seconds;
    for (int i = 0; i <= 100; ++i) {
        seconds.push_back(secondOf(DayPart::Day, {}));
        seconds.back().glance.cellShare = i / 100.0;
        seconds.back().glance.inView = static_cast<std::uint32_t>(i);
        seconds.push_back(secondOf(DayPart::Night, {}));
    }
    const WallFigures day = figuresOf(seconds, DayPart::Day);
    EXPECT_NEAR(day.cellShare.median, 0.5, 1e-9);
    EXPECT_NEAR(day.cellShare.low, 0.05, 1e-9);
    EXPECT_NEAR(day.meanInView, 50, 1e-9);
    EXPECT_EQ(figuresOf(seconds, DayPart::Night).cellShare.median, 0);
}

TEST(WallFigures, eventsInViewAreCountedAMinuteOfTheirPartOfTheDay) {
    const std::vector<WallSecond> seconds(120, secondOf(DayPart::Day, {}));
    const std::vector<NotedEvent> events{{WallEvent::Flight, atSecond(10), true},
                                         {WallEvent::Flight, atSecond(20), false},
                                         {WallEvent::Chase, atSecond(30), true},
                                         {WallEvent::Flight, atSecond(40), true},
                                         {WallEvent::Flight, atSecond(600), true}};
    const WallFigures day = figuresOf(seconds, DayPart::Day, events);
    EXPECT_NEAR(day.eventsAMinute[0], 1, 1e-9) << "one is out of view, one at night";
    EXPECT_NEAR(day.allEventsAMinute, 1.5, 1e-9);
}

TEST(WallFigures, theLineSaysThemInTheirOrder) {
    WallFigures figures;
    figures.cellShare.median = 0.16;
    figures.full = {0.33, 0.65, 0.32};
    figures.allFull = 0.01;
    figures.gapSeconds = {4, 41, 7};
    figures.largestGroup.median = 0.85;
    figures.species.median = 5;
    figures.allEventsAMinute = 2.25;
    EXPECT_EQ(wallLine(figures),
              "wall: cells 16 %, thirds 33 65 32 %, all 1 %, gap 41 s, largest school 85 %, "
              "species 5, events 2.2 a minute");
}

TEST(SchoolPath, aPathThatRepeatsItselfHasAPeakAtItsPeriod) {
    std::vector<glm::dvec3> path;
    for (int second = 0; second < 1000; ++second) {
        const double turn = 2 * std::numbers::pi * second / 79;
        path.emplace_back(3 * std::sin(turn), -6, std::cos(turn));
    }
    const std::vector<double> correlation = autocorrelationOf(path, 200);
    EXPECT_NEAR(correlation[0], 1, 1e-9);
    EXPECT_NEAR(correlation[39], -1, 0.03);
    const PathPeak peak = highestPeak(correlation);
    EXPECT_NEAR(peak.height, 1, 0.03);
    EXPECT_EQ(peak.firstLag, 79U);
}

TEST(SchoolPath, aPathThatGoesOnOrStaysHasNone) {
    std::vector<glm::dvec3> line;
    for (int second = 0; second < 400; ++second) line.emplace_back(second, 0, 0);
    EXPECT_EQ(highestPeak(autocorrelationOf(line, 200)).height, 0);
    const std::vector<glm::dvec3> still(100, glm::dvec3(1, 2, 3));
    EXPECT_EQ(autocorrelationOf(still, 50)[0], 0);
    EXPECT_EQ(highestPeak(autocorrelationOf(still, 50)).height, 0);
}

TEST(SchoolPath, thePeakIsBeyondTheFirstZeroAndNotAtTheEnd) {
    const std::vector<double> correlation{1, 0.9, 0.95, 0.2, -0.1, 0.3, 0.1, 0.2, 0.1, 0.6};
    const PathPeak peak = highestPeak(correlation);
    EXPECT_EQ(peak.lag, 5U);
    EXPECT_EQ(peak.height, 0.3);
    EXPECT_EQ(peak.firstLag, 5U);
}

TEST(SchoolPath, peaksOfKnownPeriodsAreLeftOut) {
    const std::vector<double> correlation{1, -0.1, 0.2, 0.1, 0.5, 0.1, 0.2, 0.1, 0.55, 0.1};
    constexpr std::array<std::size_t, 1> kFour{4};
    EXPECT_EQ(highestPeak(correlation, kFour).height, 0.2);
    constexpr std::array<std::size_t, 1> kSeven{7};
    EXPECT_EQ(highestPeak(correlation, kSeven, 1).lag, 4U);
    EXPECT_EQ(highestPeak(correlation, kSeven, 0).lag, 8U);
}

// At multiples of a period the path is as much like itself: the period is the shortest of them.
TEST(SchoolPath, thePeriodIsTheFirstPeakNearlyAsHighAsTheHighest) {
    const std::vector<double> correlation{1, -0.1, 0.2, 0.1, 0.5, 0.1, 0.2, 0.1, 0.55, 0.1};
    const PathPeak peak = highestPeak(correlation);
    EXPECT_EQ(peak.lag, 8U);
    EXPECT_EQ(peak.firstLag, 4U);
}

// Half a minute of the scene of the routine school, with its real fish.
TEST(WallStudy, itWatchesASceneEverySecondAndChangesNothing) {
    const Scenario scenario =
        readScenario(AQUARAMA_SOURCE_DIR "/config/scenes/routines/school.txtpb");
    const config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
    world::World world(scenario.world);
    world::World unwatched(scenario.world);
    WallStudy study(rig, world);
    for (int tick = 0; tick < 30 * 60; ++tick) {
        world.advance();
        unwatched.advance();
        study.note(world);
    }
    EXPECT_EQ(world.hash(), unwatched.hash());
    ASSERT_EQ(study.seconds().size(), 30U);
    const DayPart part = study.seconds().front().part;
    EXPECT_GT(study.figures(part).inView.median, 0);
    const SpeciesFigures school = study.species(part).front();
    EXPECT_GT(school.nearestNeighbour.median, 0);
    double shares = 0;
    for (const double share : school.occupationShare) shares += share;
    EXPECT_NEAR(shares, 1, 1e-9);
    EXPECT_GT(school.swims, 0.9);
    EXPECT_FALSE(school.atHome) << "it lives at no site";
    const auto lines = [](const std::string& csv) { return std::ranges::count(csv, '\n'); };
    EXPECT_EQ(lines(secondsCsv(study)), 31);
    EXPECT_EQ(lines(eventsCsv(study)), 1 + static_cast<std::ptrdiff_t>(kWallEvents));
    EXPECT_EQ(lines(wallSpeciesCsv(study, world, scenario.world.cast)),
              1 + 2 * static_cast<std::ptrdiff_t>(scenario.world.cast.size()));
}

}  // namespace
}  // namespace aquarama::study
