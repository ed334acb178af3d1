// SPDX-License-Identifier: Apache-2.0
// What is found when one species and its replica are given the same script.
#pragma once

#include <span>
#include <string>

#include "master/capture/report/compare.h"
#include "master/capture/report/segment_count.h"

namespace aquarama::report {

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

// What the fidelity command writes as CSV; draw_fidelity.py makes the page, its pictures and the
// tables of it. Shares are of 1, lengths in body lengths (BL), places in the world from above.

// A line for each command, and for each species one of the whole script, "open_loop".
[[nodiscard]] std::string commandsCsv(std::span<const Fidelity> species);

// Errors over several commands: of each species, "all" and each manoeuvre; of "all" species, each
// manoeuvre.
[[nodiscard]] std::string summariesCsv(std::span<const Fidelity> species);

// Tick by tick where the fish is, where the replica is that was laid over it at the start of the
// command and the one that was left alone, how far their shapes differ and how fast they are. A
// command's first line is the tick before it, without shapes and speeds.
[[nodiscard]] std::string ticksCsv(std::span<const Fidelity> species);

// A line for each species and number of segments.
[[nodiscard]] std::string vocabulariesCsv(std::span<const SpeciesVocabularies> species);

}  // namespace aquarama::report
