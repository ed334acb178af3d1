// SPDX-License-Identifier: Apache-2.0
// Fidelity: the errors of a species' replica against the biomechanical fish under the same script,
// and the files of CSV that hold them.
#pragma once

#include <span>
#include <string>

#include "capture/report/compare.h"
#include "capture/report/segment_count.h"

namespace aquarama::report {

// Script, traces and errors of one species.
struct Fidelity {
    std::string species;
    Script script;
    Traces traces;
    Comparison comparison;
};

// Simulates both fish under makeScript(repertoire, seed, seconds). The repertoire is that of the
// species. Runs on the calling thread.
[[nodiscard]] inline Fidelity measureFidelity(const config::Species& species,
                                              const motion::Repertoire& repertoire,
                                              std::uint64_t seed,
                                              double seconds) {
    Script script = makeScript(repertoire, seed, seconds);
    Traces traces = traceBoth(species, repertoire, script);
    Comparison comparison = compare(script, traces);
    return {species.name, std::move(script), std::move(traces), std::move(comparison)};
}

// The errors of the commands with one manoeuvre, in the order of the script.
[[nodiscard]] inline std::vector<CommandErrors> errorsOf(const Fidelity& fidelity,
                                                         Manoeuvre manoeuvre) {
    std::vector<CommandErrors> errors;
    for (const CommandErrors& command : fidelity.comparison.commands)
        if (command.command.manoeuvre == manoeuvre) errors.push_back(command);
    return errors;
}

// A table of the commands of one script, in Markdown: each command's way, and how far the replica
// is off at its end in place, heading and shape.
[[nodiscard]] std::string commandTable(const Comparison& comparison);

// The CSV that the command `fidelity` writes and draw_fidelity.py reads. Shares are of 1, lengths
// are body lengths (BL), places are x and z of the world; the first line names the columns. A value
// that does not exist is empty.

// A row for each command, and for each species one for the whole script with the uncorrected
// replica, "open_loop".
[[nodiscard]] std::string commandsCsv(std::span<const Fidelity> species);

// A row for each summary of several commands: first, for each species, "all" its commands; then,
// for each manoeuvre, each species and "all" species together.
[[nodiscard]] std::string summariesCsv(std::span<const Fidelity> species);

// A row for each tick: the places of the fish, of the replica (moved and turned to the fish at the
// start of the command) and of the uncorrected replica; the errors of the shape; both speeds. A
// command's first row is the tick before it, without shapes and speeds.
[[nodiscard]] std::string ticksCsv(std::span<const Fidelity> species);

// A row for each species and number of segments.
[[nodiscard]] std::string vocabulariesCsv(std::span<const SpeciesVocabularies> species);

}  // namespace aquarama::report
