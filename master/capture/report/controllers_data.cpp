// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <string>

#include "common/units/angle.h"
#include "master/capture/control/body_angles.h"
#include "master/capture/report/controller_trial.h"
#include "master/capture/report/json_points.h"
#include "master/capture/report/report_data.h"
#include "master/capture/report/silhouette.h"

namespace aquarama::report {

namespace {

using nlohmann::json;

constexpr double kRunUpBeats = 20;
constexpr double kRoll = 40 * kRadiansPerDegree<double>;  // from which balance rights the fish
constexpr double kPitch = 20 * kRadiansPerDegree<double>;

json listOfPolygons(const std::vector<Polygon>& polygons) {
    json list = json::array();
    for (const Polygon& polygon : polygons) list.push_back(listOf(polygon));
    return list;
}

// Where the fish is at each moment and how it lies; its silhouettes at `fish` of them, evenly.
json trialData(const std::string& controller,
               const ControllerTrial& trial,
               const body::FishBody& body,
               ViewSide view,
               int fish) {
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

std::string controllersData(const config::Species& species) {
    const body::FishBody body = body::makeBody(species);
    json trials = json::array();
    const auto order = [&](capture::Controller controller) {
        return capture::Order{.controller = controller,
                              .gait = species.swim.medium,
                              .bend = species.turn.sharp,
                              .pitchRadians = kPitch};
    };
    const auto add = [&](const char* name, const ControllerTrial& trial, ViewSide view, int fish) {
        trials.push_back(trialData(name, trial, body, view, fish));
    };
    const auto addSwimming = [&](const char* name,
                                 capture::Controller controller,
                                 double seconds,
                                 ViewSide view,
                                 int fish,
                                 double beats = kRunUpBeats) {
        add(name, swimmingThen(species, order(controller), seconds, beats), view, fish);
    };
    using enum capture::Controller;
    using enum ViewSide;
    addSwimming("forward swim", ForwardSwim, 1.5, Above, 4);
    addSwimming("left turn", LeftTurn, 1, Above, 5);
    // From the other half of the beat, so that it is the left one's mirror image.
    addSwimming("right turn", RightTurn, 1, Above, 5, kRunUpBeats + 0.5);
    addSwimming("glide", Glide, 1.5, Above, 4);
    addSwimming("ascend", Ascend, 1.5, ViewSide::Side, 4);
    addSwimming("descend", Descend, 1.5, ViewSide::Side, 4);
    add("balance", rolledThen(species, kRoll, order(Balance), 2.5), Above, 6);
    addSwimming("brake", Brake, 1.5, Above, 4);
    add("retreat", restingThen(species, order(Retreat), 3.25), Above, 4);
    return json{{"species", species.name}, {"trials", trials}}.dump() + "\n";
}

}  // namespace aquarama::report
