// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/table1.h"

#include <algorithm>
#include <cstdio>

namespace aquarama::bench {

namespace {

using Run = benchmark::BenchmarkReporter::Run;

constexpr double kFishOfSurface = 51;  // kFish of surface_bench.cpp

// ns a fish: the counter "ns_per_fish", or processor time where there is none. Median of all runs
// whose name starts so; 0 where there are none.
double nanosecondsPerFish(const std::vector<Run>& runs, const std::string& start) {
    std::vector<double> figures;
    for (const Run& run : runs) {
        if (run.run_type != Run::RT_Iteration) continue;
        if (!run.benchmark_name().starts_with(start)) continue;
        const auto counter = run.counters.find("ns_per_fish");
        figures.push_back(counter != run.counters.end()
                              ? counter->second.value
                              : run.GetAdjustedCPUTime() * 1e9 /
                                    benchmark::GetTimeUnitMultiplier(run.time_unit));
    }
    if (figures.empty()) return 0;
    std::ranges::sort(figures);
    return figures[figures.size() / 2];
}

}  // namespace

std::vector<Table1Row> table1(const std::vector<Run>& runs) {
    const double substep = nanosecondsPerFish(runs, "dynamics_step");
    const double step = nanosecondsPerFish(runs, "dynamics_tick");
    const double frame = nanosecondsPerFish(runs, "body_frame/fish:10000/");
    const double nodes = nanosecondsPerFish(runs, "frame_and_nodes/fish:10000/");
    const double sort = nanosecondsPerFish(runs, "surface_sort") / kFishOfSurface;
    const double drawn = nanosecondsPerFish(runs, "surface_update/level/0") / kFishOfSurface;
    if (std::min({substep, step, frame, nodes, sort, drawn}) == 0) return {};
    constexpr double kPaperDynamics = 40;
    constexpr double kPaperReplay = 0.01;
    return {{"table1/dynamics", "dynamics, a step of 1/60 s", step, kPaperDynamics},
            {"table1/dynamics_substep", "  one of its substeps", substep, 0},
            {"table1/replay_nodes", "replay: frame and 23 nodal points", nodes, kPaperReplay},
            {"table1/replay_frame", "  master: frame and state", frame, 0},
            {"table1/replay_sort", "  node: records, culling, detail", sort, 0},
            {"table1/replay_surface", "  node: control points, surface", drawn - sort, 0},
            {"table1/replay", "  all three", frame + drawn, 0}};
}

void print(const std::vector<Table1Row>& table) {
    if (table.empty()) return;
    const Table1Row& dynamics = table.front();
    std::printf("\nTable 1: ms a fish and step    %12s %10s %12s %10s\n",
                "ours",
                "ratio",
                "paper",
                "ratio");
    for (const Table1Row& row : table) {
        std::printf("%-36s %10.6f %8.0f",
                    row.what.c_str(),
                    row.nanoseconds / 1e6,
                    dynamics.nanoseconds / row.nanoseconds);
        if (row.paperMilliseconds > 0)
            std::printf(" %12.2f %10.0f",
                        row.paperMilliseconds,
                        dynamics.paperMilliseconds / row.paperMilliseconds);
        std::printf("\n");
    }
}

}  // namespace aquarama::bench
