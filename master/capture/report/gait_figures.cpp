// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/gait_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "master/capture/measure/measure.h"
#include "master/capture/report/midlines.h"
#include "master/capture/report/plot.h"

namespace aquarama::report {

namespace {

constexpr double kSpread = 0.15;  // of the midlines' picture to either side, body lengths

// Of dace, trout and goldfish (Bainbridge 1958): the frequency and the body lengths a second.
double bainbridge(double hertz) {
    return (3 * hertz - 4) / 4;
}

// Half the swing of a swimming saithe's midline (Videler & Hess 1984).
double saitheHalfSwing(double s) {
    return 0.02 - 0.0825 * s + 0.1625 * s * s;
}

struct Line {
    double slope = 0, intercept = 0;
};

Line leastSquares(const std::vector<glm::dvec2>& points) {
    const auto n = static_cast<double>(points.size());
    glm::dvec2 mean{};
    for (const glm::dvec2& point : points) mean += point / n;
    double xy = 0;
    double xx = 0;
    for (const glm::dvec2& point : points) {
        xy += (point.x - mean.x) * (point.y - mean.y);
        xx += (point.x - mean.x) * (point.x - mean.x);
    }
    return {xy / xx, mean.y - xy / xx * mean.x};
}

// Beat and speed of the three gaits.
std::vector<glm::dvec2> speedsOf(const motion::Repertoire& repertoire) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < kGaits; ++i) {
        const capture::SegmentMeasures m = capture::measure(repertoire.segments.at(i));
        points.emplace_back(1 / m.periodSeconds, m.speedBodyLengths);
    }
    return points;
}

// From zero, by steps that people count in.
Axis axisUpTo(double most, const char* label) {
    const double magnitude = std::pow(10, std::floor(std::log10(most)));
    const double tick = most / magnitude < 2   ? 0.25 * magnitude
                        : most / magnitude < 5 ? 0.5 * magnitude
                                               : magnitude;
    const int digits = tick >= 1 ? 0 : tick >= 0.1 && std::fmod(tick * 10, 1) < 1e-9 ? 1 : 2;
    return {0, std::ceil(most * 1.12 / tick) * tick, tick, digits, label};
}

std::string signedTerm(double value, int digits) {
    return (value < 0 ? " &#8722; " : " + ") + fixed(std::abs(value), digits);
}

}  // namespace

SpeedLine fitSpeed(const motion::Repertoire& repertoire) {
    const std::vector<glm::dvec2> points = speedsOf(repertoire);
    const auto [slope, intercept] = leastSquares(points);
    double mean = 0;
    for (const glm::dvec2& point : points) mean += point.y / kGaits;
    double left = 0;
    double all = 0;
    for (const glm::dvec2& point : points) {
        left += std::pow(point.y - slope * point.x - intercept, 2);
        all += std::pow(point.y - mean, 2);
    }
    return {slope, intercept, 1 - left / all};
}

std::string drawSpeed(const motion::Repertoire& repertoire) {
    const std::vector<glm::dvec2> points = speedsOf(repertoire);
    const SpeedLine line = fitSpeed(repertoire);
    const Axis x = axisUpTo(points.back().x, "tail beat, Hz");
    const Axis y = axisUpTo(points.back().y, "speed, BL/s");
    const double xMost = x.most;
    const double yMost = y.most;
    Svg svg(540, 380);
    const Plot plot({58, 14}, {460, 314}, x, y);
    plot.drawAxes(svg);
    const auto drawLine = [&](double slope, double intercept, double from, const SvgStyle& style) {
        const double start = std::max(from, -intercept / slope);  // not below speed zero
        const double end = std::min(xMost, (yMost - intercept) / slope);
        if (start < end)
            svg.line(plot.at(start, slope * start + intercept),
                     plot.at(end, slope * end + intercept),
                     style);
    };
    drawLine(bainbridge(1) - bainbridge(0), bainbridge(0), 0, kPublishedStyle);
    drawLine(line.slope, line.intercept, 0, stroke(kQuietInk, 1.6));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 at = plot.at(points[i].x, points[i].y);
        svg.circle(at, 6, std::string("fill=\"") + colourOf(i) + "\"");
        svg.text(at + glm::dvec2(10, 17), std::vector{"slow", "medium", "fast"}[i], letters(12));
    }
    drawLegend(svg,
               {72, 34},
               {{stroke(kQuietInk, 1.6),
                 "speed = " + fixed(line.slope, 2) + " f" + signedTerm(line.intercept, 2) +
                     ",  R&#178; = " + fixed(line.rSquared, 3)},
                {kPublishedStyle, "dace, trout, goldfish: (3 f &#8722; 4) / 4 (Bainbridge 1958)"}});
    return std::move(svg).finish();
}

namespace {

struct Band {
    std::string label;
    double (*of)(const capture::SegmentMeasures&);
    double least, most;  // of living fish
    std::string source;
};

void drawBand(Svg& svg, glm::dvec2 corner, const motion::Repertoire& repertoire, const Band& band) {
    constexpr double kMost = 0.8;
    const Axis x = axisUpTo(speedsOf(repertoire).back().x, "tail beat, Hz");
    const double xMost = x.most;
    const Plot plot(corner, {380, 132}, x, {0, kMost, 0.2, 1, band.label});
    svg.rectangle(plot.at(0, band.most),
                  plot.at(xMost, band.least) - plot.at(0, band.most),
                  "fill=\"#fbeedd\"");
    plot.drawAxes(svg);
    svg.text(plot.at(0, kMost) + glm::dvec2(8, 14), band.source, letters(11, "start", kAmber));
    for (std::size_t i = 0; i < kGaits; ++i) {
        const capture::SegmentMeasures m = capture::measure(repertoire.segments.at(i));
        const glm::dvec2 at = plot.at(1 / m.periodSeconds, band.of(m));
        svg.circle(at, 6, std::string("fill=\"") + colourOf(i) + "\"");
        svg.text(at + glm::dvec2(0, 20), fixed(band.of(m), 2), letters(11, "middle"));
    }
}

}  // namespace

std::string drawStrouhalAndStride(const motion::Repertoire& repertoire) {
    Svg svg(460, 380);
    drawBand(svg,
             {58, 14},
             repertoire,
             {"Strouhal number",
              [](const capture::SegmentMeasures& m) { return m.strouhal; },
              0.2,
              0.4,
              "0.2 to 0.4: Taylor, Nudds &amp; Thomas 2003"});
    drawBand(svg,
             {58, 196},
             repertoire,
             {"stride, BL",
              [](const capture::SegmentMeasures& m) { return m.strideBodyLengths; },
              0.5,
              0.7,
              "0.5 to 0.7: Videler &amp; Wardle 1991"});
    return std::move(svg).finish();
}

std::string drawMidlines(const motion::Repertoire& repertoire, motion::Action gait) {
    constexpr std::size_t kEvery = 4;  // sixteen of the phases
    constexpr double kScale = 300;
    const auto action = static_cast<std::size_t>(gait);
    Svg svg(370, 150);
    const Plot plot({54, 10},
                    {kScale, 2 * kSpread * kScale},
                    {0, 1, 0.2, 1, "distance from the nose, BL"},
                    {-kSpread, kSpread, 0.1, 1, "to the left, BL"});
    plot.drawAxes(svg);
    const std::vector<Midline> lines = midlinesOf(repertoire.segments.at(action));
    for (std::size_t k = 0; k < lines.size(); k += kEvery) {
        std::vector<glm::dvec2> points;
        for (std::size_t j = 0; j < lines[k].station.size(); ++j)
            points.emplace_back(lines[k].station[j], lines[k].left[j]);
        // From dark to light through the beat, so that the wave's way can be seen.
        const auto lightness = 22 + 50 * k / lines.size();
        svg.polyline(plot.at(points),
                     stroke("hsl(207,45%," + std::to_string(lightness) + "%)", 1.1));
    }
    const Swing swing = swingOf(lines);
    for (const double side : {-1.0, 1.0}) {
        std::vector<glm::dvec2> own;
        std::vector<glm::dvec2> published;
        for (std::size_t j = 0; j < swing.station.size(); ++j)
            own.emplace_back(swing.station[j], side * swing.half[j]);
        for (int i = 0; i <= 40; ++i)
            published.emplace_back(i / 40.0, side * saitheHalfSwing(i / 40.0));
        svg.polyline(plot.at(own), stroke(colourOf(action), 2.2));
        svg.polyline(plot.at(published), kPublishedStyle);
    }
    return std::move(svg).finish();
}

}  // namespace aquarama::report
