// SPDX-License-Identifier: Apache-2.0
// Runs the benchmarks, writes them as CSV beside the machine's name, and prints the paper's
// Table 1.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "tests/bench/machine.h"
#include "tests/bench/table1.h"

namespace {

// The most that this program has held at any time so far.
double peakMemoryMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Another word in Google Benchmark 1.9 (Debian 13) than in 1.7 (Debian 12).
template <class Run>
bool failed(const Run& run) {
    if constexpr (requires { run.error_occurred; })
        return run.error_occurred;
    else
        return run.skipped != 0;
}

// Prints to the console as usual and keeps every figure.
class KeepingReporter : public benchmark::ConsoleReporter {
  public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (failed(run)) continue;
            kept_.push_back(run);
            kept_.back().counters["peak_memory_mib"] = peakMemoryMib();
        }
        ConsoleReporter::ReportRuns(runs);
    }
    [[nodiscard]] const std::vector<Run>& kept() const { return kept_; }

  private:
    std::vector<Run> kept_;
};

void writeCsv(const std::vector<benchmark::BenchmarkReporter::Run>& runs,
              const std::vector<aquarama::bench::Table1Row>& table,
              const std::string& path) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream csv(path);
    aquarama::bench::CsvWriter rows(csv, aquarama::bench::processorName());
    for (const auto& run : runs) {
        const double nanoseconds =
            run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
        rows.time(run.benchmark_name(), nanoseconds);
        for (const auto& [name, counter] : run.counters)
            rows.counter(run.benchmark_name(), name, counter.value);
    }
    for (const auto& row : table) rows.time(row.name, row.nanoseconds);
    std::printf("\nwritten: %s\n", path.c_str());
}

}  // namespace

int main(int count, char** arguments) {
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 1;
    KeepingReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    benchmark::Shutdown();
    const std::vector<aquarama::bench::Table1Row> table = aquarama::bench::table1(reporter.kept());
    writeCsv(
        reporter.kept(),
        table,
        "build/bench/" + aquarama::bench::fileNameOf(aquarama::bench::processorName()) + ".csv");
    aquarama::bench::print(table);
    return 0;
}
