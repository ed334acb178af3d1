// SPDX-License-Identifier: Apache-2.0
#include "master/staging/staging.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <span>
#include <thread>
#include <utility>

#include "common/config/cast.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/net/blob.h"
#include "common/place/water.h"
#include "common/units/error.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"

namespace aquarama {

namespace {

// The first show of a species on this machine simulates it; later ones find what it swam.
ByteVector capturedOnce(const CastSpecies& member) {
    ProgressBar bar("capturing " + member.species.name);
    const auto cache = defaultBlobDirectory().parent_path() / "repertoires";
    return repertoireFor(member.text, member.path, cache, [&](double share) { bar.show(share); });
}

FishLengths lengthsOf(const SizeRange& size) {
    return {.meanMetres = static_cast<float>(size.meanMetres),
            .deviationMetres = static_cast<float>(size.deviationMetres),
            .leastMetres = static_cast<float>(size.leastMetres),
            .mostMetres = static_cast<float>(size.mostMetres)};
}

std::size_t fishIn(const Scene& scene) {
    return std::accumulate(scene.cast.begin(),
                           scene.cast.end(),
                           std::size_t{0},
                           [](std::size_t sum, const auto& each) { return sum + each.fish; });
}

}  // namespace

StagedSpecies stagedSpecies(const std::string& text,
                            const std::string& source,
                            ByteVector repertoire,
                            const CastMember& member) {
    const Species species = parseSpecies(text, source);
    const auto bytes = std::as_bytes(std::span{text});
    return {.species = {.tables = makeMotorTables(decodeRepertoire(repertoire, source)),
                        .fish = member.fish,
                        .lengths = lengthsOf(species.size),
                        .name = species.name,
                        .habits = species.habits,
                        .start = member.start},
            .speciesBlob = {bytes.begin(), bytes.end()},
            .repertoireBlob = std::move(repertoire)};
}

Staging stageScene(const std::string& scenePath, std::optional<std::uint32_t> fish) {
    Staging staging{readScene(scenePath), {}};
    CastMember& school = staging.scene.cast.front();
    school.fish = fish.value_or(school.fish);
    if (school.fish == 0 && staging.scene.place != PlaceKind::OpenSea)
        throw Error(scenePath + ": a reef's school needs a fish; take an OPEN_SEA for none");
    const std::vector<CastSpecies> read = readCastSpecies(staging.scene, scenePath);
    checkRoom(staging.scene,
              scenePath,
              fishIn(staging.scene),
              static_cast<float>(read.front().species.size.meanMetres));
    for (std::size_t i = 0; i < read.size(); ++i)
        staging.cast.push_back(stagedSpecies(
            read[i].text, read[i].path, capturedOnce(read[i]), staging.scene.cast[i]));
    return staging;
}

WorldOptions worldOptionsOf(const Staging& staging, std::uint32_t seed) {
    WorldOptions world;
    world.seed = seed;
    world.scene = staging.scene;
    for (const StagedSpecies& member : staging.cast) world.cast.push_back(member.species);
    // One core moves a few thousand fish well inside a tick; more threads would only wait for each
    // other.
    world.threads = std::clamp(
        world.cast.front().fish / 2000U, 1U, std::max(std::thread::hardware_concurrency(), 1U));
    return world;
}

}  // namespace aquarama
