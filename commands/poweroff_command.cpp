// SPDX-License-Identifier: Apache-2.0
// `aquarama poweroff`: the machines of a hall go off in order.
#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/commands.h"
#include "common/ask/request_client.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/machine/machine_power.h"

namespace aquarama {

namespace {

// How long nodes of machines that were told may still be there.
constexpr auto kLongestGoing = std::chrono::seconds(30);
constexpr auto kBetweenCounts = std::chrono::milliseconds(500);

struct PoweroffOptions {
    std::string rig;
};

// Tells the machine of a node. Returns why that cannot be done; empty: it is done.
std::string whyNotTold(ask::RequestClient& master, const std::string& channel) {
    v1::Order order;
    order.set_run(master.run());
    order.mutable_power()->set_channel(channel);
    order.mutable_power()->set_word(v1::Power::POWEROFF);
    try {
        master.carryOut(std::move(order), [](const std::string&) {});
        return {};
    } catch (const Error& problem) {
        return problem.what();
    }
}

// Tells a machine by the first of its nodes that takes the word. Returns whether one did.
bool tellMachine(ask::RequestClient& master,
                 const std::string& machine,
                 const std::vector<std::string>& channels) {
    std::string why;
    for (const std::string& channel : channels) {
        why = whyNotTold(master, channel);
        if (!why.empty()) continue;
        cli::say(machine + ": goes off");
        return true;
    }
    logWarning("{} stays on: {}", machine, why);
    return false;
}

bool isThere(const v1::StatusReply& status, const std::string& channel) {
    return std::ranges::any_of(status.nodes(), [&](const v1::NodeStatus& node) {
        return node.name() == channel && node.condition() != v1::NODE_ABSENT;
    });
}

// Returns when none of these nodes is there, or it has taken too long.
void awaitGone(ask::RequestClient& master, const std::vector<std::string>& channels) {
    const auto until = std::chrono::steady_clock::now() + kLongestGoing;
    while (std::chrono::steady_clock::now() < until) {
        const v1::StatusReply status = master.status();
        if (std::ranges::none_of(channels, [&](const auto& one) { return isThere(status, one); }))
            return;
        std::this_thread::sleep_for(kBetweenCounts);
    }
    logWarning("nodes are still there after {} s; this machine goes off", kLongestGoing.count());
}

// The machines of nodes but this one, in the order of the channels.
void powerOffNodes(const config::Rig& rig, ask::RequestClient master) {
    static_cast<void>(master.status());  // of which run the orders are
    std::vector<std::string> machines, gone;
    std::map<std::string, std::vector<std::string>> channels;
    for (const config::Channel& channel : rig.channels) {
        if (channel.machine.empty()) continue;
        if (channels[channel.machine].empty()) machines.push_back(channel.machine);
        channels[channel.machine].push_back(channel.name);
    }
    for (const std::string& machine : machines)
        if (tellMachine(master, machine, channels[machine]))
            gone.insert(gone.end(), channels[machine].begin(), channels[machine].end());
    awaitGone(master, gone);
}

// This machine goes off even where no master answers: it may be the last minute of a battery.
void powerOff(const PoweroffOptions& options) {
    try {
        powerOffNodes(config::readRig(options.rig), connectToMaster(options.rig, ""));
    } catch (const Error& problem) {
        logWarning("{}; the machines of nodes may stay on", problem.what());
    }
    machine::sayPower(machine::powerFolder(), "poweroff");
    cli::say("this machine: goes off");
}

}  // namespace

void addPoweroff(CommandLine& line) {
    const auto [command, options] = line.add<PoweroffOptions>(
        "poweroff", "power off the machines of a hall: those of nodes, then this one", powerOff);
    command.add_option("RIG", options.rig, "the rig of the hall")->required();
    command.footer("Only machines that are set up for it go off: those with the package aquarama.");
}

}  // namespace aquarama
