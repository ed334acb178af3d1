// SPDX-License-Identifier: Apache-2.0
// What a tick of the whole world costs with all routines on: scad at equal density in an open sea,
// a shark for every two thousand, plankton in proportion, and their real repertoires; and the reef
// of reef_full with its 17 species, many times over. p50_ms and p99_ms are what a clock on the wall
// says, on two threads from 4 000 fish on; busy_p50_ms and busy_p99_ms the processor time of the
// thread that took more; the others are processor time of both.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "capture/capture_repertoire.h"
#include "common/motion/motor.h"
#include "master/world/world.h"
#include "tests/master/world/many_reefs.h"
#include "tests/support/cast.h"
#include "tests/support/scad.h"

namespace aquarama::bench {
namespace {

constexpr double kLengthMetres = 0.24;
constexpr double kLengthsCubedPerFish = 4;
constexpr double kClearanceMetres = 1.5;  // between those at the edge and the border of the water
constexpr std::uint32_t kFishPerShark = 2000;
constexpr std::uint32_t kFishPerParticle = 5;
constexpr int kTicksBefore = 120;

double millisecondsOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double wallMilliseconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

world::WorldSpecies member(const config::Species& species,
                           const std::shared_ptr<const motion::MotorTables>& tables,
                           std::uint32_t fish,
                           const config::Start& start) {
    world::WorldSpecies member{.tables = tables, .fish = fish};
    member.name = species.name;
    member.habits = species.habits;
    member.start = start;
    return member;
}

std::shared_ptr<const motion::MotorTables> sharkTables() {
    static const std::shared_ptr<const motion::MotorTables> kTables = motion::makeMotorTables(
        capture::captureRepertoire(test::castMember("blacktip_reef_shark"), [](double) {}));
    return kTables;
}

std::shared_ptr<const motion::MotorTables> scadTables() {
    static const std::shared_ptr<const motion::MotorTables> kTables =
        motion::makeMotorTables(test::scadRepertoire());
    return kTables;
}

constexpr std::uint32_t kFishOfTwoThreads = 4000;  // as in a show on two cores

world::WorldOptions openSea(std::uint32_t fish, unsigned threads) {
    const double volume = fish * kLengthsCubedPerFish * std::pow(kLengthMetres, 3);
    const double half = 0.5 * std::cbrt(volume);
    const auto extent = static_cast<float>(half + kClearanceMetres);
    world::WorldOptions options;
    options.threads = threads;
    options.scene.place = config::PlaceKind::OpenSea;
    options.scene.gathering = config::Gathering::None;
    options.scene.water.centre = {0, -extent - 2, -extent};
    options.scene.water.halfExtent = glm::vec3{extent};
    options.scene.water.leastLengthsCubed = 0;
    options.scene.eye = {0, -extent - 2, 2};
    options.scene.plankton = fish / kFishPerParticle;
    config::Start start;
    start.centre = options.scene.water.centre;
    start.radiusMetres = half;
    options.cast.push_back(member(test::scad(), scadTables(), fish, start));
    const std::uint32_t sharks = fish < 1000 ? 0 : std::max(1U, fish / kFishPerShark);
    options.cast.push_back(
        member(test::castMember("blacktip_reef_shark"), sharkTables(), sharks, start));
    options.cast.back().size = {1.2F, 0.05F, 1.1F, 1.3F};
    return options;
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void timeTicks(benchmark::State& state, world::World& world) {
    for (int i = 0; i < kTicksBefore; ++i) world.advance();
    std::vector<double> wall;
    std::vector<double> processor;
    std::vector<double> busier;
    for ([[maybe_unused]] auto _ : state) {
        const double wallStart = wallMilliseconds();
        const double allStart = millisecondsOf(CLOCK_PROCESS_CPUTIME_ID);
        const double ownStart = millisecondsOf(CLOCK_THREAD_CPUTIME_ID);
        world.advance();
        const double own = millisecondsOf(CLOCK_THREAD_CPUTIME_ID) - ownStart;
        processor.push_back(millisecondsOf(CLOCK_PROCESS_CPUTIME_ID) - allStart);
        busier.push_back(std::max(own, processor.back() - own));  // there are two threads at most
        wall.push_back(wallMilliseconds() - wallStart);
        state.SetIterationTime(wall.back() * 1e-3);
    }
    const auto fish = static_cast<double>(world.states().size());
    state.counters["p50_ms"] = quantile(wall, 0.5);
    state.counters["p99_ms"] = quantile(wall, 0.99);
    state.counters["busy_p50_ms"] = quantile(busier, 0.5);
    state.counters["busy_p99_ms"] = quantile(busier, 0.99);
    state.counters["cpu_ms"] = quantile(processor, 0.5);
    state.counters["best_cpu_ms"] = quantile(processor, 0);
    state.counters["ns_per_fish"] = 1e6 * quantile(processor, 0.5) / fish;
    state.counters["bytes_per_fish"] = static_cast<double>(world.bytes()) / fish;
}

void mindTick(benchmark::State& state) {
    const auto fish = static_cast<std::uint32_t>(state.range(0));
    world::World world(openSea(fish, fish < kFishOfTwoThreads ? 1 : 2));
    timeTicks(state, world);
}
BENCHMARK(mindTick)
    ->Name("mind_tick")
    ->ArgName("fish")
    ->Arg(60)
    ->Arg(1000)
    ->Arg(10000)
    ->UseManualTime()
    ->Iterations(1000);
BENCHMARK(mindTick)
    ->Name("mind_tick")
    ->ArgName("fish")
    ->Arg(100000)
    ->Arg(250000)
    ->UseManualTime()
    ->Iterations(400);
BENCHMARK(mindTick)
    ->Name("mind_tick")
    ->ArgName("fish")
    ->Arg(1000000)
    ->UseManualTime()
    ->Iterations(60);

// 2 339 fish in each reef.
void mindTickOfReefs(benchmark::State& state) {
    const glm::uvec2 reefs{state.range(0), state.range(1)};
    const world::WorldOptions options = world::optionsOfReefs(reefs, reefs.x * reefs.y < 2 ? 1 : 2);
    world::World world(options);
    world::placeSchools(world, options);
    timeTicks(state, world);
    state.counters["fish"] = static_cast<double>(world.states().size());
}
BENCHMARK(mindTickOfReefs)
    ->Name("mind_tick_of_reefs")
    ->ArgNames({"across", "behind"})
    ->Args({1, 1})
    ->Args({2, 5})
    ->UseManualTime()
    ->Iterations(1000);
BENCHMARK(mindTickOfReefs)
    ->Name("mind_tick_of_reefs")
    ->ArgNames({"across", "behind"})
    ->Args({9, 12})
    ->UseManualTime()
    ->Iterations(400);
BENCHMARK(mindTickOfReefs)
    ->Name("mind_tick_of_reefs")
    ->ArgNames({"across", "behind"})
    ->Args({20, 21})
    ->UseManualTime()
    ->Iterations(60);

}  // namespace
}  // namespace aquarama::bench
