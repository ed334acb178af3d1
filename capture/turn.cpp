// SPDX-License-Identifier: Apache-2.0
#include "capture/turn.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "capture/dynamics.h"
#include "capture/motor_controllers.h"
#include "common/base/log.h"

namespace aquarama::capture {

namespace {

constexpr double kLongestTurn = 4;  // the fish's own seconds; a bend takes 1.45 at a tempo of 1

// The greatest distance of a nodal point from its place in the straight fish, body lengths. `pose`
// is in the world, `straight` in the body frame.
double bendOf(const NodeVectors& pose, const NodeVectors& straight) {
    const NodeVectors bent = inBodyFrame(pose);
    double most = 0;
    for (std::size_t i = 0; i < bent.size(); ++i)
        most = std::max(most, glm::distance(bent.at(i), straight.at(i)));
    return most;
}

// The turn begun at phase i * kPhases / kOnsets is at index i.
std::array<RecordedCycle, kOnsets> recordLeftTurns(const config::Species& species,
                                                   const SteadySwimming& entry,
                                                   const config::Bend& bend) {
    std::array<RecordedCycle, kOnsets> turns;
    for (int i = 0; i < kOnsets; ++i)
        turns.at(static_cast<std::size_t>(i)) =
            recordTurn(species, entry, Controller::LeftTurn, bend, i * motion::kPhases / kOnsets);
    return turns;
}

TurnSpread spreadOf(const std::array<RecordedCycle, kOnsets>& turns,
                    motion::Action turn,
                    motion::Action entry) {
    TurnSpread spread{.turn = turn, .entry = entry};
    std::ranges::transform(turns, spread.radians.begin(), turnRadians);
    return spread;
}

}  // namespace

double TurnSpread::least() const {
    return std::ranges::min(radians);
}
double TurnSpread::mean() const {
    return std::accumulate(radians.begin(), radians.end(), 0.0) / kOnsets;
}
double TurnSpread::most() const {
    return std::ranges::max(radians);
}

RecordedCycle recordTurn(const config::Species& species,
                         const SteadySwimming& entry,
                         Controller leftOrRight,
                         const config::Bend& bend,
                         int onsetPhase) {
    assert(leftOrRight == Controller::LeftTurn || leftOrRight == Controller::RightTurn);
    assert(onsetPhase >= 0);
    assert(onsetPhase < motion::kPhases);
    Swimmer swimmer = entry.swimmer;
    swimmer.advance(onsetPhase * entry.stepsPerPhase);
    swimmer.give({.controller = leftOrRight, .bend = bend, .bankRadians = kBankRadians});

    // Every step is recorded until the turn is over and the number of steps is a multiple of
    // kPhases.
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const NodeVectors straight = inBodyFrame(fish.restPositions);
    const double muscleSteps = secondsOf(bend, species) / swimmer.stepSeconds();
    const double mostSteps = kLongestTurn / fish.timeScale / swimmer.stepSeconds();
    std::vector<NodeVectors> poses{swimmer.state().positions};
    std::vector<std::array<glm::dvec3, 2>> fins{swimmer.fins()};
    while (static_cast<double>(poses.size()) < muscleSteps ||
           (poses.size() - 1) % motion::kPhases != 0 ||
           bendOf(poses.back(), straight) > kStraightBodyLengths) {
        if (static_cast<double>(poses.size()) > mostSteps)
            throw Error(species.name +
                        ": after a turn the fish does not become straight; "
                        "change `turn` or `tissue` in its species file");
        swimmer.advance(1);
        poses.push_back(swimmer.state().positions);
        fins.push_back(swimmer.fins());
    }

    // Of these, kPhases + 1 evenly spaced poses are kept.
    const std::size_t stride = (poses.size() - 1) / motion::kPhases;
    RecordedCycle turn{
        .periodSeconds = swimmer.stepSeconds() * static_cast<double>(poses.size() - 1),
        .playsToEnd = true,
        .course = entry.beat.course,
        .poses = {},
        .fins = {}};
    for (std::size_t i = 0; i < poses.size(); i += stride) {
        turn.poses.push_back(poses[i]);
        turn.fins.push_back(fins[i]);
    }
    return turn;
}

double turnRadians(const RecordedCycle& turn) {
    return yawRadians(turn.course, frameOf(turn.poses.back()).worldFromBody[0]);
}

std::vector<TurnSpread> surveyTurns(const config::Species& species) {
    const config::Swim& swim = species.swim;
    std::vector<TurnSpread> table;
    for (const auto& [action, gait] : {std::pair{motion::Action::ForwardSlow, swim.slow},
                                       std::pair{motion::Action::ForwardMedium, swim.medium},
                                       std::pair{motion::Action::ForwardFast, swim.fast}}) {
        const SteadySwimming entry = swimUntilSteady(species, gait);
        for (const auto& [turn, bend] :
             {std::pair{motion::Action::TurnLeftGradual, species.turn.gradual},
              std::pair{motion::Action::TurnLeftSharp, species.turn.sharp}})
            table.push_back(spreadOf(recordLeftTurns(species, entry, bend), turn, action));
    }
    return table;
}

namespace {

constexpr double kBeatsAfter = 5;  // of medium swimming, over which the way after a turn is taken

// The nodal points at the times i * seconds / kPhases from now on, i from 0 to kPhases, linearly
// between two steps. The swimmer is at most a step short of the last afterwards.
std::vector<NodeVectors> evenPoses(Swimmer& swimmer, double seconds) {
    std::vector<NodeVectors> poses;
    int done = 0;
    for (int i = 0; i <= motion::kPhases; ++i) {
        const double steps = seconds * i / motion::kPhases / swimmer.stepSeconds();
        const int whole = static_cast<int>(steps);
        swimmer.advance(whole - done);
        done = whole;
        Swimmer ahead = swimmer;
        ahead.advance(1);
        NodeVectors pose = swimmer.state().positions;
        for (std::size_t node = 0; node < pose.size(); ++node)
            pose.at(node) =
                glm::mix(pose.at(node), ahead.state().positions.at(node), steps - whole);
        poses.push_back(pose);
    }
    return poses;
}

// What a swimmer does that swam at a speed on a course: obeys an order for `seconds`, then swims on
// at a gait.
EnteredTurn recordEntered(Swimmer swimmer,
                          const RecordedCycle& before,
                          const Order& order,
                          double seconds,
                          const config::Gait& after) {
    const double way = before.poses.empty() ? 0
                                            : glm::distance(frameOf(before.poses.back()).origin,
                                                            frameOf(before.poses.front()).origin);
    EnteredTurn entered{.turn = {.periodSeconds = seconds,
                                 .playsToEnd = true,
                                 .course = before.course,
                                 .poses = {},
                                 .fins = {}},
                        .speedBefore = way > 0 ? way / before.periodSeconds : 0,
                        .secondsAfter = kBeatsAfter / after.beatHertz};
    swimmer.give(order);
    entered.turn.poses = evenPoses(swimmer, seconds);
    entered.turn.fins.assign(entered.turn.poses.size(), swimmer.fins());
    swimmer.give({.controller = Controller::ForwardSwim, .gait = after});
    swimmer.advance(static_cast<int>(std::lround(entered.secondsAfter / swimmer.stepSeconds())));
    entered.wayAfter =
        frameOf(swimmer.state().positions).origin - frameOf(entered.turn.poses.back()).origin;
    return entered;
}

// Begun in the steady swimming of each entry: first by entry and then by kRecordedPhases phases.
std::vector<EnteredTurn> recordAllEntered(const std::vector<const SteadySwimming*>& entries,
                                          const Order& order,
                                          double seconds,
                                          const config::Gait& after) {
    std::vector<EnteredTurn> turns;
    for (const SteadySwimming* entry : entries)
        for (int i = 0; i < kRecordedPhases; ++i) {
            Swimmer swimmer = entry->swimmer;
            swimmer.advance(i * motion::kPhases / kRecordedPhases * entry->stepsPerPhase);
            turns.push_back(recordEntered(std::move(swimmer), entry->beat, order, seconds, after));
        }
    return turns;
}

Order startOf(double bendShare) {
    return {.controller = Controller::LeftStart, .bendShare = bendShare};
}

}  // namespace

std::vector<EnteredTurn> recordEnteredTurns(const config::Species& species,
                                            const std::vector<const SteadySwimming*>& entries,
                                            const config::Bend& bend,
                                            double seconds) {
    return recordAllEntered(
        entries,
        {.controller = Controller::LeftTurn, .bend = bend, .bankRadians = kBankRadians},
        seconds,
        species.swim.medium);
}

EnteredTurn recordStart(const config::Species& species, double bendShare) {
    return recordEntered(Swimmer(species),
                         {},
                         startOf(bendShare),
                         secondsUntilRelaxed(species, bendShare),
                         species.swim.fast);
}

std::vector<EnteredTurn> recordEnteredStarts(const config::Species& species,
                                             const std::vector<const SteadySwimming*>& entries,
                                             double bendShare) {
    return recordAllEntered(
        entries, startOf(bendShare), secondsUntilRelaxed(species, bendShare), species.swim.fast);
}

RecordedCycle recordTypicalLeftTurn(const config::Species& species,
                                    const SteadySwimming& medium,
                                    const config::Bend& bend) {
    const auto turns = recordLeftTurns(species, medium, bend);
    const double mean = spreadOf(turns, {}, motion::Action::ForwardMedium).mean();
    return *std::ranges::min_element(
        turns, {}, [&](const RecordedCycle& turn) { return std::abs(turnRadians(turn) - mean); });
}

}  // namespace aquarama::capture
