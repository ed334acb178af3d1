// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "capture/dynamics.h"
#include "capture/report/report_data.h"
#include "capture/report/silhouette.h"
#include "capture/swimmer.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

using nlohmann::json;

// Trials.

// The fish at one instant.
struct Moment {
    double seconds = 0;            // since the order
    capture::NodeVectors nodes{};  // body lengths; the origin is where the fish was at the order
    capture::FinPlates fins;
};

// What a fish does after an order.
struct ControllerTrial {
    std::vector<Moment> moments;  // kMoments + 1, evenly in time, the first at the order
    // Mean speeds along the body axis before the order and after the last moment, body lengths a
    // second; negative is backward.
    double speedBefore = 0, speedAfter = 0;
};

// The origin of the body frame.
glm::dvec3 middleOf(const capture::NodeVectors& nodes) {
    return capture::frameOf(nodes).origin;
}

// Advances the swimmer and returns its mean speed along the body axis at the end, body lengths a
// second; negative is backward.
double speedOver(capture::Swimmer& swimmer, double seconds) {
    const glm::dvec3 from = middleOf(swimmer.state().positions);
    const double start = swimmer.seconds();
    swimmer.advance(static_cast<int>(std::lround(seconds / swimmer.stepSeconds())));
    const capture::PoseFrame frame = capture::frameOf(swimmer.state().positions);
    return glm::dot(frame.origin - from, frame.worldFromBody[0]) / (swimmer.seconds() - start);
}

// Gives the order and records. The moments are at the simulation steps nearest to even times.
ControllerTrial record(capture::Swimmer swimmer,
                       const capture::Order& order,
                       double seconds,
                       double speedBefore) {
    assert(seconds > 0);
    ControllerTrial trial{.moments = {}, .speedBefore = speedBefore};
    const glm::dvec3 start = middleOf(swimmer.state().positions);
    const double begin = swimmer.seconds();
    swimmer.give(order);
    // Each time is computed from the start, so that the rounding to whole steps does not add up.
    for (int i = 0; i <= kMoments; ++i) {
        const double until = begin + seconds * i / kMoments;
        swimmer.advance(
            static_cast<int>(std::lround((until - swimmer.seconds()) / swimmer.stepSeconds())));
        Moment moment{.seconds = swimmer.seconds() - begin,
                      .nodes = swimmer.state().positions,
                      .fins = swimmer.control().fins};
        for (glm::dvec3& node : moment.nodes) node -= start;
        trial.moments.push_back(moment);
    }
    // Over one beat, or at most a third of a second.
    trial.speedAfter = speedOver(swimmer, 1 / std::max(order.gait.beatHertz, 3.0));
    return trial;
}

// A fish that has swum `beats` beats at the medium gait from rest.
capture::Swimmer afterRunUp(const config::Species& species, double beats) {
    const config::Gait& medium = species.swim.medium;
    capture::Swimmer swimmer(species);
    swimmer.give({.controller = capture::Controller::ForwardSwim, .gait = medium});
    speedOver(swimmer, beats / medium.beatHertz);
    return swimmer;
}

// A fish at rest, rolled about the body axis, the right side up for a positive angle.
capture::Swimmer rolled(const config::Species& species, double rollRadians) {
    const double cosine = std::cos(rollRadians);
    const double sine = std::sin(rollRadians);
    capture::BiomechanicalFish fish = capture::makeBiomechanicalFish(species);
    for (glm::dvec3& x : fish.restPositions)
        x = {x.x, cosine * x.y + sine * x.z, -sine * x.y + cosine * x.z};
    return {fish, species, capture::longestStepSeconds(fish)};
}

// Data of the figure.

constexpr double kRunUpBeats = 20;                        // until medium swimming is nearly steady
constexpr double kRoll = 40 * kRadiansPerDegree<double>;  // from which balance rights the fish
constexpr double kPitch = 20 * kRadiansPerDegree<double>;

// A list of lists of points.
json listOfPolygons(const std::vector<Polygon>& polygons) {
    json list = json::array();
    for (const Polygon& polygon : polygons) list.push_back(listOf(polygon));
    return list;
}

// Place and attitude of the fish at each moment, and its silhouette at `fish` >= 2 of them, evenly
// spaced.
json trialData(const std::string& controller,
               const ControllerTrial& trial,
               const body::FishBody& body,
               ViewSide view,
               int fish) {
    assert(fish >= 2);
    json data{{"controller", controller},
              {"view", view == ViewSide::Above ? "above" : "side"},
              {"speed_before", trial.speedBefore},
              {"speed_after", trial.speedAfter}};
    for (const Moment& moment : trial.moments) {
        const capture::BodyAngles angles =
            capture::bodyAnglesOf({.positions = moment.nodes, .velocities = {}});
        data["seconds"].push_back(pointOf(moment.seconds));
        data["way"].push_back(pointOf(seen(view, middleOf(moment.nodes))));
        data["heading_degrees"].push_back(
            pointOf(angles.headingRadians / kRadiansPerDegree<double>));
        data["pitch_degrees"].push_back(pointOf(angles.pitchRadians / kRadiansPerDegree<double>));
        data["roll_degrees"].push_back(pointOf(angles.rollRadians / kRadiansPerDegree<double>));
    }
    for (int i = 0; i < fish; ++i) {
        const auto index = static_cast<std::size_t>(i * kMoments / (fish - 1));
        const Moment& moment = trial.moments.at(index);
        data["fish"].push_back(
            {{"moment", index},
             {"body", listOfPolygons(silhouetteOf(body, moment.nodes, view))},
             {"fins", listOfPolygons(finLines(moment.fins, moment.nodes, view))}});
    }
    return data;
}

}  // namespace

// One trial for each controller, with its length in seconds, its view and the number of
// silhouettes.
std::string controllersData(const config::Species& species) {
    const body::FishBody body = body::makeBody(species);
    json trials = json::array();
    const auto order = [&](capture::Controller controller) {
        return capture::Order{.controller = controller,
                              .gait = species.swim.medium,
                              .bend = species.turn.sharp,
                              .pitchRadians = kPitch};
    };
    const auto add = [&](const char* name,
                         const capture::Swimmer& swimmer,
                         capture::Controller controller,
                         double seconds,
                         double speedBefore,
                         ViewSide view,
                         int fish) {
        const ControllerTrial trial = record(swimmer, order(controller), seconds, speedBefore);
        trials.push_back(trialData(name, trial, body, view, fish));
    };
    // All that swim at the order continue from one run-up.
    capture::Swimmer swimming = afterRunUp(species, kRunUpBeats);
    const double oneBeat = 1 / species.swim.medium.beatHertz;
    const double speed = speedOver(swimming, oneBeat);
    // Half a beat later, so that the right turn is the mirror image of the left turn.
    capture::Swimmer halfABeatLater = swimming;
    speedOver(halfABeatLater, oneBeat / 2);
    using enum capture::Controller;
    using enum ViewSide;
    add("forward swim", swimming, ForwardSwim, 1.5, speed, Above, 4);
    add("left turn", swimming, LeftTurn, 1, speed, Above, 5);
    add("right turn", halfABeatLater, RightTurn, 1, speed, Above, 5);
    add("glide", swimming, Glide, 1.5, speed, Above, 4);
    add("ascend", swimming, Ascend, 1.5, speed, ViewSide::Side, 4);
    add("descend", swimming, Descend, 1.5, speed, ViewSide::Side, 4);
    add("balance", rolled(species, kRoll), Balance, 2.5, 0, Above, 6);
    add("brake", swimming, Brake, 1.5, speed, Above, 4);
    add("retreat", capture::Swimmer(species), Retreat, 3.25, 0, Above, 4);
    return json{{"species", species.name}, {"trials", trials}}.dump() + "\n";
}

}  // namespace aquarama::report
