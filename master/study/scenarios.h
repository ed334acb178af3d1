// SPDX-License-Identifier: Apache-2.0
// Where adaptation is put to the test: scenes of the show and of config/scenes/study.
#pragma once

#include <filesystem>
#include <vector>

#include "master/study/study.h"

namespace aquarama::study {

// A scene's file, whose own name the scenario bears. Throws Error.
[[nodiscard]] Scenario readScenario(const std::filesystem::path& scene);

// The reef as on the wall; its school alone; fish in a tank where they must keep out of each
// other's way; and hungry ones that are fed.
[[nodiscard]] std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder);

}  // namespace aquarama::study
