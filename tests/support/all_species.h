// SPDX-License-Identifier: Apache-2.0
// Every species in the tree, by name.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "common/config/species.h"

namespace aquarama::test {

inline const std::vector<config::Species>& allSpecies() {
    static const std::vector<config::Species> all = [] {
        std::vector<config::Species> read;
        for (const auto& file :
             std::filesystem::directory_iterator(AQUARAMA_SOURCE_DIR "/config/species"))
            read.push_back(config::readSpecies(file.path().string()));
        std::ranges::sort(read, {}, &config::Species::name);
        return read;
    }();
    return all;
}

}  // namespace aquarama::test
