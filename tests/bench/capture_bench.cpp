// SPDX-License-Identifier: Apache-2.0
// What capturing every species costs, from their files to encoded repertoires; the counter
// peak_memory_mib is that of the whole program.
#include <vector>

#include <benchmark/benchmark.h>

#include "capture/repertoire_files.h"

namespace aquarama::bench {
namespace {

std::vector<config::Species> allSpecies() {
    std::vector<config::Species> all;
    for (const auto& file : capture::speciesFiles({}, AQUARAMA_SOURCE_DIR "/config"))
        all.push_back(config::readSpecies(file.string()));
    return all;
}

void captureAll(benchmark::State& run) {
    const std::vector<config::Species> species = allSpecies();
    const auto threads = static_cast<unsigned>(run.range(0));
    std::size_t bytes = 0;
    for (auto _ : run) {
        bytes = 0;
        for (const capture::CaptureOutcome& outcome :
             capture::captureRepertoires(species, {.threads = threads})) {
            if (!outcome.repertoire) {
                run.SkipWithError(outcome.error.c_str());
                return;
            }
            bytes += motion::encodeRepertoire(*outcome.repertoire).size();
        }
    }
    run.counters["species"] = static_cast<double>(species.size());
    run.counters["seconds"] = benchmark::Counter(
        1, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    run.counters["mebibytes"] = static_cast<double>(bytes) / (1024 * 1024);
}
BENCHMARK(captureAll)
    ->Name("capture_all")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace aquarama::bench
