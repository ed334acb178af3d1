// SPDX-License-Identifier: Apache-2.0
// The figures of this run beside those of an earlier one on the same machine.
#pragma once

#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace aquarama::bench {

// Of each repetition, by "BENCHMARK" for its time in nanoseconds, and "BENCHMARK COUNTER".
using Measurements = std::map<std::string, std::vector<double>>;

// A file that CsvWriter wrote. Means and the like over repetitions are left out. Throws Error where
// it cannot be read, or is of another machine.
[[nodiscard]] Measurements readMeasurements(const std::string& path, const std::string& machine);

// One figure of both.
struct Compared {
    std::string name;
    double before = 0, now = 0;  // medians
    // How far the ratio may be off by chance, as a share of it: half the spread of the repetitions,
    // of both runs. Nothing where a run has only one.
    std::optional<double> noise;
};

// What both have, in the order of the names. Figures that are always zero or the same are left out.
[[nodiscard]] std::vector<Compared> compare(const Measurements& before, const Measurements& now);

void print(const std::vector<Compared>& compared, std::ostream& out);

}  // namespace aquarama::bench
