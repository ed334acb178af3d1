// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/living_world.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "capture/repertoire_files.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/progress.h"
#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/place/place.h"
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

// A particle as it is sent to the nodes.
wire::FoodCloud foodOf(const surroundings::Surroundings& around) {
    const surroundings::Food& food = around.food;
    wire::FoodCloud cloud{around.obstacles.water.centre, {}};
    cloud.particles.reserve(food.size());
    for (std::size_t i = 0; i < food.size(); ++i)
        cloud.particles.push_back(wire::foodRecord(
            kindOf(food.kind[i]), food.position(i) - cloud.originMetres, food.generation[i]));
    return cloud;
}

wire::Eye eyeOf(const surroundings::Vessel& vessel) {
    const motion::Quaternion q = surroundings::worldFromBody(vessel.attitude);
    return {.positionMetres = vessel.position, .worldFromWall = {q.w, q.x, q.y, q.z}};
}

// Fish for each thread. One core moves a few thousand fish well within a tick; with more threads
// each would mostly wait for the others.
constexpr std::uint32_t kFishOfAThread = 2000;

// The repertoires of the cast, from the cache or by simulation. Throws Error with the first
// failure.
std::vector<capture::RepertoireFile> capturedOnce(
    const std::vector<config::Species>& species,
    const std::function<void(const std::string&)>& tell) {
    cli::Progress bar("capturing");
    std::string what;
    int told = -1;  // per cent
    const auto show = [&](double share) {
        bar.show(share);
        const int percent = static_cast<int>(100 * share);
        if (tell && percent != std::exchange(told, percent))
            tell(fmt::format("{}, {} %", what, percent));
    };
    const auto begin = [&](std::size_t missing) {
        what = fmt::format("capturing {} of {} species", missing, species.size());
        logInfo("{}: once on this machine, it takes minutes", what);
        show(0);
    };
    std::vector<capture::RepertoireFile> files = capture::repertoiresFor(
        species, capture::repertoireFolders(), {.progress = show, .begins = begin});
    // A species that cannot be captured has an error instead of bytes.
    for (const capture::RepertoireFile& file : files)
        if (!file.error.empty()) throw Error(file.error);
    return files;
}

// Puts repertoires in place of those that a journal only names. Throws Error where this build
// captures others.
void captureNamed(Assets& assets) {
    const auto isNamed = [](const wire::SpeciesAssets& one) {
        return one.repertoireDigest && one.repertoire.empty();
    };
    if (std::ranges::none_of(assets.bytes.cast, isNamed)) return;
    std::vector<capture::RepertoireFile> captured = capturedOnce(assets.species, {});
    for (std::size_t i = 0; i < captured.size(); ++i) {
        wire::SpeciesAssets& bytes = assets.bytes.cast[i];
        if (digestOf(captured[i].bytes) != bytes.repertoireDigest)
            throw Error(bytes.file + ": this build captures another repertoire than the journal's");
        bytes.repertoire = std::move(captured[i].bytes);
    }
}

// How many fish of a species wait for visitors' drawings: twice an equal share of them, as not all
// species are chosen alike.
std::uint32_t slotsOf(const std::string& species, const AssetChoice& choice) {
    if (std::ranges::find(choice.drawnSpecies, species) == choice.drawnSpecies.end()) return 0;
    const auto kinds = static_cast<std::uint32_t>(choice.drawnSpecies.size());
    return std::min(choice.mostDrawings, (2 * choice.mostDrawings + kinds - 1) / kinds);
}

// The scene, with the chosen number of fish of its first species.
config::Scene chosenScene(const std::string& path, const AssetChoice& choice) {
    config::Scene scene = config::readScene(path);
    config::CastMember& school = scene.cast.front();
    school.fish = choice.fish.value_or(school.fish);
    const auto refuse = [&](const std::string& why) {
        throw Error(config::placed(path, school.place, why));
    };
    if (school.fish == 0 && scene.place != config::PlaceKind::OpenSea)
        refuse("0 fish: only an open sea may be without; take another --scene");
    if (config::fishIn(scene) > kMostFish)
        refuse("more than " + std::to_string(kMostFish) + " fish together: take fewer --fish");
    return scene;
}

}  // namespace

LivingWorld::LivingWorld(const world::WorldOptions& options) : world_(options) {
    std::uint32_t next = 0;
    for (const world::WorldSpecies& species : options.cast) {
        species_.push_back(species.name);
        rates_.push_back(school::recordedRates(*species.tables, next, next + species.fish));
        next += species.fish;
    }
}

conductor::Snapshot LivingWorld::snapshot() const {
    conductor::Snapshot snapshot{.tick = world_.tick(),
                                 .hash = world_.hash(),
                                 .eye = eyeOf(world_.pilot().vessel),
                                 .timeOfDay = static_cast<float>(world_.surroundings().timeOfDay),
                                 .fish = {},
                                 .food = foodOf(world_.surroundings()),
                                 .commands = world_.commands(),
                                 .placed = {world_.placed().begin(), world_.placed().end()}};
    world_.records(snapshot.fish);
    return snapshot;
}

std::vector<conductor::DrawingSlots> LivingWorld::drawingSlots() const {
    std::vector<conductor::DrawingSlots> slots;
    const fish::Wearers* const wearers = world_.environment().wearers;
    if (wearers == nullptr) return slots;
    for (const fish::SlotRange& range : wearers->ranges) {
        slots.push_back({species_.at(range.kind), range.first, range.last, {}});
        for (std::uint32_t fish = range.first; fish < range.last; ++fish) {
            const fish::Wearer& wearer = *wearers->of(fish);
            slots.back().worn.push_back(wearer.visit == fish::Visit::Leaves ? 0 : wearer.number);
        }
    }
    return slots;
}

std::vector<conductor::Hunter> LivingWorld::hunters() const {
    std::vector<conductor::Hunter> hunters;
    for (const fish::SpeciesParameters& species : world_.speciesParameters())
        if (fish::patrols(species) && species.first < species.last)
            hunters.push_back({species_.at(species.kind), species.kind});
    return hunters;
}

conductor::Explanation LivingWorld::explain(std::uint32_t fish) const {
    const auto insight = insightInto(world_, fish);
    return insight ? explanationOf(*insight, {world_.view(), species_}) : conductor::Explanation{};
}

Assets readAssets(const std::string& scenePath, const AssetChoice& choice) {
    // Member by member: where an initialiser of an aggregate throws, GCC 12 destroys the members
    // before it twice.
    Assets assets;
    assets.scene = chosenScene(scenePath, choice);
    assets.bytes.seed = choice.seed;
    assets.bytes.sceneFile = scenePath;
    assets.bytes.drawingsMayBeEaten = choice.drawingsMayBeEaten;
    const config::Scene& scene = assets.scene;
    assets.bytes.scene = scene.text;
    for (config::CastSpecies& member : config::readCastSpecies(scene, scenePath)) {
        config::CastMember& cast = assets.scene.cast[assets.species.size()];
        const std::uint32_t drawings = slotsOf(member.species.name, choice);
        cast.fish += drawings;
        assets.bytes.cast.push_back({member.path, member.species.text, {}, cast.fish, drawings});
        assets.species.push_back(std::move(member.species));
    }
    for (const std::string& name : choice.drawnSpecies)
        if (std::ranges::find(assets.species, name, &config::Species::name) == assets.species.end())
            logInfo("the scene has no {}: drawings of it wait for a scene that has", name);
    place::checkRoom(
        scene, scenePath, config::fishIn(scene), assets.species.front().size.meanMetres);
    std::vector<capture::RepertoireFile> captured = capturedOnce(assets.species, choice.tell);
    for (std::size_t i = 0; i < captured.size(); ++i)
        assets.bytes.cast[i].repertoire = std::move(captured[i].bytes);
    return assets;
}

world::WorldOptions worldOptionsOf(const Assets& assets) {
    assert(assets.species.size() == assets.scene.cast.size());
    assert(assets.species.size() == assets.bytes.cast.size());
    world::WorldOptions options;
    options.seed = assets.bytes.seed;
    options.scene = assets.scene;
    options.drawingsMayBeEaten = assets.bytes.drawingsMayBeEaten;
    for (std::size_t i = 0; i < assets.species.size(); ++i) {
        const wire::SpeciesAssets& bytes = assets.bytes.cast[i];
        const config::Species& species = assets.species[i];
        options.cast.push_back({.tables = motion::makeMotorTables(
                                    motion::decodeRepertoire(bytes.repertoire, bytes.file)),
                                .fish = bytes.fish,
                                .drawings = bytes.drawings,
                                .size = species.size,
                                .name = species.name,
                                .habits = species.habits,
                                .start = assets.scene.cast[i].start,
                                .homes = assets.scene.cast[i].homes});
    }
    options.threads = std::clamp(config::fishIn(options.scene) / kFishOfAThread,
                                 1U,
                                 std::max(std::thread::hardware_concurrency(), 1U));
    return options;
}

world::WorldOptions worldOptionsOf(const wire::AssetBundle& recorded) {
    Assets assets;
    assets.bytes = recorded;
    assets.scene = config::parseScene(recorded.scene, recorded.sceneFile);
    if (assets.scene.cast.size() != recorded.cast.size())
        throw Error(recorded.sceneFile + ": its cast has " +
                    std::to_string(assets.scene.cast.size()) + " members, and there are " +
                    std::to_string(recorded.cast.size()) + " species with it");
    for (const wire::SpeciesAssets& species : recorded.cast) {
        assets.scene.cast[assets.species.size()].fish = species.fish;
        assets.species.push_back(config::parseSpecies(species.text, species.file));
    }
    captureNamed(assets);
    return worldOptionsOf(assets);
}

}  // namespace aquarama::simulation
