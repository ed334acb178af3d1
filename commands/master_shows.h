// SPDX-License-Identifier: Apache-2.0
// Makes the world of a show, new, journalled, recorded or replayed, and shows it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "commands/master_options.h"
#include "common/net/channels.h"
#include "common/wire/recording.h"
#include "master/conductor/conductor.h"
#include "master/conductor/journal_report.h"
#include "master/journal/journal.h"

namespace aquarama {

// The simulation that is shown: the living world, or `simulation`, a decorator that records or
// replays it.
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
          conductor::Conductor** running = nullptr);

// Where the worlds of a show are journalled, as long as the lock is held; or why they are not.
struct JournalPlace {
    std::filesystem::path folder;
    std::shared_ptr<journal::FolderLock> lock;
    std::shared_ptr<const conductor::JournalReport> absence;  // null: they are
};

// Makes the worlds of other scenes, in the journal where there is one.
[[nodiscard]] std::function<conductor::NextWorld(const std::string& scene)> worldsOf(
    const config::Rig& rig, const supervisor::ShowOptions& options, const JournalPlace& place);

// Shows a new world, or the one of the show's journal; records it where that is asked for.
void showNew(const config::Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<net::MasterChannels> channels);
// Shows a recording; the show ends with it.
void showAgain(const config::Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<net::MasterChannels> channels);

// The first tick that a recording can show, at or after this one: that of a journal may begin with
// a save of a world that had lived before.
[[nodiscard]] Tick firstShown(const wire::Recording& recording, Tick from);

}  // namespace aquarama
