// SPDX-License-Identifier: Apache-2.0
// What the place costs a channel of config/desk.txtpb, without fish, and what it takes to grow it.
// On software GL, CPU time of all threads is what counts: MeasureProcessCPUTime.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/scene/scene.h"

namespace aquarama::bench {
namespace {

constexpr glm::ivec2 kDeskWindow{480, 360};

scene::View channelTowards(float azimuthDegrees) {
    scene::View view;
    view.sizePixels = kDeskWindow;
    // 44 x 52 degrees, reversed depth with the far plane at infinity.
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = 1.0F / glm::tan(glm::radians(22.0F));
    view.clipFromCamera[1][1] = 1.0F / glm::tan(glm::radians(26.0F));
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = 0.05F;
    view.cameraFromWorld =
        glm::rotate(glm::mat4{1.0F}, glm::radians(azimuthDegrees), glm::vec3{0, 1, 0}) *
        glm::translate(glm::mat4{1.0F}, -place::kEyePosition);
    return view;
}

void sceneFrame(benchmark::State& state) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    scene::SceneRenderer scene{
        {.culling = state.range(1) != 0, .levelsOfDetail = state.range(2) != 0}, {}};
    const scene::View view = channelTowards(static_cast<float>(state.range(0)));
    scene::SceneFrame frame;
    frame.eyePositionMetres = place::kEyePosition;
    for (auto iteration : state) {
        frame.timeSeconds += 1.0 / 60.0;
        scene.update(frame);
        benchmark::DoNotOptimize(scene.draw(view));
        glFinish();
    }
}
BENCHMARK(sceneFrame)
    ->Name("frame_part/scene")
    ->ArgNames({"azimuth", "culling", "lod"})
    ->Args({-40, 1, 1})
    ->Args({0, 1, 1})
    ->Args({40, 1, 1})
    ->Args({0, 0, 1})
    ->Args({0, 1, 0})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void sceneGrow(benchmark::State& state) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    for (auto iteration : state) {
        const scene::SceneRenderer scene{{}, {}};
        glFinish();
    }
}
BENCHMARK(sceneGrow)
    ->Name("scene_grow")
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);

}  // namespace
}  // namespace aquarama::bench
