// SPDX-License-Identifier: Apache-2.0
// Turns of all captured species by their entries: the motor takes the path that was captured at the
// speed and the phase of the beat of its fish, and follows it.
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/common/motion/captured_species.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

class Turns : public OfEachSpecies {};
INSTANTIATE_TEST_SUITE_P(All, Turns, testing::ValuesIn(allSpeciesNames()), OfEachSpecies::suffix);

constexpr std::array kTurnActions{Action::TurnLeftGradual,
                                  Action::TurnLeftSharp,
                                  Action::TurnRightGradual,
                                  Action::TurnRightSharp};

// Medium swimming at a phase of the beat, with the speed of an entry.
School swimming(const MotorTables& tables, std::size_t entry, float speed) {
    School school(1, tables);
    school.play(0, Action::ForwardMedium);
    school.states.phase[0] =
        static_cast<std::uint16_t>(entry % kEntryPhases * (65536 / kEntryPhases));
    setSpeedBodyLengths(school.states, 0, speed);
    return school;
}

// Where a captured turn leads, as seen from the course before it: place, body lengths, and heading,
// degrees, of the course after it.
struct End {
    glm::dvec3 place{};
    double heading = 0;
};
End endOf(const TurnPath& path) {
    glm::dquat rotation(1, 0, 0, 0);
    glm::dvec3 place{};
    for (const FrameIncrement& step : path.increments) {
        place += rotation * glm::dvec3(step.translation);
        rotation = rotation * glm::dquat(step.rotation);
    }
    const glm::dvec3 ahead(path.courseBefore);
    const glm::dvec3 right(-ahead.z, 0, ahead.x);
    const glm::dvec3 after = rotation * glm::dvec3(path.courseAfter);
    return {{glm::dot(place, ahead), 0, glm::dot(place, right)},
            std::atan2(-glm::dot(after, right), glm::dot(after, ahead)) / kDegree};
}

TEST_P(Turns, leadWhereTheSimulatedFishGotFromTheSameSpeedAndPhase) {
    const MotorTables& tables = tablesOf(GetParam());
    for (const Action turn : kTurnActions) {
        const ActionSegment& recorded = repertoireOf(GetParam()).segments[indexOf(turn)];
        ASSERT_EQ(recorded.entered.size(), std::size_t{kTurnEntries});
        for (std::size_t entry = 0; entry < kTurnEntries; ++entry) {
            const TurnPath& path = recorded.entered[entry];
            School school = swimming(tables, entry, path.speedBefore);
            const double course = school.heading(0);
            school.command(0, turn);
            school.tick();
            ASSERT_EQ(school.states.segment[0], firstSegmentOf(turn) + 1 + entry);
            school.tick(65535 / recordedPhaseRate(tables, turn) - 1);
            ASSERT_EQ(school.states.segment[0], firstSegmentOf(turn) + 1 + entry)
                << "its last tick";
            const End end = endOf(path);
            const glm::dquat back = glm::angleAxis(-course * kDegree, glm::dvec3(0, 1, 0));
            const glm::dvec3 place = back * school.place(0) / 0.2;  // fish of 0.2 m
            // It ends within the last tick.
            const double tick = static_cast<double>(path.speedAfter) / 60;
            EXPECT_LT(glm::distance(place, end.place), tick + 0.01) << nameOf(turn) << " " << entry;
            EXPECT_NEAR(std::remainder(school.heading(0) - course, 360), end.heading, 1)
                << nameOf(turn) << " " << entry;
        }
    }
}

TEST_P(Turns, toTheRightAreTheMirrorImagesHalfABeatLater) {
    const auto& segments = repertoireOf(GetParam()).segments;
    for (const auto& [left, right] : {std::pair{kTurnActions[0], kTurnActions[2]},
                                      std::pair{kTurnActions[1], kTurnActions[3]}}) {
        for (std::size_t entry = 0; entry < kTurnEntries; ++entry) {
            const std::size_t later =
                entry / kEntryPhases * kEntryPhases + (entry + kEntryPhases / 2) % kEntryPhases;
            const End l = endOf(segments[indexOf(left)].entered[entry]);
            const End r = endOf(segments[indexOf(right)].entered[later]);
            EXPECT_NEAR(l.heading, -r.heading, 1e-3);
            EXPECT_NEAR(l.place.x, r.place.x, 1e-5);
            EXPECT_NEAR(l.place.z, -r.place.z, 1e-5);
        }
    }
}

TEST_P(Turns, goFurtherTheFasterTheyAreEntered) {
    for (const Action turn : kTurnActions) {
        const auto& entered = repertoireOf(GetParam()).segments[indexOf(turn)].entered;
        double last = 0;
        for (std::size_t speed = 0; speed < kEntrySpeeds; ++speed) {
            double way = 0;
            for (std::size_t phase = 0; phase < kEntryPhases; ++phase)
                way += glm::length(endOf(entered[speed * kEntryPhases + phase]).place);
            EXPECT_GT(way, last) << nameOf(turn);
            last = way;
        }
    }
}

TEST_P(Turns, outOfAGlideAreTheTypicalOne) {
    const MotorTables& tables = tablesOf(GetParam());
    School school(1, tables);
    school.play(0, Action::Glide);
    school.command(0, Action::TurnRightGradual);
    school.tick();
    EXPECT_EQ(school.states.segment[0], firstSegmentOf(Action::TurnRightGradual));
}

TEST_P(Turns, aSharpOneIsBrokenOffForASharpOneToTheOtherSideOnly) {
    const MotorTables& tables = tablesOf(GetParam());
    for (const Action turn : kTurnActions) {
        for (const Action next : kTurnActions) {
            School school(1, tables);
            school.play(0, Action::ForwardMedium);
            school.command(0, turn);
            school.tick(65535 / recordedPhaseRate(tables, turn) / 2);
            school.command(0, next);
            school.tick();
            const bool breaks = isSharp(turn) && isSharp(next) && isLeft(turn) != isLeft(next);
            EXPECT_EQ(actionOf(school.states.segment[0]), breaks ? next : turn);
        }
    }
}

}  // namespace
}  // namespace aquarama::motion
