// SPDX-License-Identifier: Apache-2.0
// A show for tests: real files of a scene and its species, all moved by synthetic segments,
// which need no capture.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/config/text_file.h"
#include "common/motion/repertoire.h"
#include "common/wire/recording.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::test {

// A school of 40 about a reef that hungers soon, and a shark that hunts it.
inline wire::AssetBundle syntheticAssets(std::uint32_t seed = 1) {
    const std::string species = AQUARAMA_SOURCE_DIR "/config/species/";
    const std::vector<std::byte> repertoire =
        motion::encodeRepertoire(syntheticRepertoire(false, "synthetic_scad"));
    wire::AssetBundle assets{.seed = seed,
                             .sceneFile = "scene",
                             .scene = R"(
name: "tank"
place: REEF
eye { x_m: 0 y_m: -6 z_m: 0 }
water { centre { x_m: 0 y_m: -5.8 z_m: -5.5 } half_extent { x_m: 5 y_m: 1.8 z_m: 3.5 } }
gathering: NONE
plankton: 200
)",
                             .cast = {}};
    for (const auto& [name, fish] :
         {std::pair{"bigeye_scad.txtpb", 40U}, std::pair{"blacktip_reef_shark.txtpb", 1U}}) {
        assets.scene +=
            "cast { species: \"" + std::string(name) + "\" fish: " + std::to_string(fish) + " }\n";
        assets.cast.push_back({name, config::readTextFile(species + name), repertoire, fish});
    }
    return assets;
}

}  // namespace aquarama::test
