// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/inspect.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "common/motion/repertoire.h"
#include "common/units/angle.h"
#include "common/units/digest.h"
#include "master/capture/measure/measure.h"
#include "master/capture/report/segment_measures.h"

namespace aquarama::report {

namespace {

// printf into a string: the tables here are all columns of figures.
template <class... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// No "-0.00" for what is zero but for rounding.
double cleaned(double value) {
    return std::abs(value) < 1e-5 ? 0 : value;
}

std::string rowOf(motion::Action action, const motion::ActionSegment& segment) {
    const capture::SegmentMeasures m = capture::measure(segment);
    const bool isForward = action <= motion::Action::ForwardFast;
    std::string row = line("  %-18s %8.4f %8.3f %8.3f",
                           motion::nameOf(action),
                           m.periodSeconds,
                           m.speedBodyLengths,
                           m.strideBodyLengths);
    // Amplitude is across a straight course, which a turn does not have.
    row += isForward ? line(" %7s %8s %8s", "-", "-", "-")
                     : line(" %7.1f %8.1f %8.2f",
                            m.turnRadians / kRadiansPerDegree<double>,
                            m.turnRate / kRadiansPerDegree<double>,
                            turnRadius(segment));
    row +=
        isForward ? line(" %8.3f %8.3f", m.tailAmplitude, m.strouhal) : line(" %8s %8s", "-", "-");
    row += line(" %9.4f %9.1e %9.1e\n",
                m.largestStep,
                cleaned(m.leanRadians / kRadiansPerDegree<double>),
                cleaned(m.climb));
    return row;
}

}  // namespace

// Little-endian, behind the five bytes "AQREP".
int formatVersionOf(std::span<const std::byte> intactRepertoire) {
    return std::to_integer<int>(intactRepertoire[5]) | std::to_integer<int>(intactRepertoire[6])
                                                           << 8;
}

std::string inspectRepertoire(std::span<const std::byte> bytes, const std::string& source) {
    const motion::Repertoire repertoire = motion::decodeRepertoire(bytes, source);
    const bool hasCage = !repertoire.segments[0].controlPoints.empty();
    std::string text = line("repertoire of %s, recorded at %.3f m, format version %d\n",
                            repertoire.species.c_str(),
                            static_cast<double>(repertoire.recordedLengthMetres),
                            formatVersionOf(bytes));
    text += line("%zu bytes, sha256 %s\n", bytes.size(), toHex(digestOf(bytes)).c_str());
    text += line("%d segments of %d phases, %d nodal points, %s\n",
                 motion::kCapturedActions,
                 motion::kPhases,
                 body::kNodalPoints,
                 hasCage ? "426 control points recorded" : "control points not recorded");
    const auto& [swim, glide, brake] = repertoire.response;
    text += line(
        "speed response: drag %.3f, %.3f, %.3f swimming, %.3f gliding, per BL;"
        " brake %.3f per s\n\n",
        static_cast<double>(swim[0]),
        static_cast<double>(swim[1]),
        static_cast<double>(swim[2]),
        static_cast<double>(glide),
        static_cast<double>(brake));
    text +=
        "                       period    speed   stride    turn     turn   radius     tail "
        "Strouhal   largest      lean     climb\n"
        "  segment                   s     BL/s       BL     deg    deg/s       BL   p-p BL   "
        "number   BL/tick deg/cycle  BL/cycle\n";
    for (int i = 0; i < motion::kCapturedActions; ++i)
        text += rowOf(static_cast<motion::Action>(i),
                      repertoire.segments.at(static_cast<std::size_t>(i)));
    return text;
}

}  // namespace aquarama::report
