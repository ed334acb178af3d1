// SPDX-License-Identifier: Apache-2.0
// What a node pays once at start (its warp map) and a snapshot at its end (the composed pictures).
#include <benchmark/benchmark.h>

#include "calibration/theatre/compose.h"
#include "common/wall/wall.h"
#include "tests/support/projected.h"

namespace aquarama::bench {
namespace {

config::Rig theatre() {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
}

std::vector<Light> greyChannels(const config::Rig& rig) {
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        channels.push_back(test::projectedLight(rig, i, wall::TestPattern::Grey));
    return channels;
}

void warpMapOfTheatre(benchmark::State& state) {
    const config::Rig rig = theatre();
    for (auto _ : state) benchmark::DoNotOptimize(wall::Wall(rig).warp(1));
}
BENCHMARK(warpMapOfTheatre)->Name("warp_map")->Unit(benchmark::kMillisecond);

void panoramaOfTheatre(benchmark::State& state) {
    const config::Rig rig = theatre();
    const std::vector<Light> channels = greyChannels(rig);
    for (auto _ : state) benchmark::DoNotOptimize(theatre::composePanorama(rig, channels));
}
BENCHMARK(panoramaOfTheatre)->Name("compose_panorama")->Unit(benchmark::kMillisecond);

void hallOfTheatre(benchmark::State& state) {
    const config::Rig rig = theatre();
    const Light panorama = test::directPanorama(rig, wall::TestPattern::Grey);
    for (auto _ : state) benchmark::DoNotOptimize(theatre::composeHall(rig, panorama, {1600, 900}));
}
BENCHMARK(hallOfTheatre)->Name("compose_hall")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
