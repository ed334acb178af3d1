// SPDX-License-Identifier: Apache-2.0
// What a thought about neighbours costs. In the time of one thread, so that what else the machine
// does is not counted; best and median of the ticks.
#include <algorithm>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/place/place.h"
#include "master/behaviour/grids.h"
#include "master/behaviour/neighbours.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama::bench {
namespace {

double threadNanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

template <class Work>
double nanosecondsOf(const Work& work) {
    const double start = threadNanoseconds();
    work();
    return threadNanoseconds() - start;
}

void report(benchmark::State& state, std::vector<double> nanoseconds, double thoughts) {
    std::sort(nanoseconds.begin(), nanoseconds.end());
    state.counters["ns_best"] = nanoseconds.front() / thoughts;
    state.counters["ns_per_fish"] = nanoseconds[nanoseconds.size() / 2] / thoughts;
}

// A school in which each has as many cubic body lengths as the second argument says, in tenths.
struct School {
    fish::FishView view;
    std::vector<fish::SpeciesParameters> speciesParameters =
        std::vector<fish::SpeciesParameters>(1);
    behaviour::Grids grids;

    School(std::size_t fish, double lengthsCubed) : School(fish, regionFor(fish, lengthsCubed)) {}

  private:
    School(std::size_t fish, const place::Region& region)
        : view(behaviour::scatteredSchool(1, fish, region)), grids(region, fish, 0) {
        speciesParameters[0].last = static_cast<std::uint32_t>(fish);
        grids.rebuild(view, {}, speciesParameters);
    }
    static place::Region regionFor(std::size_t fish, double lengthsCubed) {
        constexpr double kLengthMetres = 0.24;
        const double volume = static_cast<double>(fish) * lengthsCubed * kLengthMetres *
                              kLengthMetres * kLengthMetres;
        return {{0, -6, -5}, glm::vec3{static_cast<float>(0.5 * std::cbrt(volume))}};
    }
};

// Of those who think at a tick, every eighth: in the order of the cells, as the world asks.
void nearest(benchmark::State& state) {
    const auto fish = static_cast<std::size_t>(state.range(0));
    const School school(fish, 0.1 * static_cast<double>(state.range(1)));
    const behaviour::SpatialGrid& grid = school.grids.fish;
    std::vector<double> ticks;
    std::size_t seen = 0;
    for ([[maybe_unused]] auto _ : state) {
        ticks.push_back(nanosecondsOf([&] {
            for (std::size_t slot = 0; slot < fish; ++slot) {
                const std::uint32_t one = grid.index()[slot];
                if (one % 8 != ticks.size() % 8) continue;
                const behaviour::NearestFish found = behaviour::nearestVisible(
                    school.view, school.grids, school.speciesParameters[0], one);
                seen += found.schoolmates.count;
            }
        }));
        state.SetIterationTime(ticks.back() * 1e-9);
    }
    const double thoughts = static_cast<double>(fish) / 8;
    report(state, ticks, thoughts);
    state.counters["seen"] =
        static_cast<double>(seen) / static_cast<double>(ticks.size()) / thoughts;
    state.counters["lanes"] = static_cast<double>(behaviour::nearestVisibleLanes());
}
BENCHMARK(nearest)
    ->Name("think_nearest")
    ->ArgNames({"fish", "tenths_of_lengths_cubed"})
    ->ArgsProduct({{1000, 10000, 100000}, {2, 10, 20, 40, 80}})
    ->Args({1000000, 20})
    ->UseManualTime();

// The grids of a tick, all of them, on one thread.
void grids(benchmark::State& state) {
    const auto fish = static_cast<std::size_t>(state.range(0));
    School school(fish, 2);
    std::vector<double> ticks;
    for ([[maybe_unused]] auto _ : state) {
        ticks.push_back(nanosecondsOf(
            [&] { school.grids.rebuild(school.view, {}, school.speciesParameters); }));
        state.SetIterationTime(ticks.back() * 1e-9);
    }
    report(state, ticks, static_cast<double>(fish));
    state.counters["bytes_per_fish"] =
        static_cast<double>(school.grids.bytes()) / static_cast<double>(fish);
}
BENCHMARK(grids)
    ->Name("think_grids")
    ->ArgName("fish")
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->UseManualTime();

}  // namespace
}  // namespace aquarama::bench
