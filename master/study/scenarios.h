// SPDX-License-Identifier: Apache-2.0
// Where adaptation is put to the test.
#pragma once

#include <vector>

#include "master/study/stock.h"
#include "master/study/study.h"

namespace aquarama {

// The reef as on the wall; its school alone; fish in a tank where they must keep out of each
// other's way; and hungry ones that are fed.
[[nodiscard]] Scenario reefScenario(const Stock& stock);
[[nodiscard]] Scenario schoolScenario(const Stock& stock);
[[nodiscard]] Scenario crowdedTank(const Stock& stock);
[[nodiscard]] Scenario feedingTime(const Stock& stock);
[[nodiscard]] std::vector<Scenario> scenariosOf(const Stock& stock);

}  // namespace aquarama
