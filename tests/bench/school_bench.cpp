// SPDX-License-Identifier: Apache-2.0
// What a tick of the school and of shipped scenes costs: everything that World::advance does, in
// the time of its one thread, so that what else the machine does is not counted.
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

void measureTicks(benchmark::State& state, world::World& world) {
    const std::size_t fish = world.view().size();
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
    state.counters["ns_per_fish"] = sum / ticks / static_cast<double>(fish);
    state.counters["p99_us"] = nanoseconds[nanoseconds.size() * 99 / 100] / 1000;
    state.counters["bytes_per_fish"] =
        static_cast<double>(world.bytes()) / static_cast<double>(fish);
}

void schoolTick(benchmark::State& state) {
    world::World world = world::schoolWorld(1, static_cast<std::uint32_t>(state.range(0)));
    measureTicks(state, world);
}
BENCHMARK(schoolTick)->Name("school_tick")->ArgName("fish")->Arg(51)->Arg(1000)->Arg(10000);

// A minute of a scene, so that it does not depend on the moment.
constexpr int kTicksOfMinute = 3600;

void sceneTick(benchmark::State& state, const char* scene) {
    world::World world(world::optionsOfScene(scene));
    measureTicks(state, world);
}
BENCHMARK_CAPTURE(sceneTick, reef, "reef")->Name("scene_tick/reef")->Iterations(kTicksOfMinute);
BENCHMARK_CAPTURE(sceneTick, reef_1998, "reef_1998")
    ->Name("scene_tick/reef_1998")
    ->Iterations(kTicksOfMinute);

}  // namespace
}  // namespace aquarama::bench
