// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/report.h"

#include <algorithm>
#include <span>

#include "common/files/files.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/capture/report/gait_figures.h"
#include "master/capture/report/path_figures.h"
#include "master/capture/report/tables.h"

namespace aquarama::report {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStyle = R"(<style>
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #1d2b36; max-width: 1120px; margin: 2em auto; padding: 0 1em; }
h1, h2, h3 { font-weight: 600; line-height: 1.2; } h1 { margin-bottom: .2em; } h2 { margin-top: 2.2em; }
h3 { margin: 1.6em 0 .3em; }
p { max-width: 62em; }
.quiet, figcaption, th { color: #4a606c; } th { font-weight: 600; vertical-align: bottom; }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums; }
th, td { padding: .3em .9em; text-align: right; border-bottom: 1px solid #dbe5ea; }
th:first-child, td:first-child, .beside :nth-child(n+5), .words td { text-align: left; }
.words td:first-child { color: #4a606c; } code { font-size: 12px; overflow-wrap: anywhere; }
.swatch { display: inline-block; width: .7em; height: .7em; border-radius: 2px; margin-right: .5em; }
figure { margin: 1em 0; } figcaption { font-size: 13px; } svg { max-width: 100%; height: auto; }
.beside th { white-space: nowrap; }
.row { display: flex; flex-wrap: wrap; gap: 0 24px; align-items: flex-start; }
.three figure { flex: 1 1 340px; max-width: 360px; margin: .5em 0; }
</style>
)";

// The picture can be taken from the page by its name.
std::string figure(const std::string& name, const std::string& svg, const std::string& says = "") {
    return "<figure id=\"" + name + "\">\n" + svg + "<figcaption>" + says +
           "</figcaption></figure>\n";
}

// "blacktip_reef_shark" to "Blacktip reef shark"
std::string titleOf(std::string species) {
    std::ranges::replace(species, '_', ' ');
    if (species[0] >= 'a' && species[0] <= 'z')
        species[0] = static_cast<char>(species[0] - 'a' + 'A');
    return species;
}

std::string forwardSection(const motion::Repertoire& repertoire) {
    std::string html = "<h2>Swimming straight</h2>\n" + forwardTable(repertoire) +
                       "<h3>Body wave</h3>\n<div class=\"row three\">\n";
    for (std::size_t i = 0; i < kGaits; ++i) {
        const auto gait = static_cast<motion::Action>(i);
        html += figure(std::string("midlines_") + motion::nameOf(gait),
                       drawMidlines(repertoire, gait),
                       motion::nameOf(gait));
    }
    return html +
           "</div>\n<p class=\"quiet\">Midlines at 16 phases of one beat, dark to light; thick: "
           "how far each point of them swings; dashed: how far a saithe's does (Videler &amp; Hess "
           "1984), a carangiform swimmer.</p>\n<h3>Speed, Strouhal number and stride</h3>\n"
           "<div class=\"row\">" +
           figure("speed", drawSpeed(repertoire)) +
           figure("strouhal", drawStrouhalAndStride(repertoire)) +
           "</div>\n<p class=\"quiet\">The three captured gaits, and the straight line through "
           "them by least squares. Bainbridge's line is for beats above 5 Hz; for slower and "
           "larger "
           "fish it is a guide only.</p>\n";
}

std::string segmentSection(const motion::Repertoire& repertoire) {
    std::string html =
        "<h2>Segments from above</h2>\n<p>In each frame the body as it bends, and the body frame "
        "up to then (as in Figs. 3 and 4 of Yu &amp; Terzopoulos 1998).</p>\n";
    for (std::size_t i = 0; i < motion::kCapturedActions; ++i) {
        const std::string name = motion::nameOf(static_cast<motion::Action>(i));
        html += "<h3>" + name + "</h3>\n" + figure(name, drawSegment(repertoire.segments.at(i)));
    }
    return html;
}

}  // namespace

std::string reportPage(const motion::Repertoire& repertoire) {
    const std::string title = titleOf(repertoire.species);
    return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
           "name=\"viewport\" content=\"width=device-width\"><title>" +
           title + ": repertoire</title>" + kStyle + "</head><body>\n<h1>" + title +
           "</h1>\n<p class=\"quiet\">A repertoire of motion captured from a simulated fish. "
           "Lengths are in body lengths (BL), so that they hold for a fish of any size; a tick is "
           "1/60 s.</p>\n" +
           figure("body",
                  drawBody(repertoire),
                  "The fish when it glides, from its right and from above.") +
           fileTable(repertoire) + forwardSection(repertoire) +
           "<h2>Turning</h2>\n<p>To the left is positive. Living fish turn at 100 to 500 deg/s in "
           "routine turns (Domenici 2004), at the tightest with a radius of 0.11 (bass) to 0.18 BL "
           "(trout; Webb 1983).</p>\n" +
           turnTable(repertoire) + "<div class=\"row\">" +
           figure("turns",
                  drawTurns(repertoire),
                  "The way of the body frame's origin, and the heading at its end.") +
           figure("headings",
                  drawHeadings(repertoire),
                  "The heading of the body frame over the turn.") +
           "</div>\n" +
           "<h2>Closure</h2>\n<p>How a segment meets itself when it is repeated. Pose: by how much "
           "the farthest nodal point is off the smooth way of its neighbours in time, where the "
           "last phase meets the first and at most elsewhere. Heading: after one and after a "
           "hundred repetitions, from the course of a gait, or beyond so many times the angle of a "
           "turn. Lean is roll and pitch together.</p>\n" +
           closureTable(repertoire) + segmentSection(repertoire) + "</body></html>\n";
}

fs::path writeReport(const motion::Repertoire& repertoire, const fs::path& folder) {
    const std::string html = reportPage(repertoire);
    fs::path page = folder / (repertoire.species + ".html");
    files::writeWhole(page, std::as_bytes(std::span(html)));
    return page;
}

}  // namespace aquarama::report
