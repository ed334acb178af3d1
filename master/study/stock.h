// SPDX-License-Identifier: Apache-2.0
// The species of the show, ready to be put into a world.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "master/world/world.h"

namespace aquarama {

struct StockedSpecies {
    WorldSpecies species;  // without fish
    float halfWidth = 0;   // the greatest, body lengths
};

// A cast, and what a study must know of it besides.
struct StudyCast {
    std::vector<WorldSpecies> species;
    std::vector<float> halfWidths;
};

class Stock {
  public:
    // Every species/*.txtpb of the folder; what was not captured before is captured now.
    explicit Stock(const std::filesystem::path& configFolder);

    // Throws Error for a species that is not there.
    [[nodiscard]] const StockedSpecies& at(const std::string& name) const;
    [[nodiscard]] StudyCast cast(
        const std::vector<std::pair<std::string, std::uint32_t>>& fish) const;

  private:
    std::vector<StockedSpecies> species_;
};

}  // namespace aquarama
