// SPDX-License-Identifier: Apache-2.0
#include "master/production/production.h"

#include <string>

#include "common/config/scene.h"
#include "common/units/error.h"

namespace aquarama {

Production productionOf(const Staging& staging, std::uint32_t seed) {
    Production production{.seed = seed,
                          .sceneFile = staging.scene.name,
                          .scene = writeScene(staging.scene),
                          .cast = {}};
    for (std::size_t i = 0; i < staging.cast.size(); ++i) {
        const StagedSpecies& member = staging.cast[i];
        const auto* text = reinterpret_cast<const char*>(member.speciesBlob.data());
        production.cast.push_back({staging.scene.cast[i].species,
                                   {text, member.speciesBlob.size()},
                                   member.repertoireBlob,
                                   member.species.fish});
    }
    return production;
}

Staging stagingOf(const Production& production) {
    Staging staging{parseScene(production.scene, production.sceneFile), {}};
    if (staging.scene.cast.size() != production.cast.size())
        throw Error(production.sceneFile + ": its cast has " +
                    std::to_string(staging.scene.cast.size()) + " members, and there are " +
                    std::to_string(production.cast.size()) + " species with it");
    for (std::size_t i = 0; i < production.cast.size(); ++i) {
        const ProducedSpecies& species = production.cast[i];
        CastMember& member = staging.scene.cast[i];
        member.fish = species.fish;
        staging.cast.push_back(
            stagedSpecies(species.text, species.file, species.repertoire, member));
    }
    return staging;
}

WorldOptions worldOptionsOf(const Production& production) {
    return worldOptionsOf(stagingOf(production), production.seed);
}

}  // namespace aquarama
