// SPDX-License-Identifier: Apache-2.0
// The command `aquarama`: runs a show, or hands over to the program that does what was asked.
#include <algorithm>
#include <array>
#include <exception>
#include <span>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "common/cli/children.h"
#include "common/cli/preflight.h"
#include "common/cli/program.h"
#include "common/cli/show.h"
#include "common/cli/siblings.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/units/log.h"

namespace aquarama {

namespace {

constexpr const char* kDesk = "config/desk.txtpb";

std::string clipNameProblem(const std::string& path) {
    if (path.ends_with(".mp4") || path.ends_with(".webp")) return {};
    return "\"" + path + "\" is not FILE.mp4 or FILE.webp";
}

// A subcommand that another program does: `aquarama check RIG` is `aquarama-calibrate check RIG`.
struct Delegation {
    std::string_view command;
    std::string_view program;
    std::string_view subcommand;  // empty: the program itself
    std::string_view what;
};

constexpr std::array kDelegations{
    Delegation{"master", "master", "", "the master of a rig, alone: aquarama master RIG"},
    Delegation{"node", "node", "", "one render node: aquarama node NAME --master ADDRESS"},
    Delegation{"capture",
               "capture",
               "",
               "simulate the biomechanical fish and compile repertoires: --out DIR"},
    Delegation{"export",
               "capture",
               "export",
               "a segment as C3D, glTF or CSV: aquarama export FILE --segment NAME --c3d OUT"},
    Delegation{"gaits", "capture", "gaits", "how species swim, as a table in Markdown"},
    Delegation{"search", "capture", "search", "gait parameters with which a species swims"},
    Delegation{"fidelity",
               "capture",
               "fidelity",
               "the same commands to the biomechanical fish and to its replica"},
    Delegation{"controllers",
               "capture",
               "controllers",
               "what each motor controller makes the biomechanical fish do"},
    Delegation{"study", "study", "", "with and without each adaptation of the mind to its motor"},
    Delegation{
        "check", "calibrate", "check", "validate rigs, scenes and species: aquarama check FILE..."},
    Delegation{"status", "master", "status", "what the running wall is doing"},
    Delegation{
        "pilot", "master", "pilot", "steer the submarine of the running wall from a terminal"},
    Delegation{"explain",
               "master",
               "explain",
               "what a fish sees, feels, intends and does, and why: --fish ID"},
};

bool isRepertoire(const std::string& path) {
    return path.ends_with(".aqrep") || cli::looksLikeRepertoire(path);
}

bool isRecording(const std::string& path) {
    return path.ends_with(".aqrec") || cli::looksLikeRecording(path);
}

// Every other file that we know is a text.
std::string_view inspectorOf(std::span<char*> arguments) {
    if (std::ranges::any_of(arguments, isRecording)) return "master";
    return std::ranges::any_of(arguments, isRepertoire) ? "capture" : "calibrate";
}

[[noreturn]] void delegate(std::string_view program,
                           std::string_view subcommand,
                           std::span<char*> rest) {
    cli::Command command{cli::siblingProgram(std::string(program)), {}};
    if (!subcommand.empty()) command.arguments.emplace_back(subcommand);
    command.arguments.insert(command.arguments.end(), rest.begin(), rest.end());
    cli::become(command);
}

// What a new show and a replayed one have in common.
void describeShow(CLI::App& run, cli::ShowOptions& options) {
    run.add_flag("--headless", options.headless, "without a display; implies lockstep");
    run.add_option("--frames", options.frames, "end after so many frames; implies lockstep")
        ->check(cli::wholeNumber(1, cli::kMostShownFrames));
    CLI::Option* snapshot = run.add_option(
        "--snapshot",
        options.snapshotFolder,
        "folder for pictures of the last frame, and with --clip of the first as soon as "
        "it is there; implies lockstep");
    run.add_flag("--deep", options.deep, "pictures of 16 bits instead of 8 dithered ones")
        ->needs(snapshot);
    CLI::Option* clip =
        run.add_option("--clip", options.clipPath, "FILE.mp4 or FILE.webp; implies lockstep")
            ->check(CLI::Validator(clipNameProblem, ""));
    run.add_option("--clip-of", options.clipOf, "panorama (by default), hall or a channel's name")
        ->needs(clip);
    run.add_option("--film-every", options.filmEvery, "the clip has every so many frames only")
        ->needs(clip)
        ->check(cli::wholeNumber(1, 10000));
    run.add_option(
        "--trace", options.traceFolder, "folder for a line of times a frame and process");
    run.add_option("--pattern", options.pattern, "show this instead of the world")
        ->check(CLI::IsMember({"world", "grid", "grey"}));
    run.add_option("--quality", options.quality, "how fine the wall is drawn, instead of the rig's")
        ->check(CLI::IsMember({"low", "medium", "high", "ultra"}));
    run.add_flag("--live", options.live, "keep to the clock where lockstep would be implied")
        ->excludes(clip);
}

void describeRun(CLI::App& run, cli::ShowOptions& options) {
    run.add_option("RIG", options.rigPath, "the rig's file")->default_val(kDesk);
    run.add_option("--seed", options.seed, "of the world: the same seed gives the same world")
        ->check(cli::wholeNumber(0, cli::kMostSeed));
    run.add_option("--scene", options.scenePath, "what is shown, instead of the rig's scene");
    run.add_option(
           "--fish", options.fish, "how many of the first species, instead of the scene's number")
        ->check(cli::wholeNumber(0, kMostFish));
    run.add_option("--record", options.recordPath, "write the show to this new file");
    describeShow(run, options);
}

void describeReplay(CLI::App& replay, cli::ShowOptions& options, bool& check) {
    replay.add_option("FILE", options.replayPath, "the recording")->required();
    replay.add_option("--rig", options.rigPath, "the wall that shows it")->default_val(kDesk);
    replay.add_flag("--check", check, "no wall: only whether it is the same world again");
    describeShow(replay, options);
}

// Only where the program that does it would not know of the other kinds: else it says its own help.
void describeInspect(CLI::App& app) {
    CLI::App& inspect = *app.add_subcommand(
        "inspect", "what a file holds: a rig, a scene, a species, a repertoire or a recording");
    inspect.add_option("FILE",
                       "a rig, a scene or a species (.txtpb), a repertoire (.aqrep) or the "
                       "recording of a show (.aqrec)");
    inspect.add_option("--report", "of a repertoire: folder for a page with pictures and figures");
}

bool asksForHelp(std::span<char*> arguments) {
    return std::ranges::any_of(arguments, [](std::string_view argument) {
        return argument == "--help" || argument == "-h";
    });
}

// Returns where this program itself does what is asked.
void delegateWhatOthersDo(std::span<char*> arguments) {
    if (arguments.empty()) return;
    const std::string_view first = arguments.front();
    const std::span rest = arguments.subspan(1);
    for (const Delegation& delegation : kDelegations)
        if (first == delegation.command) delegate(delegation.program, delegation.subcommand, rest);
    if (first == "inspect" && !asksForHelp(rest)) delegate(inspectorOf(rest), "inspect", rest);
}

int runAquarama(int count, char** arguments) {
    CLI::App app{"Aquarama: one living undersea world on a curved wall of projectors", "aquarama"};
    app.require_subcommand(0, 1);
    cli::ShowOptions options;
    CLI::App& run = *app.add_subcommand("run", "the master and all nodes of a rig on this machine");
    describeRun(run, options);
    cli::ShowOptions replayOptions;
    bool check = false;
    CLI::App& replay = *app.add_subcommand("replay", "a recorded show once more");
    describeReplay(replay, replayOptions, check);
    for (const Delegation& delegation : kDelegations)
        app.add_subcommand(std::string(delegation.command), std::string(delegation.what));
    describeInspect(app);
    return cli::runProgram(app, count, arguments, [&] {
        if (app.get_subcommands().empty()) throw CLI::RequiredError("a command");
        if (replay.parsed()) cli::requireRecording(replayOptions.replayPath);
        if (check)
            cli::become({cli::siblingProgram("master"), {"replay", replayOptions.replayPath}});
        const cli::ShowOptions& shown = replay.parsed() ? replayOptions : options;
        return cli::runShow(shown, config::readRig(shown.rigPath));
    });
}

}  // namespace

}  // namespace aquarama

int main(int count, char** arguments) {
    try {
        aquarama::delegateWhatOthersDo({arguments + 1, arguments + std::max(count, 1)});
    } catch (const std::exception& error) {
        aquarama::cli::sayError("aquarama", error.what());
        return 1;
    }
    return aquarama::runAquarama(count, arguments);
}
