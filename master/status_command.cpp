// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "common/config/rig.h"
#include "master/commands.h"
#include "master/conductor/requests.h"

namespace aquarama {

void addStatus(CLI::App& app, cli::Job& job) {
    struct Options {
        std::string rig = "config/desk.txtpb";
        std::string address;
    };
    auto options = std::make_shared<Options>();
    CLI::App& status = *app.add_subcommand("status", "what the running wall is doing");
    status.add_option("RIG", options->rig, "whose master is asked")->capture_default_str();
    status.add_option("--master", options->address, "its control address, instead of the rig's");
    status.callback([options, &job] {
        job = [options] {
            conductor::RequestClient master(options->address.empty()
                                                ? config::readRig(options->rig).controlAddress
                                                : options->address);
            std::cout << conductor::statusText(master.status());
            return 0;
        };
    });
}

}  // namespace aquarama
