// SPDX-License-Identifier: Apache-2.0
#include "master/study/scenarios.h"

#include <utility>

namespace aquarama {

namespace {

Scenario scenarioOf(std::string name, std::string what, StudyCast cast) {
    Scenario scenario;
    scenario.name = std::move(name);
    scenario.what = std::move(what);
    scenario.world.cast = std::move(cast.species);
    scenario.halfWidths = std::move(cast.halfWidths);
    return scenario;
}

// Open water without plankton: whatever is met there is a fish or what a visitor gave.
Scene tank(glm::vec3 halfExtent) {
    Scene scene;
    scene.name = "tank";
    scene.place = PlaceKind::OpenSea;
    scene.water.halfExtent = halfExtent;
    scene.water.leastLengthsCubed = 0;
    scene.gathering = Gathering::None;
    scene.plankton = 0;
    return scene;
}

void beginAnywhere(std::vector<WorldSpecies>& cast, const Scene& scene, double hunger) {
    for (WorldSpecies& species : cast)
        species.start = Start{.centre = scene.water.centre,
                              .radiusMetres = 0.7 * static_cast<double>(scene.water.halfExtent.y),
                              .hunger = hunger};
}

}  // namespace

Scenario reefScenario(const Stock& stock) {
    return scenarioOf("reef",
                      "The reef as on the wall: 51 scad and nine others, a shark among them.",
                      stock.cast({{"bigeye_scad", 51},
                                  {"clownfish", 2},
                                  {"moorish_idol", 2},
                                  {"blue_tang", 2},
                                  {"parrotfish", 1},
                                  {"trumpetfish", 1},
                                  {"blacktip_reef_shark", 1}}));
}

Scenario schoolScenario(const Stock& stock) {
    return scenarioOf("school",
                      "51 scad by themselves, in the water of the reef.",
                      stock.cast({{"bigeye_scad", 51}}));
}

Scenario crowdedTank(const Stock& stock) {
    Scenario scenario =
        scenarioOf("crowded tank",
                   "36 fish of five species, none of them a hunter, in three by two by two metres.",
                   stock.cast({{"bigeye_scad", 12},
                               {"blue_tang", 8},
                               {"moorish_idol", 8},
                               {"parrotfish", 4},
                               {"trumpetfish", 4}}));
    scenario.world.scene = tank({1.5F, 1.0F, 1.0F});
    beginAnywhere(scenario.world.cast, scenario.world.scene, 0);
    return scenario;
}

Scenario feedingTime(const Stock& stock) {
    Scenario scenario = scenarioOf(
        "feeding",
        "20 hungry fish of four species in six by three by five metres; a pinch of twelve pellets "
        "every half minute, and nothing else to eat.",
        stock.cast({{"bigeye_scad", 8}, {"clownfish", 4}, {"blue_tang", 4}, {"moorish_idol", 4}}));
    scenario.world.scene = tank({3.0F, 1.5F, 2.5F});
    beginAnywhere(scenario.world.cast, scenario.world.scene, 0.9);
    scenario.ticksBetweenPinches = 30 * kTicksPerSecond;
    return scenario;
}

std::vector<Scenario> scenariosOf(const Stock& stock) {
    return {reefScenario(stock), schoolScenario(stock), crowdedTank(stock), feedingTime(stock)};
}

}  // namespace aquarama
