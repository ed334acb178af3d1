// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "master/capture/report/plot.h"
#include "master/study/statistics.h"
#include "master/study/study_report.h"

namespace aquarama::study {

namespace {

// One adaptation and what it is there for.
struct Panel {
    const char* adaptation;
    std::size_t without;  // of kConditions
    const char* scenario;
    Quantity quantity;
};
constexpr std::array kPanels{
    Panel{"recommendations", 1, "school", Quantity::SameSegment},
    Panel{"recommendations", 1, "school", Quantity::InStep},
    Panel{"enlarged regions", 2, "crowded tank", Quantity::Touches},
    Panel{"enlarged regions", 2, "reef", Quantity::Touches},
    Panel{"earlier pursuit", 3, "feeding", Quantity::PinchSeconds},
    Panel{"earlier pursuit", 3, "feeding", Quantity::MealsPerTry},
};

constexpr double kPanelWidth = 190, kPanelHeight = 210;
constexpr double kMargin = 56, kTop = 58;
constexpr int kColumns = 3;

const std::string kWithout = "#b4472f", kWith = "#1f6f8b";

double niceTick(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    const double lead = most / power;
    return power * (lead > 5 ? 2 : lead > 2 ? 1 : 0.5);
}

report::Axis valueAxis(const std::vector<Figures>& a,
                       const std::vector<Figures>& b,
                       Quantity quantity) {
    double most = 1e-6;
    for (const auto* runs : {&a, &b})
        for (const Figures& run : *runs)
            if (const double value = run.at(static_cast<std::size_t>(quantity)); !std::isnan(value))
                most = std::max(most, value);
    const double tick = niceTick(most);
    return {.least = 0,
            .most = tick * std::ceil(1.05 * most / tick),
            .tick = tick,
            .digits = std::max(0, static_cast<int>(std::ceil(-std::log10(tick)))),
            .label = ""};
}

// Each seed a thin line from without to with, and the means.
void drawSeeds(report::Svg& svg,
               const report::Plot& plot,
               const std::vector<Figures>& without,
               const std::vector<Figures>& with,
               Quantity quantity) {
    const auto value = [&](const Figures& run) {
        return run.at(static_cast<std::size_t>(quantity));
    };
    for (std::size_t seed = 0; seed < with.size(); ++seed) {
        if (std::isnan(value(with[seed])) || std::isnan(value(without[seed]))) continue;
        const glm::dvec2 from = plot.at(1, value(without[seed]));
        const glm::dvec2 to = plot.at(2, value(with[seed]));
        svg.line(from, to, R"(stroke="#c3cdd4" stroke-width="1")");
        svg.circle(from, 3, "fill=\"" + kWithout + "\" fill-opacity=\"0.6\"");
        svg.circle(to, 3, "fill=\"" + kWith + "\" fill-opacity=\"0.6\"");
    }
    const auto mean = [&](double x, const std::vector<Figures>& runs, const std::string& colour) {
        const double at = estimateOf(runs, quantity).mean;
        svg.line(plot.at(x - 0.25, at), plot.at(x + 0.25, at), report::stroke(colour, 2.5));
    };
    mean(1, without, kWithout);
    mean(2, with, kWith);
}

void drawPanel(report::Svg& svg, const Panel& panel, const Sample& sample, glm::dvec2 corner) {
    const auto& without = sample.at(panel.without);
    const auto& with = sample.front();
    report::Axis x{.least = 0.4, .most = 2.6, .tick = 10, .digits = 0, .label = ""};
    const report::Plot plot(
        corner, {kPanelWidth, kPanelHeight}, x, valueAxis(without, with, panel.quantity));
    plot.drawAxes(svg);
    drawSeeds(svg, plot, without, with, panel.quantity);
    svg.text(plot.at(1, 0) + glm::dvec2{0, 16}, "without", report::letters(11, "middle"));
    svg.text(plot.at(2, 0) + glm::dvec2{0, 16}, "with", report::letters(11, "middle"));
    svg.text(corner + glm::dvec2{0, -26},
             std::string(panel.adaptation) + ", " + panel.scenario,
             report::letters(12));
    svg.text(corner + glm::dvec2{0, -11},
             infoOf(panel.quantity).words,
             report::letters(10, "start", report::kQuietInk));
}

}  // namespace

std::string drawStudy(const StudyPlan& plan, const std::vector<Sample>& samples) {
    const double across = kPanelWidth + 2 * kMargin;
    const double down = kPanelHeight + kTop + 36;
    report::Svg svg(kColumns * across, down * 2);
    int place = 0;
    for (const Panel& panel : kPanels) {
        const auto scenario = std::ranges::find(plan.scenarios, panel.scenario, &Scenario::name);
        if (scenario == plan.scenarios.end()) continue;
        const auto index = static_cast<std::size_t>(scenario - plan.scenarios.begin());
        const glm::dvec2 cell{place % kColumns * across, place / kColumns * down};
        drawPanel(svg, panel, samples[index], cell + glm::dvec2{kMargin, kTop});
        ++place;
    }
    return std::move(svg).finish();
}

}  // namespace aquarama::study
