// SPDX-License-Identifier: Apache-2.0
// What saving a world costs the tick thread, beside a tick of the same world, and what encoding it
// costs another thread. Medians.
#include <algorithm>
#include <chrono>
#include <vector>

#include <benchmark/benchmark.h>

#include "master/world/world.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::bench {
namespace {

template <class Work>
double microsecondsOf(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
        .count();
}

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Each eighth tick a save: as many ticks as there are kinds of them.
void measure(benchmark::State& state, world::World& world) {
    world::WorldState saved;
    world.save(saved);  // the first one allocates
    std::vector<double> ticks, saves, encodings;
    std::size_t bytes = 0;
    for ([[maybe_unused]] auto _ : state) {
        for (int i = 0; i < 8; ++i) ticks.push_back(microsecondsOf([&] { world.advance(); }));
        saves.push_back(microsecondsOf([&] { world.save(saved); }));
        encodings.push_back(microsecondsOf([&] { bytes = world::encodeState(saved).size(); }));
        state.SetIterationTime(saves.back() * 1e-6);
    }
    state.counters["tick_us"] = medianOf(ticks);
    state.counters["save_us"] = medianOf(saves);
    state.counters["encode_us"] = medianOf(encodings);
    state.counters["save_of_tick"] = medianOf(saves) / medianOf(ticks);
    state.counters["bytes_per_fish"] =
        static_cast<double>(bytes) / static_cast<double>(world.states().size());
}

void reef(benchmark::State& state) {
    world::World world(world::optionsOfScene("reef"));
    measure(state, world);
}

void school(benchmark::State& state) {
    world::WorldOptions options = world::optionsOfScene("empty_sea");
    options.cast.front().fish = static_cast<std::uint32_t>(state.range(0));
    options.threads = 2;
    world::World world(options);
    measure(state, world);
}

BENCHMARK(reef)->Name("save/scene:reef")->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(school)
    ->Name("save/scene:empty_sea/fish")
    ->Arg(250'000)
    ->UseManualTime()
    ->Iterations(20)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace aquarama::bench
