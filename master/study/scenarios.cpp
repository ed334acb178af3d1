// SPDX-License-Identifier: Apache-2.0
#include "master/study/scenarios.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "common/config/species.h"
#include "master/simulation/assets.h"

namespace aquarama::study {

namespace {

constexpr std::uint64_t kTicksBetweenPinches = 30 * kTicksPerSecond;

}  // namespace

Scenario readScenario(const std::filesystem::path& scene) {
    const simulation::Assets assets = simulation::readAssets(scene.string(), {});
    Scenario scenario;
    scenario.world = simulation::worldOptionsOf(assets);
    scenario.world.scene.tour.reset();  // fish are measured, not how they make way
    scenario.name = scenario.world.scene.name;
    for (const config::Species& species : assets.species)
        scenario.halfWidths.push_back(std::ranges::max(species.profile.halfWidth));
    return scenario;
}

std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder) {
    std::vector<Scenario> scenarios;
    for (const std::string_view scene :
         {"reef", "study/school", "study/crowded_tank", "study/feeding"})
        scenarios.push_back(
            readScenario(configFolder / "scenes" / (std::string(scene) + ".txtpb")));
    scenarios.back().ticksBetweenPinches = kTicksBetweenPinches;
    return scenarios;
}

}  // namespace aquarama::study
