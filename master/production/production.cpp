// SPDX-License-Identifier: Apache-2.0
#include "master/production/production.h"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include "common/config/species.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/net/blob.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"

namespace aquarama {

namespace {

// One core moves a few thousand fish well inside a tick; more threads would only wait for each
// other.
constexpr std::uint32_t kFishOfAThread = 2000;

// The first show of a species on this machine simulates it; later ones find what it swam.
std::vector<std::byte> capturedOnce(const SpeciesText& species) {
    ProgressBar bar("capturing " + std::filesystem::path(species.source).stem().string());
    const auto cache = defaultBlobDirectory().parent_path() / "repertoires";
    return repertoireFor(
        species.text, species.source, cache, [&](double share) { bar.show(share); });
}

FishLengths lengthsOf(const SizeRange& size) {
    return {.meanMetres = static_cast<float>(size.meanMetres),
            .deviationMetres = static_cast<float>(size.deviationMetres),
            .leastMetres = static_cast<float>(size.leastMetres),
            .mostMetres = static_cast<float>(size.mostMetres)};
}

WorldSpecies worldSpeciesOf(const ProducedSpecies& produced) {
    const Species species = parseSpecies(produced.text, produced.file);
    return {.tables = makeMotorTables(decodeRepertoire(produced.repertoire, produced.file)),
            .fish = produced.fish,
            .lengths = lengthsOf(species.size),
            .name = species.name,
            .habits = species.habits,
            .start = {}};
}

}  // namespace

Production readProduction(const Rig& rig,
                          const std::string& rigPath,
                          const ProductionChoice& choice) {
    const auto folder = std::filesystem::path(rigPath).parent_path();
    Production production;
    production.seed = choice.seed;
    for (const CastMember& member : rig.cast) {
        const bool isSchool = production.cast.empty();
        SpeciesText species = readSpeciesText(folder / member.species);
        std::vector<std::byte> repertoire = capturedOnce(species);
        production.cast.push_back({std::move(species.source),
                                   std::move(species.text),
                                   std::move(repertoire),
                                   isSchool ? choice.fish.value_or(member.fish) : member.fish});
    }
    return production;
}

WorldOptions worldOptionsOf(const Production& production) {
    WorldOptions options;
    options.seed = production.seed;
    std::uint32_t fish = 0;
    for (const ProducedSpecies& species : production.cast) {
        options.cast.push_back(worldSpeciesOf(species));
        fish += species.fish;
    }
    options.threads =
        std::clamp(fish / kFishOfAThread, 1U, std::max(std::thread::hardware_concurrency(), 1U));
    return options;
}

}  // namespace aquarama
