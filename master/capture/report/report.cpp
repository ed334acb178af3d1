// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/report.h"

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "common/config/angle.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/capture/measure/measure.h"
#include "master/capture/report/figures.h"
#include "master/capture/report/svg.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStyle = R"(<style>
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #1d2b36; max-width: 1110px; margin: 2em auto; padding: 0 1em; }
h1, h2 { font-weight: 600; } h2 { margin-top: 2em; }
table { border-collapse: collapse; }
th, td { padding: .25em .8em; text-align: right; border-bottom: 1px solid #dbe5ea; }
th:first-child, td:first-child, .beside :nth-child(n+5) { text-align: left; }
img { max-width: 100%; } figure { margin: 1em 0; } figcaption { color: #4a606c; }
</style>
)";

// How a figure of each segment is shown: so many cycles that a turn can be seen.
int cyclesShown(const SegmentMeasures& m, const ActionSegment& segment) {
    if (segment.playsToEnd || std::abs(m.turnRadians) < 1e-3) return 1;
    return static_cast<int>(std::ceil(1.0 / std::abs(m.turnRadians)));
}

double peakTurnRate(const ActionSegment& segment) {
    double peak = 0;
    for (const FrameIncrement& increment : segment.increments)
        peak = std::max(peak, std::abs(static_cast<double>(glm::angle(increment.rotation))));
    return peak * kPhases / static_cast<double>(segment.periodSeconds);
}

std::string cells(std::span<const std::string> values) {
    std::string row = "<tr>";
    for (const std::string& value : values) row += "<td>" + value + "</td>";
    return row + "</tr>\n";
}

struct Quantity {
    const char* name;
    double (*of)(const SegmentMeasures&);
    int digits;
    const char* published;
    const char* source;
};
constexpr std::array kQuantities{
    Quantity{"beat, Hz", [](const SegmentMeasures& m) { return 1 / m.periodSeconds; }, 2, "", ""},
    Quantity{"speed, BL/s",
             [](const SegmentMeasures& m) { return m.speedBodyLengths; },
             2,
             "chub mackerel of this size filmed at 1.2 and 2.2; dace, trout and goldfish "
             "(3 f &minus; 4) / 4, so 2.75 at 5 Hz",
             "Nauen &amp; Lauder 2002; Bainbridge 1958"},
    Quantity{"stride, BL a beat",
             [](const SegmentMeasures& m) { return m.strideBodyLengths; },
             3,
             "0.6 to 0.7",
             "Videler &amp; Wardle 1991"},
    Quantity{"tail, peak to peak, BL",
             [](const SegmentMeasures& m) { return m.tailAmplitude; },
             3,
             "rises with frequency to about 0.2",
             "Bainbridge 1958"},
    Quantity{"nose, peak to peak, BL",
             [](const SegmentMeasures& m) { return m.noseAmplitude; },
             3,
             "0.008 to 0.024 (largemouth bass)",
             "Jayne &amp; Lauder 1995"},
    Quantity{"Strouhal number",
             [](const SegmentMeasures& m) { return m.strouhal; },
             3,
             "0.2 to 0.4",
             "Taylor, Nudds &amp; Thomas 2003"},
    Quantity{"largest step of a nodal point, BL a tick of 1/60 s",
             [](const SegmentMeasures& m) { return m.largestStep; },
             4,
             "",
             ""},
};

std::string forwardTable(const Repertoire& repertoire) {
    std::string html =
        "<h2>Swimming straight</h2>\n<table "
        "class=\"beside\"><tr><th></th><th>slow</th><th>medium</th>"
        "<th>fast</th><th>living fish</th><th>source</th></tr>\n";
    for (const Quantity& quantity : kQuantities) {
        std::array<std::string, 6> row{
            quantity.name, "", "", "", quantity.published, quantity.source};
        for (std::size_t i = 0; i < 3; ++i)
            row.at(1 + i) = fixed(quantity.of(measure(repertoire.segments.at(i))), quantity.digits);
        html += cells(row);
    }
    return html + "</table>\n";
}

std::string turnTable(const Repertoire& repertoire) {
    std::string html =
        "<h2>Turning</h2>\n<p>To the left is positive. Routine turns of living fish peak at 100 to "
        "500 "
        "deg/s (Domenici 2004).</p>\n<table><tr><th>segment</th><th>cycle, s</th>"
        "<th>turn of a cycle, deg</th><th>mean rate, deg/s</th><th>peak rate, deg/s</th>"
        "<th>speed, BL/s</th><th>radius, BL</th><th>largest step, BL/tick</th></tr>\n";
    for (std::size_t i = 3; i < kActions; ++i) {
        const ActionSegment& segment = repertoire.segments.at(i);
        const SegmentMeasures m = measure(segment);
        const std::array<std::string, 8> row{nameOf(static_cast<Action>(i)),
                                             fixed(m.periodSeconds, 3),
                                             fixed(m.turnRadians / kRadiansPerDegree, 1),
                                             fixed(m.turnRate / kRadiansPerDegree, 1),
                                             fixed(peakTurnRate(segment) / kRadiansPerDegree, 0),
                                             fixed(m.speedBodyLengths, 2),
                                             fixed(m.speedBodyLengths / std::abs(m.turnRate), 2),
                                             fixed(m.largestStep, 4)};
        html += cells(row);
    }
    return html + "</table>\n";
}

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

fs::path writeReport(const Repertoire& repertoire, const FishBody& body, const fs::path& folder) {
    const auto figure =
        [&](const std::string& name, const std::string& svg, const std::string& says) {
            const std::string file = repertoire.species + "-" + name + ".svg";
            writeWhole(folder / file, bytesOf(svg));
            return "<figure><img src=\"" + file + "\" alt=\"" + says + "\"><figcaption>" + says +
                   "</figcaption></figure>\n";
        };
    std::string html =
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
        repertoire.species + "</title>" + kStyle + "</head><body>\n<h1>" + repertoire.species +
        ", captured</h1>\n<p>Recorded from a fish of " +
        fixed(static_cast<double>(repertoire.recordedLengthMetres), 2) +
        " m. Lengths are in body lengths (BL), so that they hold for a fish of any "
        "size.</p>\n" +
        forwardTable(repertoire) + turnTable(repertoire) +
        "<h2>Midlines over a beat</h2>\n<p>Dark to light through one beat; dashed: the "
        "envelope of a saithe (Videler &amp; Hess 1984).</p>\n";
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string name = nameOf(static_cast<Action>(i));
        html += figure("midlines-" + name, drawMidlines(body, repertoire.segments.at(i)), name);
    }
    html +=
        "<h2>Segments from above</h2>\n<p>In each frame the body as it bends, and the body frame "
        "up "
        "to then.</p>\n";
    for (std::size_t i = 0; i < kActions; ++i) {
        const ActionSegment& segment = repertoire.segments.at(i);
        const std::string name = nameOf(static_cast<Action>(i));
        const int cycles = cyclesShown(measure(segment), segment);
        html += figure(name,
                       drawSegment(body, segment, cycles),
                       name + (cycles == 1 ? "" : ", " + std::to_string(cycles) + " cycles"));
    }
    fs::path page = folder / (repertoire.species + ".html");
    writeWhole(page, bytesOf(html + "</body></html>\n"));
    return page;
}

}  // namespace aquarama
