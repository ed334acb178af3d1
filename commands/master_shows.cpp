// SPDX-License-Identifier: Apache-2.0
#include "commands/master_shows.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/base/amounts.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "master/conductor/preparation.h"
#include "master/journal/journalled_world.h"
#include "master/simulation/recorded_world.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Answers requests while the master's world is made, and notifies the service manager.
class WorldPreparation {
  public:
    WorldPreparation(net::MasterChannels& channels, machine::ServiceNotifier* service)
        : answers_{channels}, service_{service} {}
    ~WorldPreparation() {
        if (service_ != nullptr) service_->endLongWork();
    }
    WorldPreparation(const WorldPreparation&) = delete;
    WorldPreparation& operator=(const WorldPreparation&) = delete;
    // Any thread, but never two at once.
    void tell(const std::string& what) {
        const std::string sentence = answers_.tell(what);
        if (service_ != nullptr) service_->beginLongWork(sentence);
    }

  private:
    conductor::Preparation answers_;
    machine::ServiceNotifier* service_;
};

// Of a show that keeps no journal because of its kind.
std::shared_ptr<const conductor::JournalReport> noJournal(const std::string& why) {
    return std::make_shared<conductor::JournalReport>(v1::JournalStatus::NOT_KEPT, why);
}

// Shows a new world and records it.
void showRecorded(const config::Rig& rig,
                  const MasterOptions& options,
                  const simulation::Assets& assets,
                  conductor::ConductorOptions conducting,
                  std::unique_ptr<net::MasterChannels> channels) {
    conducting.whyOneScene = "the show is recorded, and a recording has one scene";
    conducting.journal = noJournal("the show is recorded to " + options.show.recordPath);
    simulation::LivingWorld world(simulation::worldOptionsOf(assets));
    simulation::RecordingFile file(options.show.recordPath, assets.bytes);
    {
        simulation::RecordedWorld recorded(world, file);
        show(rig, conducting, {assets.bytes, world, recorded}, std::move(channels));
    }
    file.close();
}

// A world of a scene, in its journal where there is one. `made` is within `simulation`.
struct MadeWorld {
    std::unique_ptr<conductor::Simulation> simulation;
    const simulation::LivingWorld* made = nullptr;
    std::shared_ptr<const conductor::JournalReport> journal;
};
MadeWorld makeWorld(const simulation::Assets& assets,
                    const JournalPlace& place,
                    journal::TimeAway away) {
    if (place.absence) {
        auto world = std::make_unique<simulation::LivingWorld>(simulation::worldOptionsOf(assets));
        const simulation::LivingWorld* const made = world.get();
        return {std::move(world), made, place.absence};
    }
    auto world = journal::makeJournalled(place.folder, assets, away);
    const simulation::LivingWorld* const made = &world->living();
    auto report = world->journal().report();
    return {std::move(world), made, std::move(report)};
}

// A show in lockstep keeps no journal, nor does one where another show of the rig holds the folder.
JournalPlace placeOfJournal(const MasterOptions& options) {
    if (options.lockstep) return {{}, {}, noJournal("the show is in lockstep")};
    const fs::path folder = wire::journalOf(options.show.rigPath);
    try {
        return {folder, std::make_shared<journal::FolderLock>(folder), {}};
    } catch (const Error& problem) {
        logWarning("{}; this one keeps none", problem.what());
        return {
            {},
            {},
            std::make_shared<conductor::JournalReport>(v1::JournalStatus::REFUSED, problem.what())};
    }
}

}  // namespace

void show(const config::Rig& rig,
          const conductor::ConductorOptions& options,
          const Shown& shown,
          std::unique_ptr<net::MasterChannels> channels,
          conductor::Conductor** running) {
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

std::function<conductor::NextWorld(const std::string& scene)> worldsOf(
    const config::Rig& rig, const supervisor::ShowOptions& options, const JournalPlace& place) {
    return [rig, place, options](const std::string& scene) {
        simulation::Assets next =
            simulation::readAssets(sceneFile(rig, options.rigPath, scene), choiceOf(rig, options));
        MadeWorld made = makeWorld(next, place, journal::TimeAway::LeftOut);
        const auto traits = made.made->world().traits();
        return conductor::NextWorld{std::move(next.bytes),
                                    {traits.begin(), traits.end()},
                                    std::move(made.simulation),
                                    std::move(made.journal)};
    };
}

void showNew(const config::Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<net::MasterChannels> channels) {
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    std::optional<WorldPreparation> preparation(std::in_place, *channels, options.service);
    simulation::AssetChoice choice = choiceOf(rig, options.show);
    choice.fish = options.show.fish;
    choice.tell = [&](const std::string& what) { preparation->tell(what); };
    const simulation::Assets assets = simulation::readAssets(
        sceneFile(rig, options.show.rigPath, conducting.wanted.scene()), choice);
    preparation->tell("making the world");
    if (!options.show.recordPath.empty()) {
        preparation.reset();
        return showRecorded(rig, options, assets, std::move(conducting), std::move(channels));
    }
    const JournalPlace place = placeOfJournal(options);
    using journal::TimeAway;
    const TimeAway away = conducting.wanted.freeze() ? TimeAway::LeftOut : TimeAway::MadeUpFor;
    const MadeWorld world = makeWorld(assets, place, away);
    preparation.reset();
    conducting.journal = world.journal;
    conducting.looks.makeWorld = worldsOf(rig, options.show, place);
    show(rig, conducting, {assets.bytes, *world.made, *world.simulation}, std::move(channels));
}

Tick firstShown(const wire::Recording& recording, Tick from) {
    return recording.beginsWithSave ? std::max(from, recording.saves.front().tick) : from;
}

void showAgain(const config::Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<net::MasterChannels> channels) {
    std::optional<WorldPreparation> preparation(std::in_place, *channels, options.service);
    preparation->tell("reading the recording");
    const wire::Recording recording = wire::readRecording(options.show.replayPath);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        logWarning("{}: {}", options.show.replayPath, doubt);
    const Tick from = firstShown(recording, Tick{options.show.replayFromTick});
    if (from > recording.lastTick())
        throw Error(options.show.replayPath + ": ends after " + timeOf(recording.lastTick()) +
                    "; begin --at an earlier time");
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    preparation->tell("going to " + timeOf(from));
    conductor::Conductor* running = nullptr;
    const auto onEnd = [&] {
        if (!options.lockstep) running->stop();
    };
    simulation::ReplayedWorld replayed(recording, world, from, onEnd);
    preparation.reset();
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    conducting.whyOneScene = "a recording is shown, and has one scene";
    conducting.journal = noJournal("a recording is shown");
    // In lockstep the world runs ahead of the frames, so the frames are counted instead.
    if (options.lockstep) {
        const std::uint64_t frames = recording.lastTick().value + 1 - from.value;
        conducting.frames = std::min(conducting.frames.value_or(frames), frames);
    }
    show(rig, conducting, {recording.assets, world, replayed}, std::move(channels), &running);
}

}  // namespace aquarama
