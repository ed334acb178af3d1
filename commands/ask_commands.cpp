// SPDX-License-Identifier: Apache-2.0
// `aquarama status`, `set`, `pilot` and `explain`: they query or command the master of a running
// show.
#include <array>
#include <charconv>
#include <chrono>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "commands/commands.h"
#include "common/ask/request_client.h"
#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/cli/keyboard.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/wire/recording.h"
#include "common/wire/wanted_show.h"
#include "master/conductor/status_text.h"
#include "master/conductor/steering.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"

namespace aquarama {

namespace {

using ask::AskedMaster;

// The options by which a command finds its master.
void describeMaster(CLI::App& command, AskedMaster& asked) {
    asked.rig = supervisor::kDefaultRig;
    command.add_option("RIG", asked.rig, "whose master is asked")->capture_default_str();
    command.add_option(
        "--master", asked.address, "control address of the master, instead of the rig's");
    command.add_option("--key", asked.key, "file of the key to show (aquarama keys bundle)");
}

void showStatus(const AskedMaster& asked) {
    ask::RequestClient master = asked.connect();
    std::cout << conductor::statusText(master.status());
}

// Short enough that the submarine never counts its pilot as gone.
constexpr auto kBetweenMessages = std::chrono::milliseconds(100);

// Sends the keys to the master and shows the submarine's position, until a key ends it.
void steer(const AskedMaster& asked) {
    ask::RequestClient master = asked.connect();
    cli::Keyboard keyboard;
    conductor::TerminalSteering terminal;
    const bool onScreen = isatty(STDOUT_FILENO) != 0;
    std::cout << conductor::kTerminalSteeringHelp << '\n';
    Steering said;
    for (std::string keys; keyboard.read(keys, kBetweenMessages) && !terminal.ended();) {
        terminal.press(keys);
        const Steering& held = terminal.steering();
        if (held != said || held != Steering{}) master.steer(held);
        said = held;
        const v1::StatusReply status = master.status();
        // A terminal has one line that is rewritten; other outputs get one line after the other.
        std::cout << fmt::format("{}{}   {}{}",
                                 onScreen ? "\r\x1b[K" : "",
                                 conductor::submarineText(status),
                                 terminal.text(),
                                 onScreen ? "" : "\n")
                  << std::flush;
    }
    master.steer({});
    master.status();  // the answer proves that the master has received both
    if (onScreen) std::cout << '\n';
}

// The interval of explain --follow, whose help says twice a second.
constexpr auto kBetweenLooks = std::chrono::milliseconds(500);
// ANSI escapes: the cursor goes home, then the screen is erased.
constexpr const char* kClearScreen = "\x1b[H\x1b[2J";

// Options of `explain`: of a running master or of a recording.
struct ExplainOptions {
    std::uint32_t fish = 0;
    AskedMaster asked;
    bool follow = false;
    std::string recording;   // empty: a running master is asked
    std::uint64_t tick = 0;  // of the recording
};

// Throws Error where the world has no such fish.
void print(std::uint32_t fish, std::size_t school, std::span<const std::string> lines) {
    if (fish >= school)
        throw Error("there is no fish " + std::to_string(fish) + ": the world has " +
                    std::to_string(school) +
                    (school == 0 ? "" : ", 0 to " + std::to_string(school - 1)));
    for (const std::string& line : lines) std::cout << line << '\n';
    std::cout.flush();
}

// Prints a mind; with --follow, again and again until it is interrupted.
void explainLive(const ExplainOptions& options) {
    ask::RequestClient master = options.asked.connect();
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

// Replays up to the tick, without a wall.
void explainReplay(const ExplainOptions& options) {
    const wire::Recording recording = wire::readRecording(options.recording);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        std::cerr << options.recording << ": " << doubt << '\n';
    if (options.tick > recording.lastTick().value)
        throw Error(options.recording + ": ends at tick " +
                    std::to_string(recording.lastTick().value) + "; choose an earlier one");
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    simulation::Playback playback(recording, world);
    playback.goTo({options.tick});
    if (playback.difference())
        std::cerr << options.recording << ": from tick " << playback.difference()->tick.value
                  << " on this is another world than the recorded one\n";
    print(options.fish, world.world().traits().size(), world.explain(options.fish).lines);
}

// Uses the recording where one is given, else the running master.
void explain(const ExplainOptions& options) {
    options.recording.empty() ? explainLive(options) : explainReplay(options);
}

// A value of the show, by name.
struct SetOptions {
    AskedMaster asked;
    std::string what, value;
};

// Throws Error for any other text.
bool switchedOn(const SetOptions& options) {
    if (options.value == "on") return true;
    if (options.value == "off") return false;
    throw Error(options.what + " is on or off, not \"" + options.value + "\"");
}

// Throws Error where no pattern has this name.
v1::WantedShow::Shown patternIn(const SetOptions& options) {
    if (const auto pattern = wire::patternNamed(options.value))
        return static_cast<v1::WantedShow::Shown>(*pattern);
    throw Error("pattern is world, grid or grey, not \"" + options.value + "\"");
}

// Throws Error where no tier has this name.
v1::WantedShow::Tier tierIn(const SetOptions& options) {
    if (options.value == "auto") return v1::WantedShow::AUTO;
    if (const auto tier = config::tierNamed(options.value)) return wire::tierOf(tier);
    throw Error("quality is low, medium, high, ultra or auto, not \"" + options.value + "\"");
}

// Throws Error where no time of day has this name.
v1::WantedShow::Day dayIn(const SetOptions& options) {
    if (const auto day = wire::dayNamed(options.value)) return *day;
    throw Error(
        "day is dawn, morning, noon, afternoon, sunset, dusk, night, \"first light\" or clock, not "
        "\"" +
        options.value + "\"");
}

// Throws Error for anything but a number from 0 to 1.
double shareIn(const SetOptions& options) {
    double share = -1;
    const char* const end = options.value.data() + options.value.size();
    const auto [rest, error] = std::from_chars(options.value.data(), end, share);
    if (error == std::errc{} && rest == end && share >= 0 && share <= 1) return share;
    const std::string least = options.what == "colour" ? "0, as in nature," : "0, black,";
    throw Error(options.what + " is a share from " + least + " to 1, not \"" + options.value +
                "\"");
}

// What each word of WHAT sets in an order.
using Setter = void (*)(const SetOptions&, v1::Order&);
const std::map<std::string, Setter> kSetters{
    {"master",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_change_master()->set_machine(legible(options.value));
     }},
    {"restart",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_restart()->set_channel(legible(options.value));
     }},
    {"scene",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_scene(legible(options.value));
     }},
    {"quality",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_quality(tierIn(options));
     }},
    {"pattern",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_pattern(patternIn(options));
     }},
    {"colour",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_colour_returned(shareIn(options));
     }},
    {"brightness",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_brightness(shareIn(options));
     }},
    {"black",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_black(switchedOn(options));
     }},
    {"freeze",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_freeze(switchedOn(options));
     }},
    {"guests",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_guests(switchedOn(options));
     }},
    {"drawings",
     [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_drawings(switchedOn(options));
     }},
    {"day", [](const SetOptions& options, v1::Order& order) {
         order.mutable_show()->set_day(dayIn(options));
     }}};

// Returns when it is done.
void set(const SetOptions& options) {
    v1::Order order;
    kSetters.at(options.what)(options, order);
    options.asked.connect().carryOut(std::move(order), [](const std::string& what) {
        std::cout << what << std::endl;  // at once: it takes a while
    });
    std::cout << options.what << ' ' << options.value << '\n';
}

}  // namespace

// Uses the operator's key where a folder of keys is given.
ask::RequestClient connectToMaster(const std::string& rigPath, const std::string& keyFolder) {
    AskedMaster asked{.rig = rigPath, .address = {}, .key = {}};
    if (!keyFolder.empty()) asked.key = config::keyFileIn(keyFolder, "operator").string();
    return asked.connect();
}

void addSet(CommandLine& line) {
    const auto [command, options] = line.add<SetOptions>(
        "set", "set what the running wall shows: scene, pattern, black ...", set);
    describeMaster(command, options.asked);
    command.get_option("RIG")->required();
    command
        .add_option("WHAT",
                    options.what,
                    "scene, quality, pattern, colour, brightness, black, freeze, guests, drawings, "
                    "day, restart or master")
        ->required()
        ->check(CLI::IsMember({"scene",
                               "quality",
                               "pattern",
                               "colour",
                               "brightness",
                               "black",
                               "freeze",
                               "guests",
                               "drawings",
                               "day",
                               "restart",
                               "master"}));
    command
        .add_option(
            "VALUE",
            options.value,
            "a scene's name; low, medium, high, ultra or auto; world, grid or grey; a share "
            "of colour or light, 0 to 1; on or off; a time of day, as dusk, or clock; a channel, "
            "whose node is started again; the machine that stands by")
        ->required()
        ->check(cli::plainWord());
    command.footer("What is set is kept: a master that is started again shows it.");
}

void addStatus(CommandLine& line) {
    const auto [command, asked] =
        line.add<AskedMaster>("status", "what the running wall is doing", showStatus);
    describeMaster(command, asked);
}

void addPilot(CommandLine& line) {
    const auto [command, asked] = line.add<AskedMaster>(
        "pilot", "steer the submarine of the running wall from a terminal", steer);
    describeMaster(command, asked);
}

void addExplain(CommandLine& line) {
    const auto [command, options] = line.add<ExplainOptions>(
        "explain", "explain what a fish sees, feels, intends and does: --fish ID", explain);
    command.add_option("--fish", options.fish, "which, by its number")
        ->required()
        ->check(cli::wholeNumber(0, kMostFish));
    describeMaster(command, options.asked);
    CLI::Option* follow = command.add_flag("--follow", options.follow, "go on, twice a second");
    CLI::Option* replay =
        command.add_option("--replay", options.recording, "ask this recording, not a master");
    replay->excludes(follow);
    command.add_option("--tick", options.tick, "of the recording")
        ->needs(replay)
        ->check(cli::wholeNumber(0, cli::kMostShownFrames));
}

}  // namespace aquarama
