// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/living_world.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/config/cast.h"
#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/files/files.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/place/water.h"
#include "common/units/log.h"
#include "common/wire/food_record.h"
#include "master/capture/capture_repertoire.h"
#include "master/simulation/insight.h"

namespace aquarama::simulation {

namespace {

// The kind of a particle as the wire names it.
wire::FoodRecord::Kind kindOf(surroundings::FoodKind kind) {
    switch (kind) {
        case surroundings::FoodKind::Plankton:
            return wire::FoodRecord::Kind::Plankton;
        case surroundings::FoodKind::Pellet:
            return wire::FoodRecord::Kind::Pellet;
        case surroundings::FoodKind::None:
            break;
    }
    return wire::FoodRecord::Kind::None;
}

}  // namespace

LivingWorld::LivingWorld(const world::WorldOptions& options) : world_(options) {
    for (const world::WorldSpecies& species : options.cast) species_.push_back(species.name);
}

// All particles as they are published: relative to the middle of the water, so that few bits
// suffice.
void LivingWorld::food(wire::FoodCloud& cloud) const {
    const surroundings::Food& food = world_.surroundings().food;
    cloud.originMetres = world_.surroundings().obstacles.water.centre;
    cloud.particles.resize(food.size());
    for (std::size_t i = 0; i < food.size(); ++i)
        cloud.particles[i] = wire::foodRecord(
            kindOf(food.kind[i]), food.position(i) - cloud.originMetres, food.generation[i]);
}

// The wall is the submarine's window: its attitude is that of the wall.
wire::Eye LivingWorld::eye() const {
    const surroundings::Vessel& vessel = world_.pilot().vessel;
    const motion::Quaternion q = surroundings::worldFromBody(vessel.attitude);
    return {.positionMetres = vessel.position, .worldFromWall = {q.w, q.x, q.y, q.z}};
}

wire::Explanation LivingWorld::explain(std::uint32_t fish) const {
    wire::Explanation explanation{
        fish, static_cast<std::uint32_t>(world_.traits().size()), world_.tick(), {}};
    if (const auto insight = insightInto(world_, fish))
        explanation.lines = linesOf(*insight, {world_.view(), species_});
    return explanation;
}

namespace {

// Fish for each thread. One core moves a few thousand fish well within a tick; with more threads
// each would mostly wait for the others.
constexpr std::uint32_t kFishOfAThread = 2000;

// The repertoires of the cast, from the cache or by simulation. Throws Error with the first
// failure.
std::vector<capture::RepertoireFile> capturedOnce(const std::vector<config::CastSpecies>& cast) {
    std::vector<capture::SpeciesText> texts;
    for (const config::CastSpecies& member : cast) texts.push_back({member.path, member.text});
    capture::ProgressBar bar("capturing");
    std::vector<capture::RepertoireFile> files =
        capture::repertoiresFor(texts,
                                files::cacheFolder() / "repertoires",
                                {.progress = [&](double share) { bar.show(share); }});
    // A species that cannot be captured has an error instead of bytes.
    for (const capture::RepertoireFile& file : files)
        if (!file.error.empty()) throw Error(file.error);
    return files;
}

// Parses one species and decodes its repertoire.
world::WorldSpecies worldSpeciesOf(const wire::SpeciesAssets& produced,
                                   const std::optional<config::Start>& start) {
    const config::Species species = config::parseSpecies(produced.text, produced.file);
    return {.tables = motion::makeMotorTables(
                motion::decodeRepertoire(produced.repertoire, produced.file)),
            .fish = produced.fish,
            .size = species.size,
            .name = species.name,
            .habits = species.habits,
            .start = start};
}

std::uint32_t fishIn(const config::Scene& scene) {
    std::uint32_t fish = 0;
    for (const config::CastMember& member : scene.cast) fish += member.fish;
    return fish;
}

// The scene, with the chosen number of fish of its first species.
config::Scene chosenScene(const std::string& path, const AssetChoice& choice) {
    config::Scene scene = config::readScene(path);
    config::CastMember& school = scene.cast.front();
    school.fish = choice.fish.value_or(school.fish);
    if (school.fish == 0 && scene.place != config::PlaceKind::OpenSea)
        throw Error(config::placed(
            path, school.place, "0 fish: only an open sea may be without; take another --scene"));
    return scene;
}

}  // namespace

wire::AssetBundle readAssets(const std::string& scenePath, const AssetChoice& choice) {
    const config::Scene scene = chosenScene(scenePath, choice);
    const std::vector<config::CastSpecies> cast = config::readCastSpecies(scene, scenePath);
    assert(cast.size() == scene.cast.size());
    // Throws Error where the scene has too little water for its fish.
    place::checkRoom(scene, scenePath, fishIn(scene), cast.front().species.size.meanMetres);
    wire::AssetBundle assets{.seed = choice.seed,
                             .sceneFile = scenePath,
                             .scene = config::writeScene(scene),
                             .cast = {}};
    std::vector<capture::RepertoireFile> captured = capturedOnce(cast);
    assert(captured.size() == cast.size());
    for (std::size_t i = 0; i < cast.size(); ++i)
        assets.cast.push_back(
            {cast[i].path, cast[i].text, std::move(captured[i].bytes), scene.cast[i].fish});
    return assets;
}

world::WorldOptions worldOptionsOf(const wire::AssetBundle& assets) {
    world::WorldOptions options;
    options.seed = assets.seed;
    options.scene = config::parseScene(assets.scene, assets.sceneFile);
    if (options.scene.cast.size() != assets.cast.size())
        throw Error(assets.sceneFile + ": its cast has " +
                    std::to_string(options.scene.cast.size()) + " members, and there are " +
                    std::to_string(assets.cast.size()) + " species with it");
    for (std::size_t i = 0; i < assets.cast.size(); ++i)
        options.cast.push_back(worldSpeciesOf(assets.cast[i], options.scene.cast[i].start));
    // One thread for every kFishOfAThread, at least one, at most one for each core.
    options.threads = std::clamp(fishIn(options.scene) / kFishOfAThread,
                                 1U,
                                 std::max(std::thread::hardware_concurrency(), 1U));
    return options;
}

}  // namespace aquarama::simulation
