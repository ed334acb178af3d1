// SPDX-License-Identifier: Apache-2.0
#include "capture/report/report_data.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "capture/biomechanical_fish.h"
#include "capture/measure.h"
#include "capture/report/segment_figures.h"
#include "capture/report/silhouette.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/units.h"
#include "common/body/cage.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

// The report.

constexpr std::size_t kViews = 8;  // of each segment, evenly spaced from its start to its end

// The file: its size and digest are those of the repertoire encoded anew.
json fileData(const motion::Repertoire& repertoire) {
    const std::vector<std::byte> bytes = motion::encodeRepertoire(repertoire);
    return {
        {"recorded_metres", repertoire.recordedLengthMetres},
        {"segments", motion::kCapturedActions},
        {"phases", motion::kPhases},
        {"nodal_points", body::kNodalPoints},
        {"control_points", repertoire.segments[0].controlPoints.empty() ? 0 : body::kControlPoints},
        {"swim_drag", repertoire.response.swimDrag},
        {"retreat_drag", repertoire.response.retreatDrag},
        {"glide_drag", repertoire.response.glideDrag},
        {"brake_rate", repertoire.response.brakeRate},
        {"bytes", bytes.size()},
        {"format_version", formatVersionOf(bytes)},
        {"sha256", toHex(digestOf(bytes))}};
}

// The straight fish: nodal points, springs and muscles between them, and the skin where control
// points are recorded.
json bodyData(const motion::Repertoire& repertoire) {
    const motion::ActionSegment& straight =
        repertoire.segments.at(static_cast<std::size_t>(motion::Action::Glide));
    // The glide is the straight fish. All kinds from FrontMuscle on are muscles.
    const bool hasSkin = !straight.controlPoints.empty();
    json springs = json::array();
    json muscles = json::array();
    for (const capture::Unit& unit : capture::anatomy().units)
        (unit.kind >= capture::UnitKind::FrontMuscle ? muscles : springs)
            .push_back({unit.first, unit.second});
    return {{"nodes", listOf(capture::poseAt(straight, 0))},
            {"springs", springs},
            {"muscles", muscles},
            {"skin", hasSkin ? listOf(controlPointsAt(straight, 0)) : json::array()},
            {"faces", hasSkin ? json(body::makeCageTopology().faces) : json::array()}};
}

// See Drift.
json driftData(const motion::ActionSegment& segment, motion::Action action, int repetitions) {
    const Drift drift = driftAfter(segment, isCurve(action) || isTurn(action), repetitions);
    return {{"heading_degrees", degreesOf(drift.headingRadians)},
            {"lean_degrees", degreesOf(drift.leanRadians)},
            {"climb", drift.climb}};
}

// The figures of a segment: some for all segments, some for gaits or turns only.
json measuresData(const motion::ActionSegment& segment, motion::Action action) {
    const capture::SegmentMeasures m = capture::measure(segment);
    const Seam seam = seamOf(segment);
    json data{{"period_seconds", m.periodSeconds},
              {"speed", m.speedBodyLengths},
              {"largest_step", m.largestStep},
              {"seam_at_the_join", seam.atTheJoin},
              {"seam_elsewhere", seam.elsewhere},
              {"drift_after_1", driftData(segment, action, 1)},
              {"drift_after_100", driftData(segment, action, 100)}};
    if (isForward(action))
        data.update(json{{"beat_hertz", 1 / m.periodSeconds},
                         {"stride", m.strideBodyLengths},
                         {"tail", m.tailAmplitude},
                         {"strouhal", m.strouhal},
                         {"nose", m.noseAmplitude},
                         {"wavelength", capture::bodyWave(segment).wavelength}});
    else
        data.update(json{{"turn_degrees", degreesOf(m.turnRadians)},
                         {"turn_rate", degreesOf(m.turnRate)},
                         {"peak_turn_rate", degreesOf(peakTurnRate(segment))},
                         {"radius", turnRadius(segment)}});
    return data;
}

// The midlines of one beat, and half the lateral amplitude of each of their points.
json midlinesData(const motion::ActionSegment& gait) {
    const std::vector<Midline> lines = midlinesOf(gait);
    const Swing swing = swingOf(lines);
    json data = json::array();
    for (const Midline& line : lines)
        data.push_back({{"station", listOf(line.station)}, {"left", listOf(line.left)}});
    return {{"lines", data},
            {"swing", {{"station", listOf(swing.station)}, {"half", listOf(swing.half)}}}};
}

// The segment from above: the body frame at each of kPhases + 1 phases, and the outline of the fish
// at kViews of them.
void addViews(const motion::ActionSegment& segment, json& data) {
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, 1);
    for (const capture::ReplayedPhase& phase : phases)
        data["frames"].push_back(
            {{"origin", pointOf(fromAbove(phase.origin))},
             {"x_axis", pointOf(fromAbove(phase.worldFromBody * glm::dvec3(1, 0, 0)))},
             {"z_axis", pointOf(fromAbove(phase.worldFromBody * glm::dvec3(0, 0, 1)))}});
    for (std::size_t i = 0; i < kViews; ++i) {
        // The last view is phase kPhases, the end of the cycle.
        const std::size_t phase = i * motion::kPhases / (kViews - 1);
        const FishOutline view = viewFromAbove(segment, phases.at(phase), phase);
        json pectorals = json::array();
        for (const auto& fin : view.pectorals) pectorals.push_back(listOf(fin));
        data["views"].push_back({{"phase", phase},
                                 {"outline", listOf(view.outline)},
                                 {"midline", listOf(view.midline)},
                                 {"pectorals", pectorals}});
    }
}

// Writes a file completely or not at all; returns its path. Throws Error.
fs::path written(const std::string& text, fs::path path) {
    writeWhole(path, std::as_bytes(std::span(text)));
    return path;
}

}  // namespace

std::string reportData(const motion::Repertoire& repertoire) {
    const SpeedLine line = fitSpeed(repertoire);
    json data{
        {"species", repertoire.species},
        {"file", fileData(repertoire)},
        {"body", bodyData(repertoire)},
        {"speed_line",
         {{"slope", line.slope}, {"intercept", line.intercept}, {"r_squared", line.rSquared}}}};
    // The glide is derived from the others and has no figures of its own; slopes and the retreat
    // are not seen from above.
    for (std::size_t i = 0; i < motion::kCapturedActions; ++i) {
        const auto action = static_cast<motion::Action>(i);
        if (!isForward(action) && !isCurve(action) && !isTurn(action)) continue;
        const motion::ActionSegment& segment = repertoire.segments.at(i);
        const bool isGait = i < kGaits;
        json one = measuresData(segment, action);
        one["name"] = motion::nameOf(action);
        if (isGait) one["midlines"] = midlinesData(segment);
        addViews(segment, one);
        data["segments"].push_back(one);
    }
    return data.dump() + "\n";
}

fs::path writeReport(const motion::Repertoire& repertoire, const fs::path& folder) {
    return written(reportData(repertoire), folder / (repertoire.species + ".json"));
}

fs::path writeControllers(const config::Species& species, const fs::path& folder) {
    return written(controllersData(species), folder / "controllers.json");
}

namespace {

// The table of text.

// printf into a string, which suits columns of numbers; at most 255 characters.
template <class... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// Zero for what is zero except for rounding, so that no "-0.00" appears.
double cleaned(double value) {
    return std::abs(value) < 1e-5 ? 0 : value;
}

// One row; "-" where a figure has no meaning for the segment.
std::string rowOf(motion::Action action, const motion::ActionSegment& segment) {
    const capture::SegmentMeasures m = capture::measure(segment);
    constexpr double kStraight = 1e-4;  // radians
    const bool mayTurn = isCurve(action) || isPivot(action) || isTurn(action) || isStart(action);
    const bool turns = mayTurn && std::abs(m.turnRadians) > kStraight;
    std::string row = line("  %-24s %8.4f %8.3f %8.3f",
                           motion::nameOf(action),
                           m.periodSeconds,
                           m.speedBodyLengths,
                           m.strideBodyLengths);
    // The amplitude is measured across a straight course, so a turn has none.
    row += turns ? line(" %7.1f %8.1f %8.2f",
                        m.turnRadians / kRadiansPerDegree<double>,
                        m.turnRate / kRadiansPerDegree<double>,
                        turnRadius(segment))
                 : line(" %7s %8s %8s", "-", "-", "-");
    row += isForward(action) ? line(" %8.3f %8.3f", m.tailAmplitude, m.strouhal)
                             : line(" %8s %8s", "-", "-");
    row += line(" %9.4f %9.1e %9.1e\n",
                m.largestStep,
                cleaned(m.leanRadians / kRadiansPerDegree<double>),
                cleaned(m.climb));
    return row;
}

}  // namespace

// Two bytes, little-endian, after the five bytes "AQREP".
int formatVersionOf(std::span<const std::byte> intactRepertoire) {
    assert(intactRepertoire.size() > 6);
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
    // Drag is 1 / body length, the rate of the brake 1 / s: see motion::SpeedResponse.
    const auto& [swim, retreat, glide, brake] = repertoire.response;
    text += line(
        "speed response: drag %.3f, %.3f, %.3f swimming, %.3f retreating, %.3f gliding, per BL;"
        " brake %.3f per s\n\n",
        static_cast<double>(swim[0]),
        static_cast<double>(swim[1]),
        static_cast<double>(swim[2]),
        static_cast<double>(retreat),
        static_cast<double>(glide),
        static_cast<double>(brake));
    text +=
        "                             period    speed   stride    turn     turn   radius     tail "
        "Strouhal   largest      lean     climb\n"
        "  segment                         s     BL/s       BL     deg    deg/s       BL   p-p BL  "
        " "
        "number   BL/tick deg/cycle  BL/cycle\n";
    for (int i = 0; i < motion::kCapturedActions; ++i)
        text += rowOf(static_cast<motion::Action>(i),
                      repertoire.segments.at(static_cast<std::size_t>(i)));
    return text;
}

}  // namespace aquarama::report
