// SPDX-License-Identifier: Apache-2.0
// Who swims in a scene: its members with their species' files.
#pragma once

#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/config/species.h"

namespace aquarama::config {

struct CastSpecies {
    std::string path;
    std::string text;  // of the file
    Species species;
};

// Of each member of the cast, in its order. Throws Error at the member's place in the scene where
// there is no such file, or at the mistake in it.
[[nodiscard]] std::vector<CastSpecies> readCastSpecies(const Scene& scene,
                                                       const std::string& scenePath);

// Where the scene lies that a rig shows. Throws Error at its place in the rig where there is none.
[[nodiscard]] std::string scenePathOf(const Rig& rig, const std::string& rigPath);

}  // namespace aquarama::config
