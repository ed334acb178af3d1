// SPDX-License-Identifier: Apache-2.0
#include "common/cli/show.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <signal.h>

#include "common/cli/causes.h"
#include "common/cli/children.h"
#include "common/cli/clip.h"
#include "common/cli/outputs.h"
#include "common/cli/preflight.h"
#include "common/cli/siblings.h"
#include "common/units/log.h"

namespace aquarama::cli {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kGoodbye = 5s;        // how long a process may take to end after it was asked to
constexpr auto kLastPictures = 60s;  // and how long a clip may, which ends when the nodes have
constexpr int kInterrupted = 130;    // what shells say of Ctrl-C
constexpr auto kTooShort = 5s;       // one that dies sooner at its first start would only die again
constexpr auto kBreath = 1s;         // before another start of one that keeps dying

constexpr const char* kClip = "clip";

struct Process {
    std::string name;
    Command command;
    std::vector<std::string> firstTimeOnly{};  // arguments of its first start
    pid_t child = 0;
    Clock::time_point started;
    bool proven = false;  // has lived long enough once

    void launch() {
        Command now = command;
        for (std::string& argument : std::exchange(firstTimeOnly, {}))
            now.arguments.push_back(std::move(argument));
        child = start(now);
        started = Clock::now();
    }
    [[nodiscard]] bool running() const { return child != 0; }
};

void append(std::vector<std::string>& arguments,
            const std::string& name,
            const std::string& value) {
    if (value.empty()) return;
    arguments.push_back(name);
    arguments.push_back(value);
}

Process masterProcess(const ShowOptions& options) {
    std::vector<std::string> arguments{options.rigPath};
    if (options.lockstep()) arguments.emplace_back("--lockstep");
    if (options.frames) append(arguments, "--frames", std::to_string(*options.frames));
    if (options.seed) append(arguments, "--seed", std::to_string(*options.seed));
    append(arguments, "--scene", options.scenePath);
    if (options.fish) append(arguments, "--fish", std::to_string(*options.fish));
    append(arguments, "--pattern", options.pattern);
    append(arguments, "--quality", options.quality);
    append(arguments, "--trace", options.traceFolder);
    append(arguments, "--replay", options.replayPath);
    Process master{
        .name = "master", .command = {siblingProgram("master"), arguments}, .started = {}};
    // A master that is started again begins another world: it does not belong into this file.
    append(master.firstTimeOnly, "--record", options.recordPath);
    return master;
}

// Composes and encodes while the nodes draw.
Process clipProcess(const ShowOptions& options, const std::string& pipes) {
    std::vector<std::string> arguments{"clip", options.rigPath, options.clipPath};
    append(arguments, "--pipes", pipes);
    append(arguments, "--of", options.clipOf);
    append(arguments, "--every", std::to_string(options.filmEvery));
    if (options.frames) append(arguments, "--frames", std::to_string(*options.frames));
    if (showsAllChannels(options.clipOf)) append(arguments, "--first", options.snapshotFolder);
    return {.name = kClip, .command = {siblingProgram("calibrate"), arguments}, .started = {}};
}

Process nodeProcess(const ShowOptions& options,
                    const config::Rig& rig,
                    const config::Channel& channel,
                    const std::string& filmPipe) {
    std::vector<std::string> arguments{channel.name, "--master", rig.controlAddress};
    if (options.headless) arguments.emplace_back("--headless");
    append(arguments, "--snapshot", options.snapshotFolder);
    if (options.deep) arguments.emplace_back("--deep");
    append(arguments, "--film", filmPipe);
    if (!filmPipe.empty()) append(arguments, "--film-every", std::to_string(options.filmEvery));
    append(arguments, "--trace", options.traceFolder);
    return {.name = "node " + channel.name,
            .command = {siblingProgram("node"), arguments},
            .started = {}};
}

// Software OpenGL takes every core for each process; several nodes on one machine share them
// better. Two threads at least: those that fill pixels rest while their node prepares vertices, so
// that nodes take turns.
void shareCores(const config::Rig& rig) {
    const std::size_t perNode = std::thread::hardware_concurrency() / rig.channels.size();
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    setenv("LP_NUM_THREADS",
           std::to_string(std::max<std::size_t>(perNode, 2)).c_str(),
           /*overwrite=*/0);
}

bool anyRunning(const std::vector<Process>& processes) {
    return std::ranges::any_of(processes, &Process::running);
}

void signalAll(const std::vector<Process>& processes, int signal) {
    for (const Process& process : processes) {
        if (process.running()) kill(process.child, signal);
    }
}

// Every death that was heard of, before the first of them is judged: what is dead must not be
// waited for.
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

// Asks all to end, and makes sure of it; at once where somebody asks again. The clip ends by
// itself, with the nodes: what was shown until then is kept.
void endAll(std::vector<Process>& processes) {
    signalAll(processes, SIGTERM);
    const auto asked = Clock::now();
    while (anyRunning(processes)) {
        const Heard heard = waitForChildren(100ms);
        deaths(processes, heard);
        const auto waited = Clock::now() - asked;
        for (const Process& process : processes)
            if (process.running() &&
                (heard.interrupted || waited > (process.name == kClip ? kLastPictures : kGoodbye)))
                kill(process.child, SIGKILL);
    }
}

std::string described(const Ending& ending) {
    return ending.signal != 0 ? "was killed by signal " + std::to_string(ending.signal)
                              : "ended with status " + std::to_string(ending.exitCode);
}

// Of a show that ends with it: what was said first, for what dies next dies of that.
std::string causeOf(const Causes& causes, const Process& process, const Ending& ending) {
    const std::vector<std::string> said = causes.heard();
    return said.empty() ? "aquarama: " + process.name + ' ' + described(ending) + "; the show ends"
                        : said.front();
}

// What the death of one process means for the show.
enum class Verdict { GoesOn, Over, Failed };

Verdict judge(const ShowOptions& options,
              const Causes& causes,
              Process& process,
              const Ending& ending) {
    const bool early = Clock::now() - process.started < kTooShort;
    process.proven = process.proven || !early;
    if (ending.clean()) return process.name == "master" ? Verdict::Over : Verdict::GoesOn;
    if (options.lockstep() || !process.proven) {
        std::cerr << causeOf(causes, process, ending) << '\n';
        return Verdict::Failed;
    }
    for (const std::string& line : causes.heard()) std::cerr << line << '\n';
    std::cerr << "aquarama: " << process.name << ' ' << described(ending) << "; starting it again"
              << (process.name == "master" && !options.recordPath.empty()
                      ? "; what follows is not recorded\n"
                      : "\n");
    if (early) std::this_thread::sleep_for(kBreath);
    process.launch();
    return Verdict::GoesOn;
}

enum class Outcome { Finished, Interrupted, Failed };

// Watches until the master has ended and every node with it, or something failed, or we are asked
// to stop.
Outcome watch(const ShowOptions& options, const Causes& causes, std::vector<Process>& processes) {
    auto farewell = Clock::time_point::max();
    while (anyRunning(processes)) {
        const Heard heard = waitForChildren(200ms);
        bool failed = false;
        for (const auto& [process, ending] : deaths(processes, heard)) {
            const Verdict verdict = judge(options, causes, *process, ending);
            failed = verdict == Verdict::Failed;
            if (failed) break;  // what dies with it is no cause
            if (verdict == Verdict::Over)
                farewell = Clock::now() + 30s;  // nodes may still be writing their pictures
        }
        if (!failed && Clock::now() > farewell && anyRunning(processes)) {
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

// Lets aquarama-calibrate make a whole of the nodes' pictures.
bool compose(const ShowOptions& options, const Causes& causes) {
    std::vector<std::string> arguments{"compose", options.rigPath, options.snapshotFolder};
    if (options.deep) arguments.emplace_back("--deep");
    Process composer{
        .name = "compose", .command = {siblingProgram("calibrate"), arguments}, .started = {}};
    composer.launch();
    while (true) {
        for (const Ending& ending : waitForChildren(1s).endings) {
            if (ending.child != composer.child) continue;
            if (!ending.clean()) std::cerr << causeOf(causes, composer, ending) << '\n';
            return ending.clean();
        }
    }
}

void sayWhatWasMade(const ShowOptions& options, const config::Rig& rig) {
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

// The master, the nodes and, first, who waits for their frames.
std::vector<Process> processesOf(const ShowOptions& options,
                                 const config::Rig& rig,
                                 const std::optional<ClipPipes>& pipes) {
    std::vector<Process> processes;
    if (pipes) processes.push_back(clipProcess(options, pipes->folder()));
    processes.push_back(masterProcess(options));
    for (const config::Channel& channel : rig.channels)
        processes.push_back(
            nodeProcess(options, rig, channel, pipes ? pipes->pipeOf(channel.name) : ""));
    return processes;
}

}  // namespace

int runShow(const ShowOptions& options, const config::Rig& rig) {
    if (!options.headless) requireDisplay();
    requireFreePort(rig.controlAddress);
    requireFreePort(rig.stateAddress);
    requireFile("--clip", options.clipPath);
    requireFile("--record", options.recordPath);
    requireFolder("--snapshot", options.snapshotFolder);
    requireFolder("--trace", options.traceFolder);
    std::optional<ClipPipes> pipes;
    if (!options.clipPath.empty()) pipes.emplace(channelsFor(rig, options.clipOf));
    shareCores(rig);
    listenForSignals();

    const Causes causes;
    std::vector<Process> processes = processesOf(options, rig, pipes);
    std::cout << "starting the master and " << rig.channels.size() << " nodes of "
              << options.rigPath << std::endl;
    for (Process& process : processes) process.launch();

    const Outcome outcome = watch(options, causes, processes);
    if (outcome == Outcome::Failed) return 1;
    // A live show runs until somebody ends it; one that was to finish by itself has not done its
    // work.
    if (outcome == Outcome::Interrupted) return options.lockstep() ? kInterrupted : 0;
    if (!options.snapshotFolder.empty() && !compose(options, causes)) return 1;
    sayWhatWasMade(options, rig);
    return 0;
}

}  // namespace aquarama::cli
