// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/units/log.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/conductor/ask.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"

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

void print(const wire::Explanation& explanation) {
    if (explanation.fish >= explanation.school)
        throw Error(
            "there is no fish " + std::to_string(explanation.fish) + ": the world has " +
            std::to_string(explanation.school) +
            (explanation.school == 0 ? "" : ", 0 to " + std::to_string(explanation.school - 1)));
    for (const std::string& line : explanation.lines) std::cout << line << '\n';
    std::cout.flush();
}

void explainLive(const ExplainOptions& options) {
    conductor::RequestClient master(
        options.address.empty() ? config::readRig(options.rig).controlAddress : options.address);
    const bool onScreen = options.follow && isatty(STDOUT_FILENO) != 0;
    do {
        const auto explanation = master.ask<wire::Explanation>(wire::ExplainRequest{options.fish});
        if (onScreen) std::cout << kClearScreen;
        print(explanation);
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
    print(world.explain(options.fish));
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
