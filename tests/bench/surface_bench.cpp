// SPDX-License-Identifier: Apache-2.0
// What the surface of a school costs: control points and limit surface in compute shaders, without
// drawing.
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include "render_node/context/context.h"
#include "render_node/surface/school_surface.h"
#include "render_node/surface/skin_programs.h"
#include "tests/render_node/surface/test_fish.h"

namespace {

using namespace aquarama;

constexpr int kFish = 51;

// So far from the eye that the fish is drawn at this level.
float metresFor(std::int64_t level) {
    return level == 0 ? 6.0F : level == 1 ? 1.5F : 0.5F;
}

void surfaceUpdate(benchmark::State& state) {
    const auto context = makeOffscreenContext("auto", {64, 64});
    const FishBody body = test::scad();
    SchoolSurface surface{body, test::swaying(body, 0.1F), {.culling = false}, makeSkinPrograms()};
    std::vector<PresentedFish> school;
    for (int i = 0; i < kFish; ++i) {
        school.push_back(test::fishAt({0, 0, -metresFor(state.range(0))}, {1, 0, 0, 0}));
        school.back().phase = static_cast<float>(i) / kFish;
    }
    for (auto _ : state) {
        surface.update(school, glm::mat4{1.0F}, glm::vec3{0});
        glFinish();
    }
    const SurfaceCounts counts = surface.counts();
    if (counts.perLevel[state.range(0)] != kFish) state.SkipWithError("not at the wanted level");
    state.counters["per_fish"] = benchmark::Counter(
        kFish, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(surfaceUpdate)
    ->Name("surface_update/level")
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
