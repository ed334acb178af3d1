// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/units/angle.h"
#include "master/capture/fidelity/fidelity_report.h"
#include "master/capture/report/svg.h"

namespace aquarama::fidelity {

namespace {

constexpr double kPathGoal = 0.05;

std::string hundredths(double share) {
    return report::fixed(share * 100, 2);
}
std::string tenthsOfDegrees(double radians) {
    return report::fixed(radians / kRadiansPerDegree<double>, 1);
}

std::string manoeuvreRow(Manoeuvre manoeuvre, std::span<const CommandErrors> commands) {
    const auto good = std::ranges::count_if(
        commands, [](const CommandErrors& errors) { return errors.pathErrorAtEnd <= kPathGoal; });
    const Summary s = summarise(commands);
    const double share = static_cast<double>(good) / static_cast<double>(s.commands);
    return std::string("| ") + nameOf(manoeuvre) + " | " + std::to_string(s.commands) + " | " +
           report::fixed(s.pathErrorMedian * 100, 1) + " | " + report::fixed(share * 100, 0) +
           " | " + hundredths(s.shapeWithin) + " | " + tenthsOfDegrees(s.headingErrorRms) + " |\n";
}

std::string manoeuvreTable(std::span<const Fidelity> species) {
    std::string table =
        "| command | count | path, median, % | % of them within 5 % | shape within a segment, % BL "
        "| heading, rms, deg |\n|---|---|---|---|---|---|\n";
    for (int i = 0; i < kManoeuvres; ++i) {
        const auto manoeuvre = static_cast<Manoeuvre>(i);
        std::vector<CommandErrors> all;
        for (const Fidelity& fidelity : species)
            std::ranges::copy(errorsOf(fidelity, manoeuvre), std::back_inserter(all));
        if (!all.empty()) table += manoeuvreRow(manoeuvre, all);
    }
    return table;
}

}  // namespace

std::string fidelityMarkdown(std::span<const Fidelity> species) {
    std::string table =
        "| species | commands | shape within a segment, % BL | shape in transitions, % BL "
        "| path, median, % | along, across, % | path, 9 of 10 within, % | heading, rms, deg | open "
        "loop: way, BL "
        "| off at the end, BL | heading off, deg |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
        "| *goal* | | *1* | | *5* | | *5* | | | | |\n";
    for (const Fidelity& fidelity : species) {
        const Summary s = summarise(fidelity.comparison.commands);
        const OpenLoopErrors& e = fidelity.comparison.openLoop;
        for (const std::string& cell : {fidelity.species,
                                        std::to_string(s.commands),
                                        hundredths(s.shapeWithin),
                                        hundredths(s.shapeTransition),
                                        report::fixed(s.pathErrorMedian * 100, 1),
                                        report::fixed(s.pathErrorAlong * 100, 1) + ", " +
                                            report::fixed(s.pathErrorAcross * 100, 1),
                                        report::fixed(s.pathErrorNinth * 100, 1),
                                        tenthsOfDegrees(s.headingErrorRms),
                                        report::fixed(e.path, 0),
                                        report::fixed(e.distanceAtEnd, 1),
                                        tenthsOfDegrees(e.headingAtEnd)})
            table += "| " + cell + " ";
        table += "|\n";
    }
    return table + "\n" + manoeuvreTable(species);
}

}  // namespace aquarama::fidelity
