// SPDX-License-Identifier: Apache-2.0
// Runs the benchmarks, writes them as CSV beside the machine's name, and prints the paper's
// Table 1.
//
//     aquarama_bench [--against FILE] [Google Benchmark's arguments]
//
// With --against it prints the figures beside those of an earlier run on the same machine.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "common/base/log.h"
#include "tests/bench/against.h"
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

// Takes "--against FILE" out of the arguments; empty: it is not there. Nothing where the file is
// missing.
std::optional<std::string> takeAgainst(int& count, char** arguments) {
    char** const end = arguments + count;
    char** const found = std::find_if(
        arguments, end, [](const char* one) { return std::string(one) == "--against"; });
    if (found == end) return "";
    if (found + 1 == end) return std::nullopt;
    std::string path = found[1];
    std::copy(found + 2, end, found);
    count -= 2;
    return path;
}

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

// The earlier run is read first: it may be the file that is written.
void measure(const std::string& against) {
    using namespace aquarama::bench;  // NOLINT(google-build-using-namespace)
    const std::string machine = processorName();
    Measurements before;
    if (!against.empty()) before = readMeasurements(against, machine);
    KeepingReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    const std::vector<Table1Row> table = table1(reporter.kept());
    const std::string path = "build/bench/" + fileNameOf(machine) + ".csv";
    writeCsv(reporter.kept(), table, path);
    print(table);
    if (!against.empty()) print(compare(before, readMeasurements(path, machine)), std::cout);
}

}  // namespace

int main(int count, char** arguments) {
    const auto against = takeAgainst(count, arguments);
    benchmark::Initialize(&count, arguments);
    if (!against || benchmark::ReportUnrecognizedArguments(count, arguments)) {
        if (!against) std::cerr << "aquarama_bench: --against needs a file of measurements\n";
        return 1;
    }
    try {
        measure(*against);
    } catch (const aquarama::Error& error) {
        std::cerr << "aquarama_bench: " << error.what() << '\n';
        return 1;
    }
    benchmark::Shutdown();
    return 0;
}
