// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/units/error.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/conductor/requests.h"
#include "master/simulation/assets.h"
#include "master/simulation/living_world.h"
#include "master/simulation/playback.h"

namespace aquarama {

namespace {

constexpr auto kBetweenLooks = std::chrono::milliseconds(500);
constexpr const char* kClearScreen = "\x1b[H\x1b[2J";

struct ExplainOptions {
    std::uint32_t fish = 0;
    std::string rig = "config/desk.txtpb";
    std::string address;
    bool follow = false;
    std::string recording;
    std::uint64_t tick = 0;
};

void print(std::uint32_t fish, std::size_t school, std::span<const std::string> lines) {
    if (fish >= school)
        throw Error("there is no fish " + std::to_string(fish) + ": the world has " +
                    std::to_string(school) +
                    (school == 0 ? "" : ", 0 to " + std::to_string(school - 1)));
    for (const std::string& line : lines) std::cout << line << '\n';
    std::cout.flush();
}

void explainLive(const ExplainOptions& options) {
    conductor::RequestClient master(
        options.address.empty() ? config::readRig(options.rig).controlAddress : options.address);
    const bool onScreen = options.follow && isatty(STDOUT_FILENO) != 0;
    do {
        const v1::Explanation explanation = master.explain(options.fish);
        if (onScreen) std::cout << kClearScreen;
        const std::vector<std::string> lines{explanation.lines().begin(),
                                             explanation.lines().end()};
        print(options.fish, explanation.school(), lines);
        if (options.follow) std::this_thread::sleep_for(kBetweenLooks);
    } while (options.follow);
}

void explainReplay(const ExplainOptions& options) {
    const wire::Recording recording = wire::readRecording(options.recording);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        std::cerr << options.recording << ": " << doubt << '\n';
    if (options.tick > recording.lastTick().value)
        throw Error(options.recording + ": ends at tick " +
                    std::to_string(recording.lastTick().value) + "; choose an earlier one");
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    simulation::Playback playback(recording, world);
    while (world.tick().value < options.tick) playback.advance();
    if (playback.difference())
        std::cerr << options.recording << ": from tick " << playback.difference()->tick.value
                  << " on this is another world than the recorded one\n";
    print(options.fish, world.world().traits().size(), world.explain(options.fish));
}

}  // namespace

void addExplain(CLI::App& app, cli::Job& job) {
    auto options = std::make_shared<ExplainOptions>();
    CLI::App& explain =
        *app.add_subcommand("explain", "what a fish sees, feels, intends and does, and why");
    explain.add_option("--fish", options->fish, "which, by its number")
        ->required()
        ->check(cli::wholeNumber(0, kMostFish));
    explain.add_option("RIG", options->rig, "whose master is asked")->capture_default_str();
    explain.add_option("--master", options->address, "its control address, instead of the rig's");
    auto* follow = explain.add_flag("--follow", options->follow, "go on, twice a second");
    auto* replay =
        explain.add_option("--replay", options->recording, "ask this recording, not a master");
    replay->excludes(follow);
    explain.add_option("--tick", options->tick, "of the recording")
        ->needs(replay)
        ->check(cli::wholeNumber(0, cli::kMostShownFrames));
    explain.callback([options, &job] {
        job = [options] {
            options->recording.empty() ? explainLive(*options) : explainReplay(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
