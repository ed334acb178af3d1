// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "master/capture/commands.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/capture/report/inspect.h"

namespace aquarama {

void addInspectCommand(CLI::App& app) {
    const auto file = std::make_shared<std::string>();
    CLI::App& inspect = *app.add_subcommand("inspect", "what a repertoire holds");
    inspect.add_option("FILE", *file, "a repertoire")->required();
    inspect.callback([file] { std::cout << inspectRepertoire(readWhole(*file), *file); });
}

}  // namespace aquarama
