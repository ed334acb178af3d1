// SPDX-License-Identifier: Apache-2.0
// Turns of every species: how far, how sure, and to either side alike.
#include "capture/turn.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

#include "capture/dynamics.h"
#include "capture/measure.h"
#include "common/base/units.h"
#include "tests/capture/all_species.h"

namespace aquarama::capture {
namespace {

using Turn = EachSpecies;
INSTANTIATE_TEST_SUITE_P(Of,
                         Turn,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         nameOfSpecies);

// Surveyed once for all tests.
const std::vector<TurnSpread>& surveyOf(const config::Species& species) {
    static std::map<std::string, std::vector<TurnSpread>> surveys;
    auto& survey = surveys[species.name];
    if (survey.empty()) survey = surveyTurns(species);
    return survey;
}

TEST_P(Turn, gradualIsTwentyToFortyDegreesAndSharpFortyToEighty) {
    for (const motion::Action action :
         {motion::Action::TurnLeftGradual, motion::Action::TurnRightGradual}) {
        const double turned = std::abs(measure(segment(action)).turnRadians) / kDegree;
        EXPECT_GE(turned, 20) << motion::nameOf(action);
        EXPECT_LE(turned, 40) << motion::nameOf(action);
    }
    for (const motion::Action action :
         {motion::Action::TurnLeftSharp, motion::Action::TurnRightSharp}) {
        const double turned = std::abs(measure(segment(action)).turnRadians) / kDegree;
        EXPECT_GE(turned, 40) << motion::nameOf(action);
        EXPECT_LE(turned, 80) << motion::nameOf(action);
    }
}

TEST_P(Turn, theCapturedOneIsTheTypicalOneOfItsSpread) {
    for (const TurnSpread& row : surveyOf(species())) {
        if (row.entry != motion::Action::ForwardMedium) continue;
        const auto off = [&](double angle) { return std::abs(angle - row.mean()); };
        const double nearest = off(std::ranges::min(row.radians, {}, off));
        EXPECT_NEAR(off(measure(segment(row.turn)).turnRadians), nearest, 0.01 * kDegree);
        EXPECT_LT(nearest, (row.most() - row.least()) / 4);
    }
}

// In the fish's frame on its course, left positive as seen by the turner.
struct Path {
    std::vector<NodeVectors> poses;
    double turned = 0;
};
Path pathOf(const RecordedCycle& turn, double side) {
    const PoseFrame first = frameOf(turn.poses.front());
    const glm::dvec3 up{0, 1, 0};
    const glm::dvec3 right = glm::cross(turn.course, up);
    Path path{.poses = turn.poses, .turned = side * turnRadians(turn)};
    for (NodeVectors& pose : path.poses)
        for (glm::dvec3& node : pose) {
            const glm::dvec3 from = node - first.origin;
            node = {glm::dot(from, turn.course), from.y, side * glm::dot(from, right)};
        }
    return path;
}

// Nothing here was mirrored but the drive: the right turn is simulated, half a beat later, when the
// tail is where it was on the other side.
TEST_P(Turn, aMirroredDriveSwimsTheMirroredPath) {
    const SteadySwimming medium = swimUntilSteady(species(), species().swim.medium);
    for (const config::Bend& bend : {species().turn.gradual, species().turn.sharp}) {
        const Path left = pathOf(recordTurn(species(), medium, Controller::LeftTurn, bend, 8), 1);
        const Path right = pathOf(
            recordTurn(species(), medium, Controller::RightTurn, bend, 8 + motion::kPhases / 2),
            -1);
        EXPECT_NEAR(left.turned, right.turned, 0.05 * kDegree);
        ASSERT_EQ(left.poses.size(), right.poses.size());
        double furthest = 0;
        for (std::size_t k = 0; k < left.poses.size(); ++k)
            for (int i = 0; i < body::kNodalPoints; ++i)
                furthest = std::max(
                    furthest,
                    glm::distance(
                        left.poses[k].at(static_cast<std::size_t>(i)),
                        right.poses[k].at(static_cast<std::size_t>(mirroredLeftRight(i)))));
        EXPECT_LT(furthest, 1e-3) << "body lengths, at a bend of " << bend.strength;
    }
}

TEST_P(Turn, goesFurtherTheFasterItIsEntered) {
    const std::vector<TurnSpread>& table = surveyOf(species());
    ASSERT_EQ(table.size(), 6U);
    for (const std::size_t turn : {0U, 1U}) {
        EXPECT_LT(table[turn].mean(), table[turn + 2].mean());
        EXPECT_LT(table[turn + 2].mean(), table[turn + 4].mean());
    }
    for (const TurnSpread& row : table) {
        EXPECT_GT(row.least(), 0) << "always to its side";
        EXPECT_LE(row.least(), row.mean());
        EXPECT_GE(row.most(), row.mean());
    }
}

}  // namespace
}  // namespace aquarama::capture
