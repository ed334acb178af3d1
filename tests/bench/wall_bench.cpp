// SPDX-License-Identifier: Apache-2.0
// What a node pays once at start (its warp map) and a snapshot at its end (the composed pictures).
#include <benchmark/benchmark.h>

#include "calibration/theatre/compose.h"
#include "calibration/theatre/projected.h"
#include "common/wall/wall.h"

namespace aquarama {
namespace {

Rig theatre() {
    return readRig(AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
}

std::vector<Light> greyChannels(const Rig& rig) {
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        channels.push_back(projectedLight(rig, i, TestPattern::Grey));
    return channels;
}

void warpMapOfTheatre(benchmark::State& state) {
    const Rig rig = theatre();
    for (auto _ : state) benchmark::DoNotOptimize(warpMap(rig, 1));
}
BENCHMARK(warpMapOfTheatre)->Name("warp_map")->Unit(benchmark::kMillisecond);

void panoramaOfTheatre(benchmark::State& state) {
    const Rig rig = theatre();
    const std::vector<Light> channels = greyChannels(rig);
    for (auto _ : state) benchmark::DoNotOptimize(composePanorama(rig, channels));
}
BENCHMARK(panoramaOfTheatre)->Name("compose_panorama")->Unit(benchmark::kMillisecond);

void hallOfTheatre(benchmark::State& state) {
    const Rig rig = theatre();
    const Light panorama = directPanorama(rig, TestPattern::Grey);
    for (auto _ : state) benchmark::DoNotOptimize(composeHall(rig, panorama, {1600, 900}));
}
BENCHMARK(hallOfTheatre)->Name("compose_hall")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama
