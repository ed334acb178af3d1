// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "common/units/angle.h"
#include "common/units/ids.h"
#include "master/capture/fidelity/fidelity_report.h"
#include "master/capture/report/svg.h"

namespace aquarama::fidelity {

namespace {

constexpr const char* kHead =
    "species,command,start_s,duration_s,lag_s,shape_within_bl,shape_transition_bl,"
    "shape_as_played_bl,agrees_after_s,path_bl,path_error_end,path_error_most,path_error_along,"
    "path_error_across,turn_deg,"
    "heading_error_deg\n";

template <std::size_t kCells>
std::string row(const std::array<std::string, kCells>& cells) {
    std::string line;
    for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
    return line + "\n";
}

std::string rowOf(const Fidelity& fidelity, const CommandErrors& errors) {
    const double start = (errors.firstTick - fidelity.script.front().ticks) / kTicksPerSecond;
    return row(std::array{
        fidelity.species,
        std::string(nameOf(errors.command.manoeuvre)),
        report::fixed(start, 3),
        report::fixed(errors.command.ticks / kTicksPerSecond, 3),
        report::fixed(errors.lagTicks / kTicksPerSecond, 4),
        report::fixed(errors.shapeWithin, 5),
        report::fixed(errors.shapeTransition, 5),
        report::fixed(errors.shapeAsPlayed, 5),
        errors.agreesAfterTicks ? report::fixed(*errors.agreesAfterTicks / kTicksPerSecond, 3) : "",
        report::fixed(errors.path, 3),
        report::fixed(errors.pathErrorAtEnd, 4),
        report::fixed(errors.pathErrorMost, 4),
        report::fixed(errors.pathErrorAlong, 4),
        report::fixed(errors.pathErrorAcross, 4),
        report::fixed(errors.turn / kRadiansPerDegree<double>, 2),
        report::fixed(errors.headingError / kRadiansPerDegree<double>, 2)});
}

std::string openLoopRow(const Fidelity& fidelity) {
    const OpenLoopErrors& errors = fidelity.comparison.openLoop;
    return row(std::array{fidelity.species,
                          std::string("open_loop"),
                          report::fixed(0, 3),
                          report::fixed(ticksOf(fidelity.script) / kTicksPerSecond, 3),
                          std::string(),
                          std::string(),
                          std::string(),
                          std::string(),
                          std::string(),
                          report::fixed(errors.path, 3),
                          report::fixed(errors.distanceAtEnd / errors.path, 4),
                          report::fixed(errors.distanceMost / errors.path, 4),
                          std::string(),
                          std::string(),
                          std::string(),
                          report::fixed(errors.headingAtEnd / kRadiansPerDegree<double>, 2)});
}

}  // namespace

std::string fidelityCsv(std::span<const Fidelity> species) {
    std::string csv = kHead;
    for (const Fidelity& fidelity : species) {
        for (const CommandErrors& errors : fidelity.comparison.commands)
            csv += rowOf(fidelity, errors);
        csv += openLoopRow(fidelity);
    }
    return csv;
}

}  // namespace aquarama::fidelity
