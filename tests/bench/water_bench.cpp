// SPDX-License-Identifier: Apache-2.0
// What water costs a channel of config/desk.txtpb: the passes over its picture by tier, and an eye
// that dives, for which the light that water scatters is mixed anew. On software GL, CPU time of
// all threads is what counts: MeasureProcessCPUTime.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/matrix.hpp>

#include "render_node/gl/context.h"
#include "render_node/scene/scene_picture.h"
#include "render_node/shaders/frame_uniforms.h"
#include "render_node/water/water_tables.h"

namespace aquarama::bench {
namespace {

constexpr glm::ivec2 kDeskWindow{480, 360};

// Everything far away: each tap of the softening counts.
shaders::FrameUniforms farAway() {
    shaders::FrameUniforms uniforms{};
    uniforms.clipFromWorld = glm::mat4{0.0F};
    uniforms.clipFromWorld[0][0] = 2.5F;
    uniforms.clipFromWorld[1][1] = 2.0F;
    uniforms.clipFromWorld[2][3] = -1.0F;
    uniforms.clipFromWorld[3][2] = 0.05F;
    uniforms.worldFromClip = glm::inverse(uniforms.clipFromWorld);
    uniforms.viewport = glm::vec4(kDeskWindow, kDeskWindow.y, kDeskWindow.y);
    uniforms.kdAndExposure.w = 8.0F;
    return uniforms;
}

void post(benchmark::State& state) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    const shaders::FrameUniforms uniforms = farAway();
    const gl::Buffer block;
    glNamedBufferStorage(block.name(), sizeof(uniforms), &uniforms, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, block.name());
    scene::ScenePicture picture{scene::qualityOf(static_cast<config::QualityTier>(state.range(0)))};
    for (auto iteration : state) {
        picture.begin(kDeskWindow);
        benchmark::DoNotOptimize(picture.finish(false));
        glFinish();
    }
}
BENCHMARK(post)
    ->Name("frame_part/post")
    ->ArgName("tier")
    ->DenseRange(0, 2)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void dive(benchmark::State& state) {
    const scene::Inscatter inscatter{scene::seaWater(config::WaterType::IA)};
    double depth = 1;
    scene::Table table = inscatter.atDepth(depth);
    for (auto iteration : state) {
        depth = depth > 30 ? 1 : depth + 0.01;
        inscatter.mixAtDepth(depth, table);
        benchmark::DoNotOptimize(table.texels.data());
    }
}
BENCHMARK(dive)->Name("frame_part/water_dive")->Unit(benchmark::kMicrosecond);

void bake(benchmark::State& state) {
    for (auto iteration : state) {
        const scene::WaterSpectra water = scene::seaWater(config::WaterType::IA);
        const scene::Inscatter inscatter{water};
        benchmark::DoNotOptimize(scene::bakeDirect(water).texels.data());
        benchmark::DoNotOptimize(scene::bakeOpenWater(water).texels.data());
    }
}
BENCHMARK(bake)->Name("water_bake")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
