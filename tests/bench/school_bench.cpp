// SPDX-License-Identifier: Apache-2.0
// What a tick of the school costs: everything that World::advance does, in the time of its one
// thread, so that what else the machine does is not counted.
#include <algorithm>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>

#include "tests/master/world/captured_fish.h"

namespace aquarama::bench {
namespace {

double threadNanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

void schoolTick(benchmark::State& state) {
    const auto fish = static_cast<std::uint32_t>(state.range(0));
    world::World world = world::schoolWorld(1, fish);
    for (int i = 0; i < 120; ++i) world.advance();
    std::vector<double> nanoseconds;
    for ([[maybe_unused]] auto _ : state) {
        const double start = threadNanoseconds();
        world.advance();
        nanoseconds.push_back(threadNanoseconds() - start);
    }
    std::sort(nanoseconds.begin(), nanoseconds.end());
    double sum = 0;
    for (const double tick : nanoseconds) sum += tick;
    const auto ticks = static_cast<double>(nanoseconds.size());
    state.counters["ns_per_fish"] = sum / ticks / fish;
    state.counters["p99_us"] = nanoseconds[nanoseconds.size() * 99 / 100] / 1000;
    state.counters["bytes_per_fish"] = static_cast<double>(world.bytes()) / fish;
}
BENCHMARK(schoolTick)->Name("school_tick")->ArgName("fish")->Arg(51)->Arg(1000)->Arg(10000);

}  // namespace
}  // namespace aquarama::bench
