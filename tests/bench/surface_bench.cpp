// SPDX-License-Identifier: Apache-2.0
// What the surface of a school costs: culling, control points, limit surface and vertices, without
// a pixel.
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

// Inside of the level where nothing is left of the coarser one.
float metresFor(surface::DetailLevel level) {
    const surface::SharedView view;
    const float pixels = 1.5F * surface::detailLimits(1.0F).at(std::size_t(level));
    return 0.24F / (pixels * view.pixelRadians);
}

void surfaceUpdate(benchmark::State& state) {
    const auto context = context::makeOffscreenContext("auto", {64, 64});
    const auto level = static_cast<surface::DetailLevel>(
        std::size_t(surface::DetailLevel::ControlMesh) + static_cast<std::size_t>(state.range(0)));
    const body::FishBody body = test::scad();
    std::vector<motion::PresentedFish> fish;
    for (int i = 0; i < kFish; ++i) {
        fish.push_back(test::fishAt({0, 0, -metresFor(level)}, {1, 0, 0, 0}));
        fish.back().phase = static_cast<float>(i) / kFish;
    }
    const test::RecordedSchool school{fish};
    const std::vector<surface::SchoolSpecies> cast{
        {body, {}, test::swaying(body, 0.1F), school.traits}};
    surface::SchoolSurface surface{cast, {.culling = false}, surface::makeSkinPrograms()};
    const gl::Framebuffer nowhere;
    glNamedFramebufferParameteri(nowhere.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 8);
    glNamedFramebufferParameteri(nowhere.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 8);
    glBindFramebuffer(GL_FRAMEBUFFER, nowhere.name());
    glEnable(GL_RASTERIZER_DISCARD);
    for (auto _ : state) {
        surface.update(school.moment());
        surface.look(glm::mat4{1.0F}, {});
        surface.drawBodies();
        glFinish();
    }
    glDisable(GL_RASTERIZER_DISCARD);
    if (surface.counts().atLevel.at(std::size_t(level)) != kFish)
        state.SkipWithError("not at the wanted level");
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
