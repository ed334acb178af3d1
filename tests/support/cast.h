// SPDX-License-Identifier: Apache-2.0
// The seven species of the scene reef, and what the file of any species says.
#pragma once

#include <array>
#include <string>

#include "common/config/species.h"
#include "tests/support/source_folder.h"

namespace aquarama::test {

inline const std::array<std::string, 7> kCast{"bigeye_scad",
                                              "clownfish",
                                              "moorish_idol",
                                              "blue_tang",
                                              "parrotfish",
                                              "trumpetfish",
                                              "blacktip_reef_shark"};

inline config::Species castMember(const std::string& name) {
    return config::readSpecies(sourceFolder() + "/config/species/" + name + ".txtpb");
}

}  // namespace aquarama::test
