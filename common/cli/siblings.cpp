// SPDX-License-Identifier: Apache-2.0
#include "common/cli/siblings.h"

#include "common/units/log.h"

namespace aquarama::cli {

std::filesystem::path siblingProgram(const std::string& name) {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    auto program = folder / ("aquarama-" + name);
    if (!std::filesystem::exists(program)) {
        throw Error(program.string() +
                    " is missing; build or install all of Aquarama's programs into one folder");
    }
    return program;
}

}  // namespace aquarama::cli
