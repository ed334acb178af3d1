// SPDX-License-Identifier: Apache-2.0
// A show for tests: real files of a scene and its species, all moved by the synthetic scad's
// segments, which need no capture.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/config/scene.h"
#include "common/motion/repertoire.h"
#include "common/wire/recording.h"
#include "tests/master/world/school_of_synthetic_fish.h"

namespace aquarama::test {

inline std::string textOf(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A school of 40 about a reef that hungers soon, and a shark that hunts it.
inline wire::AssetBundle syntheticAssets(std::uint32_t seed = 1) {
    const std::string species = AQUARAMA_SOURCE_DIR "/config/species/";
    motion::Repertoire scad = world::syntheticScad();
    scad.species = "synthetic_scad";
    const std::vector<std::byte> repertoire = motion::encodeRepertoire(scad);
    config::Scene scene;
    scene.name = "tank";
    scene.plankton = 200;
    wire::AssetBundle assets{.seed = seed, .sceneFile = "scene", .scene = {}, .cast = {}};
    for (const auto& [name, fish] :
         {std::pair{"bigeye_scad.txtpb", 40U}, std::pair{"blacktip_reef_shark.txtpb", 1U}}) {
        scene.cast.push_back({.species = name, .fish = fish});
        assets.cast.push_back({name, textOf(species + name), repertoire, fish});
    }
    assets.scene = config::writeScene(scene);
    return assets;
}

}  // namespace aquarama::test
