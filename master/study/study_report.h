// SPDX-License-Identifier: Apache-2.0
// What the study writes.
#pragma once

#include <string>
#include <vector>

#include "master/study/study.h"

namespace aquarama::study {

// The tables of docs/appendices/adaptation.md: for each scenario a row a quantity and a column a
// condition.
[[nodiscard]] std::string studyMarkdown(const StudyPlan& plan, const std::vector<Sample>& samples);

// A line for each scenario, condition and seed.
[[nodiscard]] std::string studyCsv(const StudyPlan& plan, const std::vector<Sample>& samples);

// With and without each adaptation, a dot for each seed.
[[nodiscard]] std::string drawStudy(const StudyPlan& plan, const std::vector<Sample>& samples);

}  // namespace aquarama::study
