// SPDX-License-Identifier: Apache-2.0
#include "master/study/scenarios.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "common/config/species.h"
#include "master/staging/staging.h"

namespace aquarama {

namespace {

constexpr std::uint64_t kTicksBetweenPinches = 30 * kTicksPerSecond;

// The greatest of the body.
float halfWidthOf(const StagedSpecies& staged) {
    const std::string text(reinterpret_cast<const char*>(staged.speciesBlob.data()),
                           staged.speciesBlob.size());
    return std::ranges::max(parseSpecies(text, staged.species.name).profile.halfWidth);
}

}  // namespace

Scenario readScenario(const std::filesystem::path& scene) {
    const Staging staging = stageScene(scene.string(), {});
    Scenario scenario;
    scenario.world = worldOptionsOf(staging, 1);
    scenario.name = scenario.world.scene.name;
    for (const StagedSpecies& staged : staging.cast)
        scenario.halfWidths.push_back(halfWidthOf(staged));
    return scenario;
}

std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder) {
    std::vector<Scenario> scenarios;
    for (const std::string_view scene :
         {"reef", "study/school", "bait_ball", "study/crowded_tank", "study/feeding"})
        scenarios.push_back(
            readScenario(configFolder / "scenes" / (std::string(scene) + ".txtpb")));
    scenarios.back().ticksBetweenPinches = kTicksBetweenPinches;
    return scenarios;
}

}  // namespace aquarama
