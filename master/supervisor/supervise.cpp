// SPDX-License-Identifier: Apache-2.0
#include "master/supervisor/supervise.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <signal.h>

#include "common/base/counted.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/config/keys.h"
#include "master/supervisor/children.h"
#include "master/supervisor/preflight.h"

namespace aquarama::supervisor {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kTimeToEnd = 5s;         // for a process that was asked to end,
constexpr auto kTimeToEndClip = 60s;    // and for the clip, which ends after the nodes
constexpr auto kTimeForPictures = 30s;  // for the nodes' pictures, after the master has ended,
constexpr auto kTimeForPoster = 12h;    // and for a scaled panorama by software OpenGL
constexpr int kInterrupted = 130;       // the exit status after Ctrl-C, as shells have it
constexpr auto kShortestLife =
    5s;  // a process that ends sooner at its first start is not restarted
constexpr auto kPauseBeforeRestart = 1s;  // for a process that ends repeatedly

// Names of processes.
constexpr const char* kMaster = "master";
constexpr const char* kClip = "clip";
constexpr const char* kConsole = "console";
constexpr const char* kGuests = "guests";

// A child and how it is started; `child` is 0 while it does not run.
struct Process {
    std::string name;
    Command command;
    std::vector<std::string> firstTimeOnly{};  // arguments of its first start,
    std::vector<std::string> laterOnly{};      // and of all others
    pid_t child = 0;
    Clock::time_point started;
    bool proven = false;  // has once run for kShortestLife
    bool told = false;    // to end, as the show is over

    // Arguments for the first start only are replaced by those for later ones.
    void launch() {
        Command now = command;
        for (std::string& argument : std::exchange(firstTimeOnly, laterOnly))
            now.arguments.push_back(std::move(argument));
        child = start(now);
        started = Clock::now();
    }
    // Whether it runs: until deaths() has seen its end.
    [[nodiscard]] bool running() const { return child != 0; }
};

// An option with its value. An empty value means that the option was not given.
void append(std::vector<std::string>& arguments,
            const std::string& name,
            const std::string& value) {
    if (value.empty()) return;
    arguments.push_back(name);
    arguments.push_back(value);
}

// Command line of the master: this program with the command `master`.
Process masterProcess(const RunOptions& options) {
    const ShowOptions& show = options.show;
    std::vector<std::string> arguments{"master", show.rigPath};
    if (options.lockstep()) arguments.emplace_back("--lockstep");
    if (show.frames) append(arguments, "--frames", std::to_string(*show.frames));
    append(arguments, "--replay", show.replayPath);
    if (show.replayFromTick > 0)
        append(arguments, "--from-tick", std::to_string(show.replayFromTick));
    if (show.replayPath.empty()) append(arguments, "--seed", std::to_string(show.seed));
    append(arguments, "--scene", show.scenePath);
    if (show.fish) append(arguments, "--fish", std::to_string(*show.fish));
    append(arguments, "--pattern", show.pattern);
    append(arguments, "--quality", show.quality);
    append(arguments, "--keys", show.keyFolder);
    append(arguments, "--trace", show.traceFolder);
    Process master{.name = kMaster, .command = {ownProgram(), arguments}, .started = {}};
    // A restarted master begins another world, which must not go into this file.
    append(master.firstTimeOnly, "--record", show.recordPath);
    if (!options.lockstep()) master.laterOnly.emplace_back("--resume");
    return master;
}

// The command that the user typed: errors of helper programs begin with it ("aquarama run clip:
// ...").
std::string typedCommand(const RunOptions& options) {
    return options.show.replayPath.empty() ? "aquarama run" : "aquarama replay";
}

// Command line of the program that composes and encodes the clip while the nodes draw.
Process clipProcess(const RunOptions& options, const std::string& pipes) {
    std::vector<std::string> arguments{"clip", options.show.rigPath, options.clipPath};
    append(arguments, "--pipes", pipes);
    append(arguments, "--of", options.clipOf);
    append(arguments, "--every", std::to_string(options.filmEvery));
    append(arguments, "--from-frame", std::to_string(options.clipFromFrame));
    if (options.show.frames) append(arguments, "--frames", std::to_string(*options.show.frames));
    if (showsAllChannels(options.clipOf)) append(arguments, "--first", options.snapshotFolder);
    return {.name = kClip,
            .command = {siblingProgram("compose"), arguments, typedCommand(options)},
            .started = {}};
}

// Command line of a node. Where the rig needs keys, it gets a key file instead of name and address.
Process nodeProcess(const RunOptions& options,
                    const config::Rig& rig,
                    const config::Channel& channel,
                    const std::string& filmPipe) {
    std::vector<std::string> arguments{channel.name, "--master", rig.controlAddress};
    if (config::needsKeys(rig)) {
        const auto keys = config::keyFolderOf(options.show.rigPath, options.show.keyFolder);
        arguments = {"--key", config::keyFileIn(keys, channel.name).string()};
    }
    if (rig.standby) append(arguments, "--master", rig.standby->controlAddress);
    if (options.headless) arguments.emplace_back("--headless");
    append(arguments, "--snapshot", options.snapshotFolder);
    if (options.deep) arguments.emplace_back("--deep");
    // One node draws it for the whole wall.
    if (options.scale > 1 && channel.name == rig.channels.front().name)
        append(arguments, "--panorama", std::to_string(options.scale));
    append(arguments, "--film", filmPipe);
    if (!filmPipe.empty()) append(arguments, "--film-every", std::to_string(options.filmEvery));
    append(arguments, "--trace", options.show.traceFolder);
    return {.name = "node " + channel.name,
            .command = {siblingProgram("node"), arguments},
            .started = {}};
}

// Command line of a program that serves browsers beside a live show, where it is installed.
std::optional<Process> besideProcess(const RunOptions& options,
                                     const config::Rig& rig,
                                     const char* name) {
    const std::filesystem::path program =
        ownProgram().parent_path() / (std::string("aquarama-") + name);
    if (options.lockstep() || !std::filesystem::exists(program)) return std::nullopt;
    std::vector<std::string> arguments{options.show.rigPath};
    if (config::needsKeys(rig)) append(arguments, "--keys", options.show.keyFolder);
    return Process{.name = name, .command = {program, arguments}, .started = {}};
}

bool isBeside(const Process& process) {
    return process.name == kConsole || process.name == kGuests;
}

// The channels of the master's machine; nodes of other machines are started there.
bool isLocal(const config::Channel& channel) {
    return channel.machine.empty();
}

// Throws Error where pictures are wanted and a channel is on another machine: composing needs the
// pictures of all nodes here.
void requireLocalChannels(const RunOptions& options, const config::Rig& rig) {
    if (options.snapshotFolder.empty() && options.clipPath.empty()) return;
    const auto remote = std::ranges::find_if_not(rig.channels, isLocal);
    if (remote != rig.channels.end())
        throw Error("--snapshot and --clip need every channel on this machine; " + remote->name +
                    " is shown by machine " + remote->machine);
}

// Throws Error where the scaled panorama would be larger than what programs read.
void requirePosterSize(const RunOptions& options, const config::Rig& rig) {
    const glm::ivec2 size = rig.panoramaPixels * options.scale;
    const auto pixels = std::int64_t{size.x} * size.y;
    if (options.scale == 1 ||
        (std::max(size.x, size.y) <= kMostPixelsEachWay && pixels <= kMostPixels))
        return;
    throw Error(
        fmt::format("--scale {}: the panorama would be {} x {} pixels; {} pixels each way and {} "
                    "million in all "
                    "are possible; take a smaller one",
                    options.scale,
                    size.x,
                    size.y,
                    kMostPixelsEachWay,
                    kMostPixels / 1'000'000));
}

void sayWhatStarts(const RunOptions& options, const config::Rig& rig) {
    const auto local = static_cast<std::uint64_t>(std::ranges::count_if(rig.channels, isLocal));
    std::cout << "starting the master and " << counted(local, "node") << " of "
              << options.show.rigPath << std::endl;
    for (const config::Channel& channel : rig.channels)
        if (!isLocal(channel))
            std::cout << "expecting node " << channel.name << " of machine " << channel.machine
                      << std::endl;
}

// Software OpenGL takes every core for each process; several nodes on one machine share them
// better. Two threads at least: those that fill pixels rest while their node prepares vertices, so
// that nodes take turns.
void shareCores(const config::Rig& rig) {
    const auto local = static_cast<std::size_t>(std::ranges::count_if(rig.channels, isLocal));
    const std::size_t perNode =
        std::thread::hardware_concurrency() / std::max<std::size_t>(local, 1);
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    setenv("LP_NUM_THREADS",
           std::to_string(std::max<std::size_t>(perNode, 2)).c_str(),
           /*overwrite=*/0);
}

// False only when all of them have ended.
bool anyRunning(const std::vector<Process>& processes) {
    return std::ranges::any_of(processes, &Process::running);
}

void signalAll(const std::vector<Process>& processes, int signal) {
    for (const Process& process : processes) {
        if (process.running()) kill(process.child, signal);
    }
}

// Marks every process that has ended, before the cause of the first end is judged: a process that
// has ended must not be waited for.
std::vector<std::pair<Process*, Ending>> deaths(std::vector<Process>& processes,
                                                const Heard& heard) {
    std::vector<std::pair<Process*, Ending>> dead;
    for (const Ending& ending : heard.endings) {
        const auto process = std::ranges::find(processes, ending.child, &Process::child);
        if (process == processes.end()) continue;
        process->child = 0;
        dead.emplace_back(&*process, ending);
    }
    return dead;
}

// Asks all processes to end, and kills those that take too long, or all at a second interrupt. The
// clip ends after the nodes and keeps all pictures until then.
void endAll(std::vector<Process>& processes) {
    signalAll(processes, SIGTERM);
    const auto asked = Clock::now();
    while (anyRunning(processes)) {
        const Heard heard = waitForChildren(100ms);
        deaths(processes, heard);
        const auto waited = Clock::now() - asked;
        for (const Process& process : processes)
            if (process.running() &&
                (heard.interrupted ||
                 waited > (process.name == kClip ? kTimeToEndClip : kTimeToEnd)))
                kill(process.child, SIGKILL);
    }
}

// How a process ended, for a sentence that begins with its name.
std::string described(const Ending& ending) {
    return ending.signal != 0 ? "was killed by signal " + std::to_string(ending.signal)
                              : "ended with status " + std::to_string(ending.exitCode);
}

// The line for a show that ends with this death: that of the clip, whose nodes then have nobody to
// send frames to, or else the first error that was reported, as later ones follow from it.
std::string causeOf(const ErrorPipe& errors, const Process& process, const Ending& ending) {
    const std::vector<std::string> said = errors.heard();
    if (said.empty())
        return "aquarama: " + process.name + ' ' + described(ending) + "; the show ends";
    const auto ofClip = std::ranges::find_if(said, [](const std::string& line) {
        return line.find(std::string(" ") + kClip + ": ") < line.find(": ");
    });
    return ofClip != said.end() ? *ofClip : said.front();
}

// Handles the end of a program beside the show, which continues. One that has run for a while is
// restarted.
void renewBeside(const ErrorPipe& errors, Process& process, const Ending& ending) {
    for (const std::string& line : errors.heard()) std::cerr << line << '\n';
    const bool startsAgain = !ending.clean() && process.proven;
    std::cerr << "aquarama: the " << process.name << ' ' << described(ending)
              << (startsAgain ? "; starting it again\n" : "; the show goes on\n");
    if (startsAgain) process.launch();
}

// Decides what the end of one process means for the show.
enum class Verdict { GoesOn, Over, Failed };

// Restarts the process where the show can continue.
Verdict judge(const RunOptions& options,
              const ErrorPipe& errors,
              Process& process,
              const Ending& ending) {
    const bool early = Clock::now() - process.started < kShortestLife;
    process.proven = process.proven || !early;
    if (isBeside(process)) {
        if (!process.told) renewBeside(errors, process, ending);
        return Verdict::GoesOn;
    }
    if (ending.clean()) return process.name == kMaster ? Verdict::Over : Verdict::GoesOn;
    if (ending.exitCode == cli::kStartAgain) {
        process.launch();
        return Verdict::GoesOn;
    }
    if (options.lockstep() || !process.proven) return Verdict::Failed;
    for (const std::string& line : errors.heard()) std::cerr << line << '\n';
    std::cerr << "aquarama: " << process.name << ' ' << described(ending) << "; starting it again"
              << (process.name == kMaster && !options.show.recordPath.empty()
                      ? "; what follows is not recorded\n"
                      : "\n");
    if (early) std::this_thread::sleep_for(kPauseBeforeRestart);
    process.launch();
    return Verdict::GoesOn;
}

// They have nothing left to show.
void endBeside(std::vector<Process>& processes) {
    for (Process& process : processes) {
        if (!isBeside(process) || !process.running()) continue;
        process.told = true;
        kill(process.child, SIGTERM);
    }
}

// The result of supervising a show.
enum class Outcome { Finished, Interrupted, Failed };

// Supervises until the master and all nodes have ended, or one failed, or an interrupt arrives.
Outcome watch(const RunOptions& options, const ErrorPipe& errors, std::vector<Process>& processes) {
    auto lastMoment = Clock::time_point::max();
    while (anyRunning(processes)) {
        const Heard heard = waitForChildren(200ms);
        bool failed = false;
        for (const auto& [process, ending] : deaths(processes, heard)) {
            const Verdict verdict = judge(options, errors, *process, ending);
            if (verdict == Verdict::Failed) {  // other deaths follow from this one
                endAll(processes);             // and all have said what they know
                std::cerr << causeOf(errors, *process, ending) << '\n';
                return Outcome::Failed;
            }
            if (verdict == Verdict::Over) {
                lastMoment = Clock::now() + (options.scale > 1 ? kTimeForPoster : kTimeForPictures);
                endBeside(processes);
            }
        }
        if (!failed && Clock::now() > lastMoment && anyRunning(processes)) {
            std::cerr << "aquarama: a node did not end with the show; ending it\n";
            failed = true;
        }
        if (failed || heard.interrupted) {
            endAll(processes);
            return failed ? Outcome::Failed : Outcome::Interrupted;
        }
    }
    return Outcome::Finished;
}

// Has aquarama-compose compose the panorama and the hall of the nodes' pictures; false where it
// fails.
bool compose(const RunOptions& options, const ErrorPipe& errors) {
    std::vector<std::string> arguments{"compose", options.show.rigPath, options.snapshotFolder};
    if (options.deep) arguments.emplace_back("--deep");
    if (options.scale > 1) arguments.emplace_back("--keep-panorama");
    Process composer{.name = "compose",
                     .command = {siblingProgram("compose"), arguments, typedCommand(options)},
                     .started = {}};
    composer.launch();
    while (true) {
        for (const Ending& ending : waitForChildren(1s).endings) {
            if (ending.child != composer.child) continue;
            if (!ending.clean()) std::cerr << causeOf(errors, composer, ending) << '\n';
            return ending.clean();
        }
    }
}

// Prints the paths of the pictures; nothing where none were requested.
void sayWhatWasMade(const RunOptions& options, const config::Rig& rig) {
    if (options.snapshotFolder.empty()) return;
    std::cout << "pictures in " << options.snapshotFolder << ": panorama.png, hall.png";
    if (std::ranges::any_of(rig.channels, [&](const config::Channel& channel) {
            return channel.display.stereo.value_or(rig.stereo.mode) != config::StereoMode::Mono;
        }))
        std::cout << " and each eye's";
    for (const config::Channel& channel : rig.channels)
        std::cout << ", channel-" << channel.name << ".png";
    std::cout << '\n';
}

// The clip, which waits for frames, the master, the nodes, and what serves browsers, in the order
// of their start.
std::vector<Process> processesOf(const RunOptions& options,
                                 const config::Rig& rig,
                                 const std::optional<ClipPipes>& pipes) {
    std::vector<Process> processes;
    if (pipes) processes.push_back(clipProcess(options, pipes->folder()));
    processes.push_back(masterProcess(options));
    for (const config::Channel& channel : rig.channels)
        if (isLocal(channel))
            processes.push_back(
                nodeProcess(options, rig, channel, pipes ? pipes->pipeOf(channel.name) : ""));
    for (const auto& [name, isWanted] :
         {std::pair(kConsole, rig.consolePort != 0), std::pair(kGuests, rig.guests.has_value())})
        if (auto beside = isWanted ? besideProcess(options, rig, name) : std::nullopt)
            processes.push_back(*std::move(beside));
    return processes;
}

}  // namespace

// Checks everything first, so that a mistake leaves no process behind.
int runShow(const RunOptions& options, const config::Rig& rig) {
    assert(!rig.channels.empty());
    if (!options.headless) requireDisplay();
    requireLocalChannels(options, rig);
    requirePosterSize(options, rig);
    requireFreePort(rig.controlAddress);
    requireFreePort(rig.stateAddress);
    cli::requireFile("--clip", options.clipPath);
    cli::requireFile("--record", options.show.recordPath);
    cli::requireFolder("--snapshot", options.snapshotFolder);
    cli::requireFolder("--trace", options.show.traceFolder);
    std::optional<ClipPipes> pipes;
    if (!options.clipPath.empty()) pipes.emplace(channelsFor(rig, options.clipOf));
    shareCores(rig);
    listenForSignals();

    const ErrorPipe errors;
    std::vector<Process> processes = processesOf(options, rig, pipes);
    sayWhatStarts(options, rig);
    for (Process& process : processes) process.launch();

    const Outcome outcome = watch(options, errors, processes);
    if (outcome == Outcome::Failed) return 1;
    // A live show ends by an interrupt. A show that should finish by itself has failed.
    if (outcome == Outcome::Interrupted) return options.lockstep() ? kInterrupted : 0;
    if (!options.snapshotFolder.empty() && !compose(options, errors)) return 1;
    sayWhatWasMade(options, rig);
    return 0;
}

}  // namespace aquarama::supervisor
