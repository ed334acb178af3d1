// SPDX-License-Identifier: Apache-2.0
// The commands of `aquarama`: each function adds one to the command line, with its options and what
// it does. What several commands share is here as well.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/units.h"
#include "common/cli/commands.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "master/supervisor/supervise.h"

namespace aquarama::ask {
class RequestClient;
}

namespace aquarama {

using cli::AddedCommand;
using cli::CommandLine;

// Each adds one command, in the order of the program's help, which says what the command does.
void addRun(CommandLine& line);      // a show on this machine
void addReplay(CommandLine& line);   // a recorded one
void addMaster(CommandLine& line);   // the master alone
void addStandby(CommandLine& line);  // the master that takes over
void addNode(CommandLine& line);     // hands over to aquarama-node
void addKeyCommands(CommandLine& line);
void addNodes(CommandLine& line);
void addHall(CommandLine& line);
void addRig(CommandLine& line);
void addRelease(CommandLine& line);
void addDepotCommands(CommandLine& line, CLI::App& release);  // of the command `release`
void addDoctor(CommandLine& line);
void addTour(CommandLine& line);
void addPoweroff(CommandLine& line);
void addSchedule(CommandLine& line);
void addStatus(CommandLine& line);
void addSet(CommandLine& line);
void addPilot(CommandLine& line);
void addExplain(CommandLine& line);
void addNewRig(CommandLine& line);
void addCheck(CommandLine& line);  // hands over to aquarama-compose
void addView(
    CommandLine& line);  // hands over to aquarama-compose, as does its former name "theatre"
void addCalibrate(CommandLine& line);  // hands over to aquarama-calibrate
void addCalibrations(CommandLine& line);
void addDrift(CommandLine& line);  // hands over to aquarama-calibrate
void addAdjust(CommandLine& line);
void addConsole(CommandLine& line);  // hands over to aquarama-console
void addTouch(CommandLine& line);    // hands over to aquarama-console
void addSheets(CommandLine& line);   // hands over to aquarama-drawings
void addGuests(CommandLine& line);   // hands over to aquarama-guests
void addInspect(CommandLine& line);
void addConvert(CommandLine& line);
void addCapture(CommandLine& line);
void addForms(CommandLine& line);
void addExport(CommandLine& line);
void addGaits(CommandLine& line);
void addSearch(CommandLine& line);
void addControllers(CommandLine& line);
void addFidelity(CommandLine& line);
void addStudy(CommandLine& line);
void addMerge(CommandLine& line);
void addStudyWall(CommandLine& line, CLI::App& studies);  // of the command `study`

// Options that `run`, `replay` and `master` share: which rig shows which world, and how.
void describeWorld(CLI::App& command, supervisor::ShowOptions& options);
void describeWall(CLI::App& command, supervisor::ShowOptions& options);

// The keys of a master that listens on a network; empty where the rig needs none. Throws Error
// where the rig has no keys yet.
[[nodiscard]] std::optional<net::MasterKeys> masterKeysOf(const config::Rig& rig,
                                                          const supervisor::ShowOptions& show);

// The public key of the program that serves visitors, which nodes must know to bring it pictures;
// empty where the rig needs none, has no guests, or no key of theirs yet, of which the log warns.
[[nodiscard]] std::string guestsKeyOf(const config::Rig& rig, const supervisor::ShowOptions& show);

// A connection for requests to the master of a rig, with the operator's key of this folder (empty:
// the user's) where the rig needs one. Throws Error where the key cannot be read.
[[nodiscard]] ask::RequestClient connectToMaster(const std::string& rigPath,
                                                 const std::string& keyFolder);

// Replays a recording without a wall and tells whether the world is the same. Returns the exit
// status: 1 where it differs. Throws Error where it cannot be read.
[[nodiscard]] int checkReplay(const std::string& path, Tick from);

// The option --config, and the folder that it names or that is found.
void describeConfig(CLI::App& command, std::string& folder);
[[nodiscard]] std::filesystem::path configFolder(const std::string& given);

}  // namespace aquarama
