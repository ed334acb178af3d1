// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/units/angle.h"
#include "common/units/digest.h"
#include "master/capture/measure/body_wave.h"
#include "master/capture/measure/measure.h"
#include "master/capture/report/closure.h"
#include "master/capture/report/gait_figures.h"
#include "master/capture/report/inspect.h"
#include "master/capture/report/plot.h"

namespace aquarama::report {

namespace {

using Cells = std::vector<std::string>;

std::string row(const Cells& values, const char* cell = "td") {
    std::string html = "<tr>";
    for (const std::string& value : values)
        html += "<" + std::string(cell) + ">" + value + "</" + cell + ">";
    return html + "</tr>\n";
}

std::string segmentCell(std::size_t action) {
    return std::string("<span class=\"swatch\" style=\"background:") + colourOf(action) +
           "\"></span>" + motion::nameOf(static_cast<motion::Action>(action));
}

// What is zero but for rounding is no exponent to read.
std::string exact(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0e", std::abs(value));
    return std::abs(value) < 1e-9 ? "0" : text.data();
}

double degrees(double radians) {
    return radians / kRadiansPerDegree<double>;
}

struct Quantity {
    const char* name;
    double (*of)(const motion::ActionSegment&);
    int digits;
    const char* living;
    const char* source;
};
constexpr std::array kQuantities{
    Quantity{
        "tail beat, Hz",
        [](const motion::ActionSegment& s) { return 1 / static_cast<double>(s.periodSeconds); },
        2,
        "",
        ""},
    Quantity{"speed, BL/s",
             [](const motion::ActionSegment& s) { return capture::measure(s).speedBodyLengths; },
             2,
             "linear in the beat, see below",
             "Bainbridge 1958"},
    Quantity{"stride, BL a beat",
             [](const motion::ActionSegment& s) { return capture::measure(s).strideBodyLengths; },
             3,
             "0.5&ndash;0.7, typically 0.6&ndash;0.7",
             "Videler &amp; Wardle 1991"},
    Quantity{"tail, peak to peak, BL",
             [](const motion::ActionSegment& s) { return capture::measure(s).tailAmplitude; },
             3,
             "rises with the beat to about 0.2",
             "Bainbridge 1958"},
    Quantity{"Strouhal number, beat &times; tail / speed",
             [](const motion::ActionSegment& s) { return capture::measure(s).strouhal; },
             3,
             "0.2&ndash;0.4",
             "Taylor, Nudds &amp; Thomas 2003"},
    Quantity{"nose, peak to peak, BL",
             [](const motion::ActionSegment& s) { return capture::measure(s).noseAmplitude; },
             3,
             "0.008&ndash;0.024 (largemouth bass)",
             "Jayne &amp; Lauder 1995"},
    Quantity{"length of the body wave, BL",
             [](const motion::ActionSegment& s) { return capture::bodyWave(s).wavelength; },
             2,
             "0.9&ndash;1.1 (carangiform)",
             "Videler &amp; Hess 1984"},
};

std::string threeDigits(float perBodyLength) {
    return fixed(static_cast<double>(perBodyLength), 3);
}

}  // namespace

double turnRadius(const motion::ActionSegment& segment) {
    const capture::SegmentMeasures m = capture::measure(segment);
    return m.strideBodyLengths / std::abs(m.turnRadians);
}

double peakTurnRate(const motion::ActionSegment& segment) {
    double peak = 0;
    for (const motion::FrameIncrement& increment : segment.increments)
        peak = std::max(peak, std::abs(static_cast<double>(glm::angle(increment.rotation))));
    return peak * motion::kPhases / static_cast<double>(segment.periodSeconds);
}

std::string fileTable(const motion::Repertoire& repertoire) {
    const std::vector<std::byte> bytes = motion::encodeRepertoire(repertoire);
    const bool hasCage = !repertoire.segments[0].controlPoints.empty();
    const auto& [swim, glide, brake] = repertoire.response;
    const bool isMeasured = glide > 0 || brake > 0;
    return "<table class=\"words\">" +
           row({"recorded fish",
                fixed(static_cast<double>(repertoire.recordedLengthMetres), 3) +
                    " m, nose to tip of the tail"}) +
           row({"segments",
                std::to_string(motion::kCapturedActions) + " captured, " +
                    std::to_string(motion::kPhases) + " phases each"}) +
           row({"poses",
                std::to_string(body::kNodalPoints) + " nodal points" +
                    (hasCage ? " and " + std::to_string(body::kControlPoints) + " control points"
                             : "; control points are computed from them, not recorded")}) +
           row({"speed response",
                isMeasured ? "drag " + threeDigits(swim[0]) + ", " + threeDigits(swim[1]) + ", " +
                                 threeDigits(swim[2]) + " swimming, " + threeDigits(glide) +
                                 " gliding, per BL; brake " + threeDigits(brake) + " per s"
                           : "not measured"}) +
           row({"file",
                std::to_string(bytes.size()) + " bytes, format version " +
                    std::to_string(formatVersionOf(bytes))}) +
           row({"SHA-256", "<code>" + toHex(digestOf(bytes)) + "</code>"}) + "</table>\n";
}

std::string forwardTable(const motion::Repertoire& repertoire) {
    std::string html =
        "<table class=\"beside\">" +
        row({"", segmentCell(0), segmentCell(1), segmentCell(2), "living fish", ""}, "th");
    for (const Quantity& quantity : kQuantities) {
        Cells cells{quantity.name};
        for (std::size_t i = 0; i < kGaits; ++i)
            cells.push_back(fixed(quantity.of(repertoire.segments.at(i)), quantity.digits));
        cells.insert(cells.end(), {quantity.living, quantity.source});
        html += row(cells);
    }
    return html + "</table>\n";
}

std::string turnTable(const motion::Repertoire& repertoire) {
    std::string html = "<table>" + row({"segment",
                                        "lasts, s",
                                        "turns, deg",
                                        "mean radius, BL",
                                        "mean rate, deg/s",
                                        "peak rate, deg/s",
                                        "mean speed, BL/s"},
                                       "th");
    for (std::size_t i = kGaits; i < motion::kCapturedActions; ++i) {
        const motion::ActionSegment& segment = repertoire.segments.at(i);
        const capture::SegmentMeasures m = capture::measure(segment);
        html += row({segmentCell(i),
                     fixed(m.periodSeconds, 3),
                     fixed(degrees(m.turnRadians), 1),
                     fixed(turnRadius(segment), 2),
                     fixed(degrees(m.turnRate), 0),
                     fixed(degrees(peakTurnRate(segment)), 0),
                     fixed(m.speedBodyLengths, 2)});
    }
    return html + "</table>\n";
}

std::string closureTable(const motion::Repertoire& repertoire) {
    std::string html =
        "<table><tr><th rowspan=\"2\">segment</th><th colspan=\"2\">pose, BL off a smooth way</th>"
        "<th colspan=\"2\">heading, deg</th><th colspan=\"2\">lean, deg</th>"
        "<th colspan=\"2\">climb, BL</th><th rowspan=\"2\">largest step,<br>BL a tick</th></tr>\n" +
        row({"at the join", "elsewhere", "after 1", "100", "after 1", "100", "after 1", "100"},
            "th");
    for (std::size_t i = 0; i < motion::kCapturedActions; ++i) {
        const motion::ActionSegment& segment = repertoire.segments.at(i);
        const Seam seam = seamOf(segment);
        const Drift once = driftAfter(segment, 1);
        const Drift often = driftAfter(segment, 100);
        html += row({segmentCell(i),
                     fixed(seam.atTheJoin, 5),
                     fixed(seam.elsewhere, 5),
                     exact(degrees(once.headingRadians)),
                     exact(degrees(often.headingRadians)),
                     exact(degrees(once.leanRadians)),
                     exact(degrees(often.leanRadians)),
                     exact(once.climb),
                     exact(often.climb),
                     fixed(capture::measure(segment).largestStep, 4)});
    }
    return html + "</table>\n";
}

}  // namespace aquarama::report
