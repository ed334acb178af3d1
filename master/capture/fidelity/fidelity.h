// SPDX-License-Identifier: Apache-2.0
// What is found when one species and its replica are given the same script.
#pragma once

#include <string>

#include "master/capture/fidelity/compare.h"

namespace aquarama::fidelity {

struct Fidelity {
    std::string species;
    Script script;
    Traces traces;
    Comparison comparison;
};

[[nodiscard]] inline Fidelity measureFidelity(const config::Species& species,
                                              const motion::Repertoire& repertoire,
                                              std::uint64_t seed,
                                              double seconds) {
    Script script = makeScript(repertoire, seed, seconds);
    Traces traces = traceBoth(species, repertoire, script);
    Comparison comparison = compare(script, traces);
    return {species.name, std::move(script), std::move(traces), std::move(comparison)};
}

// Of one manoeuvre, in the order of the script.
[[nodiscard]] inline std::vector<CommandErrors> errorsOf(const Fidelity& fidelity,
                                                         Manoeuvre manoeuvre) {
    std::vector<CommandErrors> errors;
    for (const CommandErrors& command : fidelity.comparison.commands)
        if (command.command.manoeuvre == manoeuvre) errors.push_back(command);
    return errors;
}

}  // namespace aquarama::fidelity
