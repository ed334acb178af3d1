// SPDX-License-Identifier: Apache-2.0
// Every species in the tree, by name.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "common/config/species.h"

namespace aquarama {

inline const std::vector<Species>& allSpecies() {
    static const std::vector<Species> all = [] {
        std::vector<Species> read;
        for (const auto& file :
             std::filesystem::directory_iterator(AQUARAMA_SOURCE_DIR "/config/species"))
            read.push_back(readSpecies(file.path().string()));
        std::ranges::sort(read, {}, &Species::name);
        return read;
    }();
    return all;
}

}  // namespace aquarama
