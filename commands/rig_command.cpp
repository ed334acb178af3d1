// SPDX-License-Identifier: Apache-2.0
// `aquarama rig inventory`: the machines of a rig, as Ansible takes them.
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/config/rig_network.h"

namespace aquarama {

namespace {

using nlohmann::json;

struct InventoryOptions {
    std::string rig;
};

// The host of "tcp://[fd00::1]:7400", as ssh takes it.
std::string sshHostOf(const std::string& address) {
    const std::string_view host = config::hostOf(address);
    const bool isSix = host.starts_with('[') && host.ends_with(']');
    return std::string(isSix ? host.substr(1, host.size() - 2) : host);
}

// The machines of a rig by what they do: of groups, hosts with their variables: the name of the
// rig's file and that of the hall. The master's machine is named by its address, others as the rig
// names them.
json inventoryOf(const config::Rig& rig, const std::string& hall) {
    const std::string master = sshHostOf(rig.controlAddress);
    json machines;
    json groups;
    const auto add = [&](const char* group, const std::string& machine) -> json& {
        groups[group]["hosts"][machine] = json::object();
        json& variables = machines[machine];
        variables["aquarama_hall"] = hall;
        variables["aquarama_name"] = rig.name;
        variables["aquarama_master"] = master;
        return variables;
    };
    add("masters", master);
    if (rig.consolePort != 0) add("consoles", master);
    for (const config::Channel& channel : rig.channels)
        add("nodes", channel.machine.empty() ? master : channel.machine)["aquarama_channels"]
            .push_back(channel.name);
    if (rig.standby)
        add("standbys", rig.standby->machine)["ansible_host"] =
            sshHostOf(rig.standby->controlAddress);
    for (const char* const group : {"consoles", "standbys"})  // the playbook asks for both
        if (!groups.contains(group)) groups[group]["hosts"] = json::object();
    return {{"all", {{"hosts", machines}, {"children", groups}}}};
}

// Throws Error where the rig has one machine only.
void printInventory(const InventoryOptions& options) {
    const config::Rig rig = config::parseRig(config::readTextFile(options.rig), options.rig);
    if (!config::needsKeys(rig))
        throw Error(options.rig + ": listens on its own machine only (" + rig.controlAddress +
                    "); give network the address of a network card first");
    const std::string hall = std::filesystem::path(options.rig).stem().string();
    cli::say(inventoryOf(rig, hall).dump(2));
}

}  // namespace

void addRig(CommandLine& line) {
    struct Nothing {};
    const auto rig =
        line.add<Nothing>("rig", "what other programs ask of a rig", [](const Nothing&) {
            throw CLI::RequiredError("rig: inventory");
        });
    const auto inventory = line.addTo<InventoryOptions>(
        rig.app, "inventory", "print its machines as an inventory of Ansible", printInventory);
    inventory.app.add_option("RIG", inventory.options.rig, "the rig")->required();
    inventory.app.footer("Write it into a file that ends in .json.");
}

}  // namespace aquarama
