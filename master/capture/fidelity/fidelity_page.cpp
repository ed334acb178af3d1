// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <initializer_list>

#include "common/units/angle.h"
#include "common/units/ids.h"
#include "master/capture/fidelity/fidelity_figures.h"
#include "master/capture/fidelity/fidelity_report.h"
#include "master/capture/report/svg.h"

namespace aquarama::fidelity {

namespace {

constexpr const char* kHead =
    R"(<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Fidelity of the replicas</title><style>
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #1d2b36; max-width: 1110px; margin: 2em auto; padding: 0 1em; }
h1, h2 { font-weight: 600; } h2 { margin-top: 2.5em; border-top: 1px solid #dbe5ea; padding-top: 1em; }
table { border-collapse: collapse; font-size: 14px; }
th, td { padding: .2em .7em; text-align: right; border-bottom: 1px solid #dbe5ea; white-space: nowrap; }
th { font-weight: 600; color: #4a606c; white-space: normal; } th:first-child, td:first-child { text-align: left; }
tr.all td { font-weight: 600; } .over { color: #c0392b; }
svg { max-width: 100%; height: auto; display: block; margin: 1em 0; } summary { cursor: pointer; margin: 1em 0; }
</style></head><body>
<h1>Fidelity of the replicas</h1>
<p>The biomechanical fish and its kinematic replica obey the same commands. Shape: root mean square distance of the
23 nodal points in the body frame, in per cent of a body length (BL); within a segment, after the first beat, at the lag
of its beat; and in the transition, the first beat as it was played. Path: distance at the end of a command, in
per cent of the way, laid over each other at its start by place and heading; along the way it is the speed's, across it the heading's
(medians). <span class="over">Over the goal</span>:
shape 1 % within a segment, path 5 %.</p>
)";
constexpr double kShapeGoal = 0.01;
constexpr double kPathGoal = 0.05;

std::string row(std::initializer_list<std::string> cells, const std::string& attributes = "") {
    std::string html = "<tr" + attributes + ">";
    for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
    return html + "</tr>\n";
}

std::string percent(double share) {
    return report::fixed(share * 100, 2);
}
std::string percent(double share, double goal) {
    return share > goal ? "<span class=\"over\">" + percent(share) + "</span>" : percent(share);
}
std::string degrees(double radians) {
    return report::fixed(radians / kRadiansPerDegree<double>, 1);
}

constexpr const char* kSummaryHead =
    "<table><tr><th>command</th><th>count</th><th>shape within, %</th><th>in transition, %</th>"
    "<th>agrees after, s</th><th>path, median, %</th><th>9 of 10 within, %</th><th>worst, "
    "%</th><th>along, %</th><th>across, %</th>"
    "<th>heading, rms, deg</th></tr>\n";

std::string summaryRow(const std::string& name,
                       std::span<const CommandErrors> errors,
                       const std::string& attributes = "") {
    const Summary s = summarise(errors);
    return row({name,
                std::to_string(s.commands),
                percent(s.shapeWithin, kShapeGoal),
                percent(s.shapeTransition),
                s.neverAgree == s.commands ? "never" : report::fixed(s.agreesAfterSeconds, 2),
                percent(s.pathErrorMedian, kPathGoal),
                percent(s.pathErrorNinth, kPathGoal),
                percent(s.pathErrorWorst, kPathGoal),
                percent(s.pathErrorAlong),
                percent(s.pathErrorAcross),
                degrees(s.headingErrorRms)},
               attributes);
}

std::string summaryTable(const Fidelity& fidelity) {
    std::string html = kSummaryHead;
    for (int i = 0; i < kManoeuvres; ++i) {
        const auto manoeuvre = static_cast<Manoeuvre>(i);
        const std::vector<CommandErrors> errors = errorsOf(fidelity, manoeuvre);
        if (!errors.empty()) html += summaryRow(nameOf(manoeuvre), errors);
    }
    return html + summaryRow("all", fidelity.comparison.commands, " class=\"all\"") + "</table>\n";
}

std::string commandTable(const Fidelity& fidelity) {
    std::string html =
        "<details><summary>Command by command</summary><table><tr><th>command</th>"
        "<th>start, s</th><th>lasts, s</th><th>lag of the beat, s</th><th>shape within, %</th>"
        "<th>in transition, %</th><th>path, BL</th><th>error at the end, %</th><th>most, %</th>"
        "<th>turn, deg</th><th>heading error, deg</th></tr>\n";
    for (const CommandErrors& e : fidelity.comparison.commands)
        html +=
            row({nameOf(e.command.manoeuvre),
                 report::fixed((e.firstTick - fidelity.script.front().ticks) / kTicksPerSecond, 2),
                 report::fixed(e.command.ticks / kTicksPerSecond, 2),
                 report::fixed(e.lagTicks / kTicksPerSecond, 3),
                 percent(e.shapeWithin, kShapeGoal),
                 percent(e.shapeTransition),
                 report::fixed(e.path, 2),
                 percent(e.pathErrorAtEnd, kPathGoal),
                 percent(e.pathErrorMost),
                 degrees(e.turn),
                 degrees(e.headingError)});
    return html + "</table></details>\n";
}

std::string openLoopText(const Fidelity& fidelity) {
    const OpenLoopErrors& e = fidelity.comparison.openLoop;
    return "<p>Left alone for the whole script, the replica ends " +
           report::fixed(e.distanceAtEnd, 1) + " BL from the fish after a way of " +
           report::fixed(e.path, 1) + " BL (" + percent(e.distanceAtEnd / e.path) + " %; at most " +
           report::fixed(e.distanceMost, 1) + " BL) and heads " + degrees(e.headingAtEnd) +
           " degrees from it.</p>\n";
}

}  // namespace

std::string fidelityPage(std::span<const Fidelity> species,
                         std::span<const SpeciesVocabularies> vocabularies,
                         std::uint64_t seed) {
    std::string html = kHead;
    html += "<p>Script " + std::to_string(seed) + ".</p>\n" + std::string(kSummaryHead);
    for (const Fidelity& fidelity : species)
        html += summaryRow(fidelity.species, fidelity.comparison.commands);
    html += "</table>\n<h2>How few segments are enough</h2>\n" + drawVocabularies(vocabularies);
    for (const Fidelity& fidelity : species)
        html += "<h2>" + fidelity.species + "</h2>\n" + drawWays(fidelity) +
                openLoopText(fidelity) + drawTimes(fidelity) + summaryTable(fidelity) +
                commandTable(fidelity);
    return html + "</body></html>\n";
}

}  // namespace aquarama::fidelity
