// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/inspect.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "common/config/angle.h"
#include "common/motion/repertoire.h"
#include "common/units/digest.h"
#include "master/capture/measure/measure.h"

namespace aquarama {

namespace {

// printf into a string: the tables here are all columns of figures.
template <class... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// Little-endian, behind the five bytes "AQREP".
int versionOf(std::span<const std::byte> intact) {
    return std::to_integer<int>(intact[5]) | std::to_integer<int>(intact[6]) << 8;
}

// No "-0.00" for what is zero but for rounding.
double cleaned(double value) {
    return std::abs(value) < 1e-5 ? 0 : value;
}

std::string rowOf(Action action, const ActionSegment& segment) {
    const SegmentMeasures m = measure(segment);
    const bool isForward = action <= Action::ForwardFast;
    std::string row = line("  %-18s %8.4f %9.3f %8.3f %9.2f %8.1f",
                           nameOf(action),
                           m.periodSeconds,
                           m.speedBodyLengths,
                           m.strideBodyLengths,
                           cleaned(m.turnRadians / kRadiansPerDegree),
                           cleaned(m.turnRate / kRadiansPerDegree));
    // Amplitude is across a straight course; a turn has none.
    row +=
        isForward ? line(" %8.3f %8.3f", m.tailAmplitude, m.strouhal) : line(" %8s %8s", "-", "-");
    row += line(" %9.4f %9.1e %9.1e\n", m.largestStep, m.leanRadians / kRadiansPerDegree, m.climb);
    return row;
}

}  // namespace

std::string inspectRepertoire(std::span<const std::byte> bytes, const std::string& source) {
    const Repertoire repertoire = decodeRepertoire(bytes, source);
    const bool hasCage = !repertoire.segments[0].controlPoints.empty();
    std::string text = line("repertoire of %s, recorded at %.3f m, format version %d\n",
                            repertoire.species.c_str(),
                            static_cast<double>(repertoire.recordedLengthMetres),
                            versionOf(bytes));
    text += line("%zu bytes, sha256 %s\n", bytes.size(), toHex(digestOf(bytes)).c_str());
    text += line("%d segments of %d phases, %d nodal points%s\n\n",
                 kActions,
                 kPhases,
                 kNodalPoints,
                 hasCage ? " and 426 control points" : ", no control points");
    text +=
        "                       period     speed   stride      turn     turn     tail Strouhal   "
        "largest      lean     climb\n"
        "  segment                   s      BL/s       BL       deg    deg/s   p-p BL   number  "
        "BL/tick deg/cycle  BL/cycle\n";
    for (int i = 0; i < kActions; ++i)
        text += rowOf(static_cast<Action>(i), repertoire.segments.at(static_cast<std::size_t>(i)));
    return text;
}

}  // namespace aquarama
