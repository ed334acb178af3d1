// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <termios.h>
#include <unistd.h>

#include "common/config/rig.h"
#include "master/commands.h"
#include "master/conductor/requests.h"
#include "master/conductor/steering.h"

namespace aquarama {

namespace {

// Often enough that the submarine never takes the pilot for gone.
constexpr auto kBetweenWords = std::chrono::milliseconds(100);

// A terminal that gives every key as it is pressed, without showing it; as before afterwards.
class Keyboard {
  public:
    Keyboard() : isTerminal_(tcgetattr(STDIN_FILENO, &before_) == 0) {
        if (!isTerminal_) return;
        termios raw = before_;
        raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
        tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    }
    ~Keyboard() {
        if (isTerminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    }
    Keyboard(const Keyboard&) = delete;
    Keyboard& operator=(const Keyboard&) = delete;

    // Waits no longer than `kBetweenWords`. False: nothing will come any more.
    bool read(std::string& keys) {
        keys.clear();
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (poll(&input, 1, static_cast<int>(kBetweenWords.count())) <= 0) return true;
        std::array<char, 64> bytes{};
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (count <= 0) return false;
        keys.assign(bytes.data(), static_cast<std::size_t>(count));
        return true;
    }

  private:
    termios before_{};
    bool isTerminal_;
};

void steer(const std::string& address) {
    conductor::RequestClient master(address);
    Keyboard keyboard;
    conductor::TerminalSteering terminal;
    const bool onScreen = isatty(STDOUT_FILENO) != 0;
    std::cout << conductor::kTerminalSteeringHelp << '\n';
    Steering said;
    for (std::string keys; keyboard.read(keys) && !terminal.ended();) {
        terminal.press(keys);
        const Steering& held = terminal.steering();
        if (held != said || held != Steering{}) master.steer(held);
        said = held;
        const v1::StatusReply status = master.status();
        // On a screen one line that changes, else one after the other.
        std::cout << fmt::format("{}{}   {}{}",
                                 onScreen ? "\r\x1b[K" : "",
                                 conductor::submarineText(status),
                                 terminal.text(),
                                 onScreen ? "" : "\n")
                  << std::flush;
    }
    master.steer({});
    master.status();  // it has heard that as well
    if (onScreen) std::cout << '\n';
}

}  // namespace

void addPilot(CLI::App& app, cli::Job& job) {
    struct Options {
        std::string rig = "config/desk.txtpb";
        std::string address;
    };
    auto options = std::make_shared<Options>();
    CLI::App& command =
        *app.add_subcommand("pilot", "steer the submarine of the running wall from a terminal");
    command.add_option("RIG", options->rig, "whose master is told")->capture_default_str();
    command.add_option("--master", options->address, "its control address, instead of the rig's");
    command.callback([options, &job] {
        job = [options] {
            steer(options->address.empty() ? config::readRig(options->rig).controlAddress
                                           : options->address);
            return 0;
        };
    });
}

}  // namespace aquarama
