// SPDX-License-Identifier: Apache-2.0
// `aquarama master`: joins a world, living or replayed, to the conductor, which shows it on the
// wall.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/cli/signals.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/net/channels.h"
#include "common/wall/wall.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/conductor/conductor.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"

namespace aquarama {

namespace {

struct MasterOptions {
    supervisor::ShowOptions show;
    bool lockstep = false;
};

// None: the nodes measure which they can draw. In lockstep no clock is read, so nothing is
// measured.
std::optional<config::QualityTier> qualityOf(const config::Rig& rig, const MasterOptions& options) {
    constexpr config::QualityTier kOfLockstep = config::QualityTier::Low;
    if (!options.show.quality.empty()) return config::tierNamed(options.show.quality);
    if (!rig.quality && options.lockstep) return kOfLockstep;
    return rig.quality;
}

// How the conductor runs the frames.
conductor::ConductorOptions conductorOptions(const config::Rig& rig, const MasterOptions& options) {
    conductor::ConductorOptions conductor;
    conductor.quality = qualityOf(rig, options);
    conductor.pace = options.lockstep ? wire::Pace::Lockstep : wire::Pace::Live;
    conductor.pattern = options.show.pattern == "grid"   ? wire::Pattern::Grid
                        : options.show.pattern == "grey" ? wire::Pattern::Grey
                                                         : wire::Pattern::World;
    conductor.frames = options.show.frames;
    conductor.traceDirectory = options.show.traceFolder;
    return conductor;
}

// What is shown: the living world, or `simulation` as a decorator of it, which records or replays.
struct Shown {
    const wire::AssetBundle& assets;
    const simulation::LivingWorld& world;
    conductor::Simulation& simulation;
};

// Returns when the show is over. Until then `*running` is its conductor.
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

// A new world, recorded where that is asked for.
void showNew(const config::Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<net::MasterChannels> channels) {
    const simulation::Assets assets = simulation::readAssets(
        options.show.scenePath.empty() ? config::scenePathOf(rig, options.show.rigPath)
                                       : options.show.scenePath,
        {.seed = options.show.seed, .fish = options.show.fish});
    simulation::LivingWorld world(simulation::worldOptionsOf(assets));
    const conductor::ConductorOptions conducting = conductorOptions(rig, options);
    if (options.show.recordPath.empty())
        return show(rig, conducting, {assets.bytes, world, world}, std::move(channels));
    simulation::RecordingFile file(options.show.recordPath, assets.bytes);
    simulation::RecordedWorld recorded(world, file);
    show(rig, conducting, {assets.bytes, world, recorded}, std::move(channels));
}

// A recording; the show ends with it.
void showAgain(const config::Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<net::MasterChannels> channels) {
    const wire::Recording recording = wire::readRecording(options.show.replayPath);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        logWarning("{}: {}", options.show.replayPath, doubt);
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    // In lockstep the world runs ahead of the frames, so the frames are counted instead.
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

// Binds the addresses before it makes the world, which takes seconds: a second master of the rig is
// refused at once.
void runMaster(const MasterOptions& options) {
    cli::holdSignals();
    const config::Rig rig = config::readRig(options.show.rigPath);
    wall::checkGeometry(rig, options.show.rigPath);
    cli::requireFolder("--trace", options.show.traceFolder);
    if (!options.show.recordPath.empty()) simulation::requireNewRecording(options.show.recordPath);
    cli::requireFile("--record", options.show.recordPath);
    auto channels =
        net::bindMaster(rig.controlAddress, rig.stateAddress, {}, masterKeysOf(rig, options.show));
    (options.show.replayPath.empty() ? showNew : showAgain)(rig, options, std::move(channels));
}

}  // namespace

void addMaster(CommandLine& line) {
    const auto [command, options] = line.add<MasterOptions>(
        "master", "the master of a rig, alone: aquarama master RIG", runMaster);
    describeWorld(command, options.show);
    describeWall(command, options.show);
    command.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    command.add_option("--replay", options.show.replayPath, "show this recording")
        ->excludes("--record")
        ->excludes("--seed")
        ->excludes("--scene")
        ->excludes("--fish");
}

}  // namespace aquarama
