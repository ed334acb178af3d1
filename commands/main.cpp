// SPDX-License-Identifier: Apache-2.0
// aquarama: runs shows and their master, queries it, and captures and studies fish.
#include <array>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/commands.h"
#include "common/cli/command_line.h"

namespace aquarama {

namespace {

// Commands that the help lists under one heading.
struct Group {
    const char* heading;
    std::vector<void (*)(CommandLine&)> commands;
};

// In the order of the help.
const std::array kGroups{
    Group{"A show on this machine", {addRun, addReplay}},
    Group{"While a show runs",
          {addConsole,
           addTouch,
           addGuests,
           addDoctor,
           addStatus,
           addSet,
           addPilot,
           addExplain,
           addSchedule}},
    Group{"A show on several machines, one process each",
          {addMaster,
           addStandby,
           addNode,
           addKeyCommands,
           addNodes,
           addHall,
           addRig,
           addTour,
           addPoweroff,
           addRelease}},
    Group{"Files",
          {addNewRig,
           addCheck,
           addView,
           addCalibrate,
           addCalibrations,
           addDrift,
           addAdjust,
           addInspect,
           addConvert,
           addSheets}},
    Group{"Fish and their repertoires",
          {addCapture, addExport, addGaits, addForms, addSearch, addControllers, addFidelity}},
    Group{"Worlds", {addStudy}},
    Group{"Offline work on a farm", {addMerge}},
};

}  // namespace

}  // namespace aquarama

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app{"Aquarama: one living undersea world on a curved wall of projectors", "aquarama"};
    app.require_subcommand(0, 1);
    CommandLine line(app);
    for (const Group& group : kGroups) {
        line.startGroup(group.heading);
        for (const auto add : group.commands) add(line);
    }
    app.footer("aquarama COMMAND --help lists the options of a command.");
    return cli::runProgram(app, count, arguments, [&] { return line.runChosen(); });
}
