// SPDX-License-Identifier: Apache-2.0
#include "capture/report/forms.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "capture/measure.h"
#include "capture/report/report_data.h"
#include "capture/report/segment_figures.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

using nlohmann::json;

// Bounds of the forms.

// The least published swing of a fish that swims with its tail is 0.106 L (largemouth bass at 0.7
// L/s, Jayne & Lauder 1995: half of it is 0.053). A body is still at less than half of that, and
// the tail drives at more.
constexpr double kStillTail = 0.053;
// The tip of a rowing fin of 0.2 to 0.25 L goes through 0.35 to 0.4 L (surfperch, Drucker & Jensen
// 1996), which is a stroke of 90 degrees or more. Fins row at more than half of that, and are still
// at less than a tenth.
constexpr double kRowingStroke = 45 * kRadiansPerDegree<double>;
constexpr double kStillStroke = 9 * kRadiansPerDegree<double>;
// Half as far as its tail swings the last quarter of a saithe (from the envelope of Videler & Hess
// 1984). A body is stiff if that is less than a fifth; means of slow and fast swimming.
constexpr double kStiffShare = 0.2;
// The snout of a bass swings by at most 0.024 L, and it swings least 0.25 L behind it (Jayne &
// Lauder 1995). If it swung there by half as much and the other way, its head would yaw by 8
// degrees: an upper estimate, ours. A head is steady below it; means as above.
constexpr double kSteadyHead = 8 * kRadiansPerDegree<double>;
// Waves are 0.9 to 1.1 L long on carangiform swimmers (Videler & Hess 1984), 0.5 to 0.7 L on eels.
constexpr double kLeastWavelength = 0.8;

// Harmonics.

constexpr double kTurn = 2 * std::numbers::pi;
// Below it nothing beats: some ten units in which poses are stored.
constexpr double kLeastSwing = 3e-4;

// The n-th harmonic of one cycle: amplitude, peak to peak, and phase.
std::complex<double> harmonicOf(std::span<const double> cycle, int n) {
    std::complex<double> sum;
    const auto count = static_cast<double>(cycle.size());
    for (std::size_t k = 0; k < cycle.size(); ++k)
        sum += cycle[k] * std::polar(4 / count, -kTurn * n * static_cast<double>(k) / count);
    return sum;
}

// How often a cycle beats: its greatest harmonic of the first four; 0 where it is still.
int beatsOf(std::span<const double> cycle) {
    int beats = 0;
    double most = kLeastSwing;
    for (int n = 1; n <= 4; ++n) {
        const double swing = std::abs(harmonicOf(cycle, n));
        if (swing <= most) continue;
        most = swing;
        beats = n;
    }
    return beats;
}

double peakToPeak(std::span<const double> cycle) {
    const auto [least, most] = std::ranges::minmax(cycle);
    return most - least;
}

// The body.

// Of the line from ring 1 to the nose, against +x, at each phase; radians, left positive.
std::vector<double> headDirections(const motion::ActionSegment& gait) {
    std::vector<double> angles;
    for (const capture::ReplayedPhase& phase : capture::replayAlongX(gait, 1)) {
        const auto& nodes = phase.nodes;
        const glm::dvec3 ahead = nodes[0] - (nodes[1] + nodes[2] + nodes[3] + nodes[4]) / 4.0;
        angles.push_back(std::atan2(-ahead.z, ahead.x));
    }
    return angles;
}

// The share of the length behind the last point that swings at most half as far as the tail.
double swingingShare(const Swing& swing) {
    const std::size_t tail = swing.half.size() - 1;
    const double half = swing.half[tail] / 2;
    std::size_t j = tail;
    while (j > 0 && swing.half[j - 1] > half) --j;
    if (j == 0) return 1;
    const double share = (half - swing.half[j - 1]) / (swing.half[j] - swing.half[j - 1]);
    const double from = std::lerp(swing.station[j - 1], swing.station[j], share);
    return 1 - from / swing.station[tail];
}

void measureBody(const motion::ActionSegment& gait, FormFigures& figures) {
    const std::vector<Midline> lines = midlinesOf(gait);
    const Swing swing = swingOf(lines);
    std::vector<double> tail;
    for (const Midline& line : lines) tail.push_back(line.left.back());
    figures.tail = 2 * swing.half.back();
    figures.head = 2 * swing.half.front();
    const auto least = std::ranges::min_element(swing.half);
    figures.least = 2 * *least;
    const auto at = static_cast<std::size_t>(least - swing.half.begin());
    figures.leastAt = swing.station[at] / swing.station.back();
    figures.headYaw = peakToPeak(headDirections(gait));
    const int beats = beatsOf(tail);
    if (beats == 0) return;
    figures.tailHertz = beats / static_cast<double>(gait.periodSeconds);
    figures.swinging = swingingShare(swing);
    figures.wavelength = capture::bodyWave(gait).wavelength;
}

// The fins.

// The stroke of a fin at each phase, radians; `side` is 0 left, 1 right.
std::vector<double> strokesOf(const motion::ActionSegment& gait, std::size_t side) {
    std::vector<double> strokes;
    for (const motion::FinAnglePair& fins : gait.fins)
        strokes.push_back(static_cast<double>(motion::kFinUnit) * fins.at(side)[1]);
    return strokes;
}

void measureFins(const motion::ActionSegment& gait, FormFigures& figures) {
    const std::vector<double> left = strokesOf(gait, 0);
    const std::vector<double> right = strokesOf(gait, 1);
    figures.finStroke = (peakToPeak(left) + peakToPeak(right)) / 2;
    const int beats = beatsOf(right);
    if (beats == 0 || beatsOf(left) != beats) return;
    figures.finHertz = beats / static_cast<double>(gait.periodSeconds);
    figures.finsApart = std::abs(std::arg(harmonicOf(left, beats) / harmonicOf(right, beats)));
}

}  // namespace

FormFigures formFigures(const motion::ActionSegment& gait) {
    FormFigures figures;
    figures.speed = capture::measure(gait).speedBodyLengths;
    assert(figures.speed > 0);
    measureBody(gait, figures);
    measureFins(gait, figures);
    const double hertz = figures.tailHertz > 0 ? figures.tailHertz : figures.finHertz;
    if (hertz > 0) figures.stride = figures.speed / hertz;
    figures.strouhal = figures.tailHertz * figures.tail / figures.speed;
    return figures;
}

bool isRowed(const FormFigures& gait) {
    return gait.tail < kStillTail && gait.finHertz > 0 && gait.finStroke > kRowingStroke;
}

bool beatsTail(const FormFigures& gait) {
    return gait.tailHertz > 0 && gait.tail > kStillTail && gait.finStroke < kStillStroke;
}

const char* nameOf(SwimmingForm form) {
    constexpr std::array kNames{"labriform", "stiff body", "carangiform", "yawing head"};
    return kNames.at(static_cast<std::size_t>(form));
}

std::optional<SwimmingForm> formOf(const FormFigures& slow, const FormFigures& fast) {
    if (!beatsTail(fast)) return std::nullopt;
    if (isRowed(slow)) return SwimmingForm::Labriform;
    if (!beatsTail(slow)) return std::nullopt;
    if (std::min(slow.wavelength, fast.wavelength) < kLeastWavelength) return std::nullopt;
    if (slow.swinging + fast.swinging < 2 * kStiffShare) return SwimmingForm::StiffBodied;
    return slow.headYaw + fast.headYaw < 2 * kSteadyHead ? SwimmingForm::Carangiform
                                                         : SwimmingForm::HeadYawing;
}

namespace {

// The data of the sheet.

json figuresData(const FormFigures& figures) {
    return {{"speed", figures.speed},
            {"tail_hertz", figures.tailHertz},
            {"stride", figures.stride},
            {"tail", figures.tail},
            {"head", figures.head},
            {"least", figures.least},
            {"least_at", figures.leastAt},
            {"swinging", figures.swinging},
            {"head_yaw_degrees", figures.headYaw / kRadiansPerDegree<double>},
            {"wavelength", figures.wavelength},
            {"strouhal", figures.strouhal},
            {"fin_hertz", figures.finHertz},
            {"fin_stroke_degrees", figures.finStroke / kRadiansPerDegree<double>},
            {"fins_apart_degrees", figures.finsApart / kRadiansPerDegree<double>}};
}

json gaitData(const motion::ActionSegment& gait) {
    const std::vector<Midline> lines = midlinesOf(gait);
    const Swing swing = swingOf(lines);
    json data{{"period_seconds", gait.periodSeconds},
              {"figures", figuresData(formFigures(gait))},
              {"swing", {{"station", listOf(swing.station)}, {"half", listOf(swing.half)}}}};
    for (const Midline& line : lines)
        data["midlines"].push_back(
            {{"station", listOf(line.station)}, {"left", listOf(line.left)}});
    for (std::size_t side = 0; side < 2; ++side) {
        std::vector<double> strokes = strokesOf(gait, side);
        for (double& stroke : strokes) stroke /= kRadiansPerDegree<double>;
        data["strokes_degrees"].push_back(listOf(strokes));
    }
    return data;
}

}  // namespace

std::string formsData(const std::vector<motion::Repertoire>& repertoires) {
    json data = json::array();
    for (const motion::Repertoire& repertoire : repertoires) {
        const auto gait = [&](motion::Action action) -> const motion::ActionSegment& {
            return repertoire.segments.at(motion::indexOf(action));
        };
        const motion::ActionSegment& slow = gait(motion::Action::ForwardSlow);
        const motion::ActionSegment& fast = gait(motion::Action::ForwardFast);
        const std::optional<SwimmingForm> form = formOf(formFigures(slow), formFigures(fast));
        data.push_back({{"species", repertoire.species},
                        {"form", form ? nameOf(*form) : "none of these"},
                        {"slow", gaitData(slow)},
                        {"fast", gaitData(fast)}});
    }
    return data.dump() + "\n";
}

}  // namespace aquarama::report
