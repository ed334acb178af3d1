// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <sstream>

#include "master/study/study_report.h"

namespace aquarama::study {

std::string studyCsv(const StudyPlan& plan, const std::vector<Sample>& samples) {
    std::ostringstream csv;
    csv << "scenario,condition,seed";
    for (std::size_t i = 0; i < kQuantities; ++i)
        csv << ',' << infoOf(static_cast<Quantity>(i)).key;
    csv << '\n';
    for (std::size_t scenario = 0; scenario < samples.size(); ++scenario)
        for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
            for (std::size_t seed = 0; seed < plan.seeds; ++seed) {
                csv << plan.scenarios[scenario].name << ',' << kConditions.at(condition).name << ','
                    << seed + 1;
                for (const double value : samples[scenario].at(condition)[seed]) {
                    csv << ',';
                    if (!std::isnan(value)) csv << value;
                }
                csv << '\n';
            }
    return csv.str();
}

}  // namespace aquarama::study
