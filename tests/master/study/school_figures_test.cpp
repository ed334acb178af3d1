// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "master/study/quantities.h"

namespace aquarama::study {
namespace {

// Fish of half a metre on a ring of radius 1, which swim round it.
fish::FishView ring(std::size_t fish) {
    fish::FishView view;
    view.resize(fish);
    for (std::size_t i = 0; i < fish; ++i) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(fish);
        view.fish[i].position.x = static_cast<float>(std::cos(angle));
        view.fish[i].position.z = static_cast<float>(std::sin(angle));
        view.fish[i].heading.x = -view.fish[i].position.z;
        view.fish[i].heading.z = view.fish[i].position.x;
        view.fish[i].length = 0.5F;
    }
    return view;
}

TEST(SchoolFigures, aMillRotatesAndIsNotPolarised) {
    const SchoolFigures mill = schoolFigures(ring(12), 0, 12);
    EXPECT_NEAR(mill.rotation, 1, 1e-5);
    EXPECT_NEAR(mill.polarisation, 0, 1e-5);
    EXPECT_NEAR(mill.radiusMetres, 1, 1e-5);
    EXPECT_NEAR(mill.nearestNeighbour, 2 * 2 * std::sin(std::numbers::pi / 12), 1e-4);
}

TEST(SchoolFigures, thoseWhoHeadOneWayArePolarisedAndDoNotRotate) {
    fish::FishView view = ring(12);
    for (std::size_t i = 0; i < 12; ++i) {
        view.fish[i].heading.x = 1;
        view.fish[i].heading.z = 0;
    }
    const SchoolFigures school = schoolFigures(view, 0, 12);
    EXPECT_NEAR(school.polarisation, 1, 1e-5);
    EXPECT_NEAR(school.rotation, 0, 1e-5);
}

TEST(SchoolFigures, whoIsAwayDoesNotCount) {
    fish::FishView view = ring(12);
    for (const std::size_t away : {1U, 3U, 5U, 7U, 9U, 11U}) view.signs[away] = fish::kAway;
    EXPECT_NEAR(
        schoolFigures(view, 0, 12).nearestNeighbour, 2 * 2 * std::sin(std::numbers::pi / 6), 1e-4);
}

TEST(Synchrony, isWholeWhereAllBeatAlikeAndFallsWithSegmentsAndPhases) {
    motion::MotionStates states;
    states.resize(4);
    Synchrony all = synchronyOf(states, 0, 4);
    EXPECT_NEAR(all.resultant, 1, 1e-6);
    EXPECT_EQ(all.sameSegment, 1);
    EXPECT_EQ(all.inStep, 1);

    states.phase = {0, 16384, 32768, 49152};
    all = synchronyOf(states, 0, 4);
    EXPECT_NEAR(all.resultant, 0, 1e-6);
    EXPECT_EQ(all.sameSegment, 1);
    EXPECT_EQ(all.inStep, 0);

    states.phase = {0, 65535, 0, 65535};
    states.segment = {0, 0, 1, 1};
    all = synchronyOf(states, 0, 4);
    EXPECT_NEAR(all.sameSegment, 2.0 / 6, 1e-6);
    EXPECT_NEAR(all.inStep, 2.0 / 6, 1e-6) << "the last phase is beside the first";
}

}  // namespace
}  // namespace aquarama::study
