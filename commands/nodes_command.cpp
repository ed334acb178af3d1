// SPDX-License-Identifier: Apache-2.0
// `aquarama nodes`: lists nodes that wait for a key, and gives one a channel.
#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/keys.h"
#include "common/enrol/discovery.h"
#include "common/enrol/hand_over.h"

namespace aquarama {

namespace {

using namespace std::chrono_literals;

struct AssignOptions {
    std::string rig;
    std::string keys;  // their folder; empty: the user's
    std::string letter, channel, code;
};

// Nodes answer within a second, where a cable is good.
constexpr auto kPatience = 3s;

void listNodes() {
    const enrol::Discovery discovery;
    std::this_thread::sleep_for(kPatience);
    const std::vector<enrol::FoundNode> nodes = discovery.nodes();
    if (nodes.empty()) cli::say("no node waits for a channel on this network");
    for (const enrol::FoundNode& node : nodes)
        cli::say(fmt::format("{:<3} {}", node.letter, node.address));
}

// Throws Error where it does not appear.
enrol::FoundNode find(const std::string& letter) {
    const enrol::Discovery discovery;
    const auto end = std::chrono::steady_clock::now() + 2 * kPatience;
    while (std::chrono::steady_clock::now() < end) {
        for (const enrol::FoundNode& node : discovery.nodes())
            if (node.letter == letter) return node;
        std::this_thread::sleep_for(50ms);
    }
    throw Error("no node waits as " + letter +
                " on this network; \"aquarama nodes waiting\" lists those that do");
}

void assign(const AssignOptions& options) {
    std::string letter = options.letter;
    std::ranges::transform(letter, letter.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    enrol::assignChannel(options.rig,
                         config::keyFolderOf(options.rig, options.keys),
                         find(letter),
                         options.channel,
                         options.code,
                         enrol::dayOfNewKey(systemSeconds(), static_cast<double>(builtAt())));
    cli::say(letter + " shows the channel " + options.channel +
             "; whoever had its key before takes part no more");
}

}  // namespace

void addNodes(CommandLine& line) {
    struct Nothing {};
    const auto nodes =
        line.add<Nothing>("nodes", "give nodes without a key a channel", [](const Nothing&) {
            throw CLI::RequiredError("nodes: waiting or assign");
        });
    line.addTo<Nothing>(
        nodes.app, "waiting", "list those that show a letter on this network", [](const Nothing&) {
            listNodes();
        });
    const auto added = line.addTo<AssignOptions>(
        nodes.app, "assign", "hand one the key of a channel, which is made anew", assign);
    added.app.add_option("RIG", added.options.rig, "whose channel")->required();
    added.app.add_option("LETTER", added.options.letter, "of the node")->required();
    added.app.add_option("CHANNEL", added.options.channel, "that it shows from now on")->required();
    added.app.add_option("CODE", added.options.code, "on its screen")->required();
    added.app.add_option("--keys", added.options.keys, "folder of the keys, instead of the user's");
}

}  // namespace aquarama
