// SPDX-License-Identifier: Apache-2.0
// The master of a rig: wires the world to the conductor.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/program.h"
#include "common/cli/signals.h"
#include "common/config/cast.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/units/digest.h"
#include "common/units/error.h"
#include "common/units/log.h"
#include "common/wall/wall.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/conductor/conductor.h"
#include "master/production/living_world.h"
#include "master/production/production.h"
#include "master/record/playback.h"
#include "master/record/recorder.h"

namespace aquarama {

namespace {

struct MasterOptions {
    std::string rigPath;
    std::string scenePath;  // empty: the rig's
    bool lockstep = false;
    std::optional<std::uint64_t> frames;
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> fish;
    std::string pattern = "world";
    std::string quality;  // empty: the rig's
    std::string traceFolder;
    std::string recordPath;  // empty: the show is not recorded
    std::string replayPath;  // of the recording that is shown; empty: a new world
};

// No clock is read in lockstep: its tier cannot be measured.
std::optional<QualityTier> qualityOf(const Rig& rig, const MasterOptions& options) {
    constexpr QualityTier kOfLockstep = QualityTier::Low;
    if (!options.quality.empty()) return tierNamed(options.quality);
    if (!rig.quality && options.lockstep) return kOfLockstep;
    return rig.quality;
}

ConductorOptions conductorOptions(const Rig& rig, const MasterOptions& options) {
    ConductorOptions conductor;
    conductor.quality = qualityOf(rig, options);
    conductor.pace = options.lockstep ? Pace::Lockstep : Pace::Live;
    conductor.pattern = options.pattern == "grid"   ? Pattern::Grid
                        : options.pattern == "grey" ? Pattern::Grey
                                                    : Pattern::World;
    conductor.frames = options.frames;
    conductor.seed = options.seed;
    conductor.traceDirectory = options.traceFolder;
    return conductor;
}

// What the nodes are told of the cast, and the blobs that they may then ask for.
std::vector<SpeciesBlobs> castOf(const Production& production, Blobs& blobs) {
    std::vector<SpeciesBlobs> cast;
    for (const ProducedSpecies& species : production.cast) {
        const auto text = std::as_bytes(std::span{species.text});
        cast.push_back({digestOf(text), digestOf(species.repertoire), species.fish});
        blobs.emplace(cast.back().species, ByteVector{text.begin(), text.end()});
        blobs.emplace(cast.back().repertoire, species.repertoire);
    }
    return cast;
}

// What is shown: the living world, or a recorded or replayed one about it.
struct Shown {
    const Production& production;
    const LivingWorld& world;
    Simulation& simulation;
};

// Returns when the show is over. `running` is the conductor meanwhile.
void show(const Rig& rig,
          const ConductorOptions& options,
          const Shown& shown,
          std::unique_ptr<MasterChannels> channels,
          Conductor** running = nullptr) {
    Blobs blobs;
    Welcome welcome;
    welcome.rigText = writeRig(rig);
    welcome.sceneText = shown.production.scene;
    welcome.cast = castOf(shown.production, blobs);
    const auto school = shown.world.world().traits();
    welcome.school.assign(school.begin(), school.end());
    Conductor conductor(
        rig, options, shown.simulation, std::move(welcome), std::move(blobs), std::move(channels));
    if (running != nullptr) *running = &conductor;
    const SignalWatch watch([&] { conductor.stop(); });
    conductor.run();
}

void showNew(const Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<MasterChannels> channels) {
    const Production production = readProduction(
        options.scenePath.empty() ? scenePathOf(rig, options.rigPath) : options.scenePath,
        {.seed = options.seed, .fish = options.fish});
    LivingWorld world(worldOptionsOf(production));
    const ConductorOptions conducting = conductorOptions(rig, options);
    if (options.recordPath.empty())
        return show(rig, conducting, {production, world, world}, std::move(channels));
    RecordingFile file(options.recordPath, production);
    RecordedWorld recorded(world, file);
    show(rig, conducting, {production, world, recorded}, std::move(channels));
}

void showAgain(const Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<MasterChannels> channels) {
    const Recording recording = readRecording(options.replayPath);
    for (const std::string& doubt : doubtsAbout(recording))
        logWarning("{}: {}", options.replayPath, doubt);
    LivingWorld world(worldOptionsOf(recording.production));
    ConductorOptions conducting = conductorOptions(rig, options);
    conducting.seed = recording.production.seed;
    // In lockstep the world runs ahead of the frames: there these are counted.
    Conductor* running = nullptr;
    std::function<void()> onEnd = [&running] { running->stop(); };
    if (options.lockstep) {
        const std::uint64_t frames = recording.lastTick().value + 1;
        conducting.frames = std::min(conducting.frames.value_or(frames), frames);
        onEnd = [] {};
    }
    ReplayedWorld replayed(recording, world, onEnd);
    show(rig, conducting, {recording.production, world, replayed}, std::move(channels), &running);
}

void runMaster(const MasterOptions& options) {
    holdSignals();
    const Rig rig = readRig(options.rigPath);
    checkGeometry(rig, options.rigPath);
    requireFolder("--trace", options.traceFolder);
    if (!options.recordPath.empty()) requireNewRecording(options.recordPath);
    requireFile("--record", options.recordPath);
    auto channels = bindMaster(rig.controlAddress, rig.stateAddress);
    (options.replayPath.empty() ? showNew : showAgain)(rig, options, std::move(channels));
}

void describe(CLI::App& app, MasterOptions& options) {
    app.add_option("RIG", options.rigPath, "the rig's file");
    app.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    app.add_option("--frames", options.frames, "end after so many frames")
        ->check(wholeNumber(1, kMostShownFrames));
    app.add_option("--seed", options.seed, "of the world: the same seed gives the same world")
        ->check(wholeNumber(0, kMostSeed));
    app.add_option("--scene", options.scenePath, "what is shown, instead of the rig's scene");
    app.add_option(
           "--fish", options.fish, "how many of the first species, instead of the scene's number")
        ->check(wholeNumber(0, kMostFish));
    app.add_option("--pattern", options.pattern, "what the channels show")
        ->check(CLI::IsMember({"world", "grid", "grey"}));
    app.add_option("--quality", options.quality, "how fine the wall is drawn, instead of the rig's")
        ->check(CLI::IsMember({"low", "medium", "high", "ultra"}));
    app.add_option(
        "--trace", options.traceFolder, "folder for master.csv: a line of times a frame");
    app.add_option("--record", options.recordPath, "write the show to this new file");
    app.add_option("--replay", options.replayPath, "show this recording")
        ->excludes("--record")
        ->excludes("--seed")
        ->excludes("--scene")
        ->excludes("--fish");
}

}  // namespace

}  // namespace aquarama

int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app{"The master of a rig: moves every fish, and has all nodes present in step",
                 "aquarama-master"};
    MasterOptions options;
    describe(app, options);
    Job job = [&] {
        if (options.rigPath.empty()) throw CLI::RequiredError("RIG");
        runMaster(options);
        return 0;
    };
    for (const auto add : {addStatus, addExplain, addPilot, addReplay, addInspect}) add(app, job);
    return runProgram(app, count, arguments, [&] { return job(); });
}
