// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "master/capture/report/svg.h"
#include "master/study/statistics.h"
#include "master/study/study_report.h"

namespace aquarama::study {

namespace {

// In bold where it clearly differs from that with all adaptations.
std::string cellOf(const Sample& sample, std::size_t condition, Quantity quantity) {
    const Estimate estimate = estimateOf(sample.at(condition), quantity);
    if (estimate.seeds == 0) return "–";
    const int digits = infoOf(quantity).digits;
    const std::string words = report::fixed(estimate.mean, digits) + " ± " +
                              report::fixed(estimate.standardError, digits);
    const bool differs =
        condition > 0 && isClear(differenceOf(sample.at(condition), sample.front(), quantity));
    return differs ? "**" + words + "**" : words;
}

bool isThere(const Sample& sample, Quantity quantity) {
    return std::ranges::any_of(sample, [&](const std::vector<Figures>& runs) {
        return estimateOf(runs, quantity).seeds > 0;
    });
}

std::string tableOf(const Sample& sample) {
    std::string table = "| |";
    std::string rule = "|---|";
    for (const Condition& condition : kConditions) {
        table += " " + std::string(condition.name) + " |";
        rule += "---|";
    }
    table += " published |\n" + rule + "---|\n";
    for (std::size_t i = 0; i < kQuantities; ++i) {
        const auto quantity = static_cast<Quantity>(i);
        if (!isThere(sample, quantity)) continue;
        table += "| " + std::string(infoOf(quantity).words) + " |";
        for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
            table += " " + cellOf(sample, condition, quantity) + " |";
        table += " " + std::string(infoOf(quantity).published) + " |\n";
    }
    return table;
}

}  // namespace

std::string studyMarkdown(const StudyPlan& plan, const std::vector<Sample>& samples) {
    std::string page;
    for (std::size_t i = 0; i < plan.scenarios.size(); ++i) {
        const Scenario& scenario = plan.scenarios[i];
        page += "### " + scenario.name + "\n\n" + tableOf(samples[i]) + "\n";
    }
    return page;
}

}  // namespace aquarama::study
