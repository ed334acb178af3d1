// SPDX-License-Identifier: Apache-2.0
// `aquarama run` and `aquarama replay`: shows on this machine; and the options that they share with
// `aquarama master`, which they start.
#include <cmath>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/commands.h"
#include "commands/work_parts.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "master/supervisor/children.h"
#include "master/supervisor/preflight.h"

namespace aquarama {

namespace {

// For CLI::Validator: an empty text means that the name is good.
std::string clipNameProblem(const std::string& path) {
    if (path.ends_with(".mp4") || path.ends_with(".webp")) return {};
    return "\"" + path + "\" is not FILE.mp4 or FILE.webp";
}

// Options of the supervisor alone: windows or not, and pictures of all channels.
void describePictures(CLI::App& command, supervisor::RunOptions& options) {
    command.add_flag("--headless", options.headless, "without a display");
    CLI::Option* snapshot = command.add_option(
        "--snapshot",
        options.snapshotFolder,
        "folder for pictures of the last frame, and with --clip of the first as soon as "
        "it is there");
    command.add_flag("--deep", options.deep, "pictures of 16 bits instead of 8 dithered ones")
        ->needs(snapshot);
    command
        .add_option("--scale",
                    options.scale,
                    "panorama.png so many times as wide and high, for print; takes long")
        ->needs(snapshot)
        ->excludes(command.get_option("--pattern"))
        ->check(cli::wholeNumber(1, cli::kMostScale));
    CLI::Option* clip = command.add_option("--clip", options.clipPath, "FILE.mp4 or FILE.webp")
                            ->check(CLI::Validator(clipNameProblem, ""));
    command
        .add_option("--clip-of", options.clipOf, "panorama (by default), hall or a channel's name")
        ->needs(clip);
    command.add_option("--film-every", options.filmEvery, "the clip has every so many frames only")
        ->needs(clip)
        ->check(cli::wholeNumber(1, 10000));
    command
        .add_flag(
            "--live", options.live, "follow the clock even where other options imply lockstep")
        ->excludes(clip);
    command.footer(
        "--headless, --frames, --snapshot and --clip imply lockstep: frame n shows tick n, and no "
        "clock is read.");
}

// Throws Error where the rig needs keys and has none, before any process starts.
int runWith(const supervisor::RunOptions& options) {
    const config::Rig rig = config::readRig(options.show.rigPath);
    static_cast<void>(masterKeysOf(rig, options.show));  // throws where there are none
    return supervisor::runShow(options, rig);
}

// Options of `replay`. With `check` no wall is started and only hashes are compared.
struct ReplayOptions {
    supervisor::RunOptions run;
    bool check = false;
    std::optional<parts::Part> part;
};

// Throws Error, before any process starts, where the file is not a recording.
int replay(const ReplayOptions& options) {
    supervisor::requireRecording(options.run.show.replayPath);
    if (options.part) return replayPart(options.run, *options.part, runWith);
    const Tick from{options.run.show.replayFromTick};
    return options.check ? checkReplay(options.run.show.replayPath, from) : runWith(options.run);
}

// "1:23:45", "23:45", "45" or "45.5": hours, minutes and seconds of a recording. Throws
// ValidationError for anything else.
std::uint64_t ticksIn(const std::string& time) {
    static const std::regex kTime(R"((?:(?:(\d{1,4}):)?(\d{1,2}):)?(\d{1,6}(?:\.\d{1,3})?))");
    std::smatch parts;
    if (!std::regex_match(time, parts, kTime))
        throw CLI::ValidationError(
            "--at", "is a time of the recording, such as 1:23:45, 23:45 or 45.5, not " + time);
    const auto number = [&](std::size_t part) {
        return parts[part].matched ? std::stod(parts[part]) : 0.0;
    };
    const double seconds = 3600 * number(1) + 60 * number(2) + number(3);
    return static_cast<std::uint64_t>(std::llround(seconds * kTicksPerSecond));
}

// Another program of the installation that takes the arguments after the command's name.
struct HandedOver {
    const CLI::App* command = nullptr;
    std::string program;
    std::vector<std::string> first;  // its own subcommand, before the arguments
    std::string name;                // at the beginning of its errors and its help
    std::string notice = {};         // written to stderr before; empty: none
};

// Replaces this process by the other program; does not return.
void handOver(const HandedOver& to) {
    if (!to.notice.empty()) cli::sayError("aquarama", to.notice);
    supervisor::Command other{supervisor::siblingProgram(to.program), to.first, to.name};
    for (const std::string& argument : to.command->remaining()) other.arguments.push_back(argument);
    supervisor::become(other);
}

// Adds a command that another program of the installation runs, with all arguments. Where the other
// program has a command of that name, its errors add the name.
HandedOver& addHandedOver(CommandLine& line,
                          const std::string& name,
                          const std::string& what,
                          const std::string& program,
                          const std::vector<std::string>& first) {
    const auto [command, options] = line.add<HandedOver>(name, what, handOver);
    command.prefix_command();
    command.set_help_flag();  // the other program has its own
    options = {&command, program, first, first.empty() ? "aquarama " + name : "aquarama"};
    return options;
}

}  // namespace

void describeWorld(CLI::App& command, supervisor::ShowOptions& options) {
    command.add_option("RIG", options.rigPath, "the rig's file")->capture_default_str();
    command
        .add_option("--seed", options.seed, "seed of the world: the same seed gives the same world")
        ->check(cli::wholeNumber(0, cli::kMostSeed));
    command.add_option("--scene", options.scenePath, "the scene to show, instead of the rig's");
    command
        .add_option(
            "--fish", options.fish, "number of fish of the first species, instead of the scene's")
        ->check(cli::wholeNumber(0, kMostFish));
    command.add_option("--record", options.recordPath, "write the show to this new file");
}

// Adds the options about the wall that `run`, `replay` and `master` share.
void describeWall(CLI::App& command, supervisor::ShowOptions& options) {
    command.add_option("--frames", options.frames, "end after so many frames")
        ->check(cli::wholeNumber(1, cli::kMostShownFrames));
    command.add_option("--pattern", options.pattern, "show this instead of the world")
        ->check(CLI::IsMember({"world", "grid", "grey"}));
    command.add_option("--quality", options.quality, "quality of drawing, instead of the rig's")
        ->check(CLI::IsMember({"low", "medium", "high", "ultra"}));
    command.add_option("--keys",
                       options.keyFolder,
                       "folder of the rig's keys, instead of the user's (aquarama keys)");
    command.add_option(
        "--trace", options.traceFolder, "folder for a line of times a frame, of each process");
}

void addRun(CommandLine& line) {
    const auto [run, options] = line.add<supervisor::RunOptions>(
        "run", "the master and all nodes of a rig on this machine", runWith);
    describeWorld(run, options.show);
    describeWall(run, options.show);
    describePictures(run, options);
}

void addReplay(CommandLine& line) {
    const auto [command, options] =
        line.add<ReplayOptions>("replay", "a recorded show once more", replay);
    command.add_option("FILE", options.run.show.replayPath, "the recording")->required();
    command.add_option("--rig", options.run.show.rigPath, "the wall that shows it")
        ->capture_default_str();
    command.add_option_function<std::string>(
        "--at",
        [&show = options.run.show](const std::string& time) {
            show.replayFromTick = ticksIn(time);
        },
        "begin at this time of the recording: hours:minutes:seconds");
    command.add_flag(
        "--check", options.check, "without a wall: only check that the world is the same again");
    describeWall(command, options.run.show);
    describePictures(command, options.run);
    describePart(command, options.part);
    command.get_option("--part")
        ->needs(command.get_option("--clip"))
        ->excludes(command.get_option("--snapshot"))
        ->excludes(command.get_option("--check"));
}

void addNode(CommandLine& line) {
    addHandedOver(line, "node", "one render node: aquarama node NAME --master ADDRESS", "node", {});
}

void addCheck(CommandLine& line) {
    addHandedOver(line,
                  "check",
                  "validate rigs, scenes and species: aquarama check FILE...",
                  "compose",
                  {"check"});
}

void addView(CommandLine& line) {
    addHandedOver(line,
                  "view",
                  "show channel pictures in a simulated hall: aquarama view RIG "
                  "--frame DIR --view hall --out PNG",
                  "compose",
                  {"view"});
    HandedOver& former = addHandedOver(line, "theatre", "", "compose", {"view"});
    former.notice =
        "\"theatre\" is called \"view\" now; the former name ends with the next release";
    line.hide("theatre");
}

void addCalibrate(CommandLine& line) {
    addHandedOver(line,
                  "calibrate",
                  "find how projectors hang, by camera: aquarama calibrate --rig RIG --out WALL",
                  "calibrate",
                  {});
}

void addDrift(CommandLine& line) {
    addHandedOver(line,
                  "drift",
                  "check whether a projector has moved: aquarama drift --rig RIG --camera DEV",
                  "calibrate",
                  {"drift"});
}

void addSheets(CommandLine& line) {
    addHandedOver(
        line,
        "sheets",
        "print sheets that visitors colour: aquarama sheets --species clownfish --out DIR",
        "drawings",
        {"sheets"});
}

void addConsole(CommandLine& line) {
    addHandedOver(line,
                  "console",
                  "the operator's console, for browsers: aquarama console RIG",
                  "console",
                  {});
}

void addTouch(CommandLine& line) {
    addHandedOver(line,
                  "touch",
                  "map a tracker of hands or people to the wall by three marks: aquarama touch RIG",
                  "console",
                  {"touch"});
}

void addGuests(CommandLine& line) {
    addHandedOver(line,
                  "guests",
                  "lets visitors with phones steer and feed: aquarama guests RIG",
                  "guests",
                  {});
}

}  // namespace aquarama
