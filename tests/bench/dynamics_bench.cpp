// SPDX-License-Identifier: Apache-2.0
// What one biomechanical fish costs: the paper's Table 1, "Dynamics".
#include <cmath>

#include <benchmark/benchmark.h>

#include "common/config/species.h"
#include "common/units/ids.h"
#include "master/capture/control/muscle_programs.h"
#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama {
namespace {

// A scad in its stride, so that muscles pull and water pushes.
struct SwimmingScad {
    Species species = readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb");
    BiomechanicalFish fish = makeBiomechanicalFish(species);
    FishState state = stateAtRest(fish);
    double seconds = 0;

    SwimmingScad() {
        while (seconds < 2) advance();
    }
    void advance() {
        step(fish,
             {.muscles = swim(species, species.swim.medium, seconds), .fins = {}},
             longestStepSeconds(fish),
             state);
        seconds += longestStepSeconds(fish);
    }
};

void dynamicsStep(benchmark::State& run) {
    SwimmingScad scad;
    for (auto _ : run) scad.advance();
    benchmark::DoNotOptimize(scad.state);
}
BENCHMARK(dynamicsStep)->Name("dynamics_step");

// One frame of a 60 Hz display: 8 steps of the fish's own time.
void dynamicsTick(benchmark::State& run) {
    SwimmingScad scad;
    const auto steps = std::lround(1 / (kTicksPerSecond * longestStepSeconds(scad.fish)));
    for (auto _ : run)
        for (long i = 0; i < steps; ++i) scad.advance();
    benchmark::DoNotOptimize(scad.state);
    run.counters["steps"] = static_cast<double>(steps);
}
BENCHMARK(dynamicsTick)->Name("dynamics_tick");

}  // namespace
}  // namespace aquarama
