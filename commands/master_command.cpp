// SPDX-License-Identifier: Apache-2.0
// `aquarama master` and `aquarama standby`: they bind the rig's addresses and open the log, then
// one kind of show runs.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/commands.h"
#include "commands/master_options.h"
#include "commands/master_shows.h"
#include "commands/standby_master.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/net/channels.h"
#include "common/wall/wall.h"
#include "master/simulation/recording_file.h"
#include "master/supervisor/children.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Starts this program anew, as it was started: as a standby of the machine that is the master now.
[[noreturn]] void startAnew() {
    std::ifstream file("/proc/self/cmdline");
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');)
        arguments.push_back(std::move(argument));
    arguments.erase(arguments.begin());
    supervisor::become({supervisor::ownProgram(), arguments});
}

// Opens the log of this rig's shows, which also gets the master's own lines. Where it cannot be
// written, the show runs without it.
std::shared_ptr<LogFile> openLog(const std::string& rigPath) {
    const fs::path path = userFolder("XDG_STATE_HOME", ".local/state") / "logs" /
                          (fs::path(rigPath).stem().string() + ".jsonl");
    try {
        auto log = std::make_shared<LogFile>(path);
        setLogListener([log](Severity severity, const std::string& line) {
            log->write("master", log->masterFrame, severity, line);
        });
        return log;
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
        return nullptr;
    }
}

// Throws Error also where the rig names no standby and this is to be one.
std::unique_ptr<net::MasterChannels> bindOwn(const config::Rig& rig, const MasterOptions& options) {
    const auto keys = masterKeysOf(rig, options.show);
    if (!options.standsBy) return net::bindMaster(rig.controlAddress, rig.stateAddress, {}, keys);
    if (!rig.standby)
        throw Error(options.show.rigPath + ": names no standby: write standby { ... } in it");
    return net::bindMaster(rig.standby->controlAddress, rig.standby->stateAddress, {}, keys);
}

// Binds the addresses before the world is made, which takes seconds, or minutes at the first start.
// So a second master is refused at once, and requests are answered meanwhile.
void runMaster(const MasterOptions& options) {
    cli::holdSignals();
    machine::ServiceNotifier service;
    const config::Rig rig = config::readRig(options.show.rigPath);
    wall::checkGeometry(rig, options.show.rigPath);
    cli::requireFolder("--trace", options.show.traceFolder);
    if (!options.show.recordPath.empty()) simulation::requireNewRecording(options.show.recordPath);
    cli::requireFile("--record", options.show.recordPath);
    auto channels = bindOwn(rig, options);
    MasterOptions telling = options;
    telling.service = &service;
    if (!options.lockstep) telling.log = openLog(options.show.rigPath);
    service.beginLongWork("making the world");
    bool isToStandBy = false;
    if (hasStandby(rig, options))
        isToStandBy = showByLease(rig, telling, std::move(channels));
    else if (options.show.replayPath.empty())
        showNew(rig, telling, std::move(channels));
    else
        showAgain(rig, telling, std::move(channels));
    setLogListener({});
    telling.log.reset();
    if (isToStandBy) startAnew();
}

}  // namespace

void addMaster(CommandLine& line) {
    const auto [command, options] = line.add<MasterOptions>(
        "master", "the master of a rig, alone: aquarama master RIG", runMaster);
    describeWorld(command, options.show);
    describeWall(command, options.show);
    command.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    command
        .add_flag("--resume",
                  options.resume,
                  "continue a show: values that were set override the options")
        ->excludes("--lockstep");
    command.add_option("--from-tick", options.show.replayFromTick, "begin --replay at this tick");
    command.add_option("--replay", options.show.replayPath, "show this recording")
        ->excludes("--record")
        ->excludes("--seed")
        ->excludes("--scene")
        ->excludes("--fish");
}

void addStandby(CommandLine& line) {
    const auto [command, options] = line.add<MasterOptions>(
        "standby",
        "simulate along with the master of a rig, and take over when it dies: aquarama standby RIG",
        runMaster);
    options.standsBy = options.resume = true;
    command.add_option("RIG", options.show.rigPath, "the rig's file")->required();
    command.add_option("--keys",
                       options.show.keyFolder,
                       "folder of the rig's keys, instead of the user's (aquarama keys)");
}

}  // namespace aquarama
