// SPDX-License-Identifier: Apache-2.0
// Runs the benchmarks, writes them as CSV beside the machine's name, and prints the factor of the
// paper's Table 1.
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <sys/utsname.h>

namespace {

std::string processorName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    utsname machine{};
    uname(&machine);
    return machine.machine;
}

// "Intel(R) Xeon(R) Processor" as a name for a file: intel-r-xeon-r-processor.
std::string fileNameOf(const std::string& machine) {
    std::string name;
    for (const char letter : machine) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        if (plain) name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        if (!plain && !name.empty() && name.back() != '-') name += '-';
    }
    return name;
}

// The most that this program has held at any time so far.
double peakMemoryMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Prints to the console as usual and keeps every figure.
class KeepingReporter : public benchmark::ConsoleReporter {
  public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.error_occurred) continue;
            kept_.push_back(run);
            kept_.back().counters["peak_memory_mib"] = peakMemoryMib();
        }
        ConsoleReporter::ReportRuns(runs);
    }
    [[nodiscard]] const std::vector<Run>& kept() const { return kept_; }

  private:
    std::vector<Run> kept_;
};

void writeCsv(const std::vector<benchmark::BenchmarkReporter::Run>& runs, const std::string& path) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream csv(path);
    csv << "machine,benchmark,cpu_ns,counter,value\n";
    const std::string machine = processorName();
    for (const auto& run : runs) {
        const double nanoseconds =
            run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
        csv << '"' << machine << "\"," << run.benchmark_name() << ',' << nanoseconds << ",,\n";
        for (const auto& [name, counter] : run.counters) {
            csv << '"' << machine << "\"," << run.benchmark_name() << ",," << name << ','
                << counter.value << '\n';
        }
    }
    std::printf("\nwritten: %s\n", path.c_str());
}

// ns a fish of the first run whose name starts so; its counter "ns_per_fish", or its time where it
// has none.
double nanosecondsPerFish(const std::vector<benchmark::BenchmarkReporter::Run>& runs,
                          const std::string& start) {
    for (const auto& run : runs) {
        if (!run.benchmark_name().starts_with(start)) continue;
        const auto counter = run.counters.find("ns_per_fish");
        if (counter != run.counters.end()) return counter->second.value;
        return run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
    }
    return 0.0;
}

void printFactor(const std::vector<benchmark::BenchmarkReporter::Run>& runs) {
    const double step = nanosecondsPerFish(runs, "dynamics_step");
    const double frame = nanosecondsPerFish(runs, "dynamics_tick");
    const double replay = nanosecondsPerFish(runs, "body_frame/fish:1000/") +
                          nanosecondsPerFish(runs, "nodal_points/fish:1000/");
    if (step == 0.0 || frame == 0.0 || replay == 0.0) return;
    std::printf(
        "dynamics to replay (body frame and 23 nodal points of a fish, %.1f ns); the paper has "
        "4000:\n",
        replay);
    std::printf("  per frame of 1/60 s: %.0f (dynamics %.1f us)\n", frame / replay, frame / 1e3);
    std::printf("  per step of the dynamics: %.0f (dynamics %.1f us)\n", step / replay, step / 1e3);
}

}  // namespace

int main(int count, char** arguments) {
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 1;
    KeepingReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    benchmark::Shutdown();
    writeCsv(reporter.kept(), "build/bench/" + fileNameOf(processorName()) + ".csv");
    printFactor(reporter.kept());
    return 0;
}
