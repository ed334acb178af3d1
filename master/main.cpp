// SPDX-License-Identifier: Apache-2.0
// The master of a rig: wires the world to the conductor.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/program.h"
#include "common/cli/signals.h"
#include "common/config/cast.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/units/error.h"
#include "common/units/log.h"
#include "common/wall/wall.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/conductor/conductor.h"
#include "master/simulation/assets.h"
#include "master/simulation/living_world.h"
#include "master/simulation/playback.h"
#include "master/simulation/recorder.h"

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
std::optional<config::QualityTier> qualityOf(const config::Rig& rig, const MasterOptions& options) {
    constexpr config::QualityTier kOfLockstep = config::QualityTier::Low;
    if (!options.quality.empty()) return config::tierNamed(options.quality);
    if (!rig.quality && options.lockstep) return kOfLockstep;
    return rig.quality;
}

conductor::ConductorOptions conductorOptions(const config::Rig& rig, const MasterOptions& options) {
    conductor::ConductorOptions conductor;
    conductor.quality = qualityOf(rig, options);
    conductor.pace = options.lockstep ? wire::Pace::Lockstep : wire::Pace::Live;
    conductor.pattern = options.pattern == "grid"   ? wire::Pattern::Grid
                        : options.pattern == "grey" ? wire::Pattern::Grey
                                                    : wire::Pattern::World;
    conductor.frames = options.frames;
    conductor.traceDirectory = options.traceFolder;
    return conductor;
}

// What is shown: the living world, or a recorded or replayed one about it.
struct Shown {
    const wire::AssetBundle& assets;
    const simulation::LivingWorld& world;
    conductor::Simulation& simulation;
};

// Returns when the show is over. `running` is the conductor meanwhile.
void show(const config::Rig& rig,
          const conductor::ConductorOptions& options,
          const Shown& shown,
          std::unique_ptr<net::MasterChannels> channels,
          conductor::Conductor** running = nullptr) {
    conductor::Conductor conductor(rig,
                                   options,
                                   shown.simulation,
                                   shown.assets,
                                   shown.world.world().traits(),
                                   std::move(channels));
    if (running != nullptr) *running = &conductor;
    const cli::SignalWatch watch([&] { conductor.stop(); });
    conductor.run();
}

void showNew(const config::Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<net::MasterChannels> channels) {
    const wire::AssetBundle assets = simulation::readAssets(
        options.scenePath.empty() ? config::scenePathOf(rig, options.rigPath) : options.scenePath,
        {.seed = options.seed, .fish = options.fish});
    simulation::LivingWorld world(simulation::worldOptionsOf(assets));
    const conductor::ConductorOptions conducting = conductorOptions(rig, options);
    if (options.recordPath.empty())
        return show(rig, conducting, {assets, world, world}, std::move(channels));
    simulation::RecordingFile file(options.recordPath, assets);
    simulation::RecordedWorld recorded(world, file);
    show(rig, conducting, {assets, world, recorded}, std::move(channels));
}

void showAgain(const config::Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<net::MasterChannels> channels) {
    const wire::Recording recording = wire::readRecording(options.replayPath);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        logWarning("{}: {}", options.replayPath, doubt);
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    // In lockstep the world runs ahead of the frames: there these are counted.
    conductor::Conductor* running = nullptr;
    std::function<void()> onEnd = [&running] { running->stop(); };
    if (options.lockstep) {
        const std::uint64_t frames = recording.lastTick().value + 1;
        conducting.frames = std::min(conducting.frames.value_or(frames), frames);
        onEnd = [] {};
    }
    simulation::ReplayedWorld replayed(recording, world, onEnd);
    show(rig, conducting, {recording.assets, world, replayed}, std::move(channels), &running);
}

void runMaster(const MasterOptions& options) {
    cli::holdSignals();
    const config::Rig rig = config::readRig(options.rigPath);
    wall::checkGeometry(rig, options.rigPath);
    cli::requireFolder("--trace", options.traceFolder);
    if (!options.recordPath.empty()) simulation::requireNewRecording(options.recordPath);
    cli::requireFile("--record", options.recordPath);
    auto channels = net::bindMaster(rig.controlAddress, rig.stateAddress);
    (options.replayPath.empty() ? showNew : showAgain)(rig, options, std::move(channels));
}

void describe(CLI::App& app, MasterOptions& options) {
    app.add_option("RIG", options.rigPath, "the rig's file");
    app.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    app.add_option("--frames", options.frames, "end after so many frames")
        ->check(cli::wholeNumber(1, cli::kMostShownFrames));
    app.add_option("--seed", options.seed, "of the world: the same seed gives the same world")
        ->check(cli::wholeNumber(0, cli::kMostSeed));
    app.add_option("--scene", options.scenePath, "what is shown, instead of the rig's scene");
    app.add_option(
           "--fish", options.fish, "how many of the first species, instead of the scene's number")
        ->check(cli::wholeNumber(0, kMostFish));
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
    cli::Job job = [&] {
        if (options.rigPath.empty()) throw CLI::RequiredError("RIG");
        runMaster(options);
        return 0;
    };
    for (const auto add : {addStatus, addExplain, addPilot, addReplay, addInspect}) add(app, job);
    return cli::runProgram(app, count, arguments, [&] { return job(); });
}
