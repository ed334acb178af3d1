// SPDX-License-Identifier: Apache-2.0
// Table 1 of the paper, of this run: what a fish costs by dynamics and by replay.
#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace aquarama::bench {

struct Table1Row {
    std::string name;  // "table1/..."
    std::string what;
    double nanoseconds = 0;        // per fish and step of 1/60 s
    double paperMilliseconds = 0;  // 0 where the paper has no figure
};

// Medians over repetitions. Empty when the run left out a benchmark that the table needs.
[[nodiscard]] std::vector<Table1Row> table1(
    const std::vector<benchmark::BenchmarkReporter::Run>& runs);

void print(const std::vector<Table1Row>& table);

}  // namespace aquarama::bench
