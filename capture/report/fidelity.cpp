// SPDX-License-Identifier: Apache-2.0
#include "capture/report/fidelity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "capture/report/report_data.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

constexpr double kPathGoal = 0.05;  // error at the end of a command, share of the path

// Ticks as seconds; empty for nothing.
std::string secondsIfAny(const std::optional<int>& ticks) {
    if (!ticks) return "";
    std::ostringstream text;
    text << *ticks / kTicksPerSecond;
    return text.str();
}

// One row of summariesCsv().
void addSummary(std::ostream& csv,
                const std::string& species,
                const std::string& command,
                std::span<const CommandErrors> errors) {
    const auto good = std::ranges::count_if(
        errors, [](const CommandErrors& one) { return one.pathErrorAtEnd <= kPathGoal; });
    const Summary s = summarise(errors);
    addRow(csv,
           species,
           command,
           s.commands,
           s.shapeWithin,
           s.shapeTransition,
           s.agreesAfterSeconds,
           s.neverAgree,
           s.pathErrorMedian,
           s.pathErrorNinth,
           s.pathErrorWorst,
           s.pathErrorAlong,
           s.pathErrorAcross,
           good,
           degreesOf(s.headingErrorRms));
}

// The mean speed over the beat that ends at a tick, body lengths a second: the distance of the
// places at its ends. `tick` is at least 1; a beat longer than that is cut.
double speedAt(const Trace& trace, std::size_t tick, double beatTicks) {
    const auto beat = std::min(static_cast<std::size_t>(std::lround(beatTicks)), tick);
    return glm::distance(trace[tick].frame.origin, trace[tick - beat].frame.origin) *
           kTicksPerSecond / static_cast<double>(beat);
}

// The rows of ticksCsv() for one species. Traces count ticks from the start of the run-in; the
// series of the comparison and the CSV count from its end, `start`.
void addTicks(std::ostream& csv, const Fidelity& fidelity) {
    const auto& [fish, replica, loose] = fidelity.traces;
    const Comparison& comparison = fidelity.comparison;
    const auto start = static_cast<std::size_t>(fidelity.script.front().ticks);
    const double beat = fidelity.script.front().beatTicks;
    // A command's replicaWay has one place more than the command has ticks: the first is that of
    // the tick before it, so the last tick of a command appears again as the first row of the next
    // one.
    for (std::size_t i = 0; i < comparison.commands.size(); ++i) {
        const CommandErrors& errors = comparison.commands[i];
        const auto first = static_cast<std::size_t>(errors.firstTick);
        for (std::size_t at = 0; at < errors.replicaWay.size(); ++at) {
            const std::size_t tick = first + at - start;  // since the end of the run-in
            // The series of shapes begin with the first tick of the first command, tick 1.
            const glm::dvec3& place = fish[first + at].frame.origin;
            const glm::dvec3& laidOver = errors.replicaWay[at];
            const glm::dvec3& alone = comparison.openLoop.replicaWay[tick];
            csv << fidelity.species << ',' << i << ',' << nameOf(errors.command.manoeuvre) << ',';
            csv << static_cast<double>(tick) / kTicksPerSecond << ',' << place.x << ',' << place.z;
            csv << ',' << laidOver.x << ',' << laidOver.z << ',' << alone.x << ',' << alone.z;
            if (at == 0)
                csv << ",,,,\n";
            else
                csv << ',' << comparison.shapeAsPlayed[tick - 1] << ','
                    << comparison.shapeInPhase[tick - 1] << ',' << speedAt(fish, first + at, beat)
                    << ',' << speedAt(replica, first + at, beat) << '\n';
        }
    }
}

}  // namespace

std::string commandTable(const Comparison& comparison) {
    std::string table =
        "| command | way, BL | off at its end, BL | heading off, deg | shape within, % BL |\n"
        "|---|---|---|---|---|\n";
    for (const CommandErrors& errors : comparison.commands) {
        const Manoeuvre manoeuvre = errors.command.manoeuvre;
        table += fmt::format("| {} | {:.2f} | {:.2f} | {:.1f} | {:.2f} |\n",
                             nameOf(manoeuvre),
                             errors.path,
                             errors.pathErrorAtEnd * (staysInPlace(manoeuvre) ? 1 : errors.path),
                             degreesOf(errors.headingError),
                             100 * errors.shapeWithin);
    }
    return table;
}

std::string commandsCsv(std::span<const Fidelity> species) {
    std::ostringstream csv;
    csv << "species,command,start_s,duration_s,lag_s,shape_within_bl,shape_transition_bl,"
           "shape_as_played_bl,agrees_after_s,path_bl,path_error_end,path_error_most,"
           "path_error_along,path_error_across,turn_deg,heading_error_deg\n";
    for (const Fidelity& fidelity : species) {
        for (const CommandErrors& errors : fidelity.comparison.commands)
            addRow(csv,
                   fidelity.species,
                   nameOf(errors.command.manoeuvre),
                   (errors.firstTick - fidelity.script.front().ticks) / kTicksPerSecond,
                   errors.command.ticks / kTicksPerSecond,
                   errors.lagTicks / kTicksPerSecond,
                   errors.shapeWithin,
                   errors.shapeTransition,
                   errors.shapeAsPlayed,
                   secondsIfAny(errors.agreesAfterTicks),
                   errors.path,
                   errors.pathErrorAtEnd,
                   errors.pathErrorMost,
                   errors.pathErrorAlong,
                   errors.pathErrorAcross,
                   degreesOf(errors.turn),
                   degreesOf(errors.headingError));
        // The whole script: columns that have no meaning for it are empty.
        const OpenLoopErrors& loose = fidelity.comparison.openLoop;
        csv << fidelity.species << ",open_loop,0," << ticksOf(fidelity.script) / kTicksPerSecond
            << ",,,,,," << loose.path << ',' << loose.distanceAtEnd / loose.path << ','
            << loose.distanceMost / loose.path << ",,,," << degreesOf(loose.headingAtEnd) << '\n';
    }
    return csv.str();
}

std::string summariesCsv(std::span<const Fidelity> species) {
    std::ostringstream csv;
    csv << "species,command,count,shape_within_bl,shape_transition_bl,agrees_after_s,never_agree,"
           "path_median,path_ninth,path_worst,path_along,path_across,paths_within_goal,"
           "heading_rms_deg\n";
    for (const Fidelity& fidelity : species)
        addSummary(csv, fidelity.species, "all", fidelity.comparison.commands);
    // A manoeuvre that no script contains has no row.
    for (int i = 0; i < kManoeuvres; ++i) {
        const auto manoeuvre = static_cast<Manoeuvre>(i);
        std::vector<CommandErrors> all;
        for (const Fidelity& fidelity : species) {
            const std::vector<CommandErrors> errors = errorsOf(fidelity, manoeuvre);
            if (!errors.empty()) addSummary(csv, fidelity.species, nameOf(manoeuvre), errors);
            std::ranges::copy(errors, std::back_inserter(all));
        }
        if (!all.empty()) addSummary(csv, "all", nameOf(manoeuvre), all);
    }
    return csv.str();
}

std::string ticksCsv(std::span<const Fidelity> species) {
    std::ostringstream csv;
    csv << "species,number,command,seconds,fish_x,fish_z,replica_x,replica_z,alone_x,alone_z,"
           "shape_as_played_bl,shape_in_phase_bl,fish_speed,replica_speed\n";
    for (const Fidelity& fidelity : species) addTicks(csv, fidelity);
    return csv.str();
}

std::string vocabulariesCsv(std::span<const SpeciesVocabularies> species) {
    std::ostringstream csv;
    csv << "species,segments,bytes,shape_within_bl,path_median,turn_heading_rms_deg\n";
    for (const SpeciesVocabularies& one : species)
        for (const VocabularyErrors& errors : one.errors)
            addRow(csv,
                   one.species,
                   errors.segments,
                   errors.bytes,
                   errors.shapeWithin,
                   errors.pathError,
                   degreesOf(errors.turnHeadingError));
    return csv.str();
}

}  // namespace aquarama::report
