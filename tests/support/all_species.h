// SPDX-License-Identifier: Apache-2.0
// The species that tests of all species take: the seven of the cast and the sea goldie; with
// AQUARAMA_SOAK in the environment every one of config/species.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/species.h"
#include "tests/support/cast.h"

namespace aquarama::test {

// Sorted.
inline const std::vector<std::string>& allSpeciesNames() {
    static const std::vector<std::string> all = [] {
        const bool isSoak = std::getenv("AQUARAMA_SOAK") != nullptr;
        std::vector<std::string> names;
        for (const auto& file :
             std::filesystem::directory_iterator(sourceFolder() + "/config/species")) {
            const std::string name = file.path().stem().string();
            if (isSoak || name == "sea_goldie" || std::ranges::find(kCast, name) != kCast.end())
                names.push_back(name);
        }
        std::ranges::sort(names);
        return names;
    }();
    return all;
}

// In the same order.
inline const std::vector<config::Species>& allSpecies() {
    static const std::vector<config::Species> all = [] {
        std::vector<config::Species> read;
        for (const std::string& name : allSpeciesNames()) read.push_back(castMember(name));
        return read;
    }();
    return all;
}

}  // namespace aquarama::test
