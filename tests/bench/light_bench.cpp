// SPDX-License-Identifier: Apache-2.0
// What the sea's light costs a frame, before anything is drawn with it: waves, caustics and the
// shafts of one channel of config/desk.txtpb. On software GL, CPU time of all
// threads is what counts.
#include <string>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/reef/mesh.h"
#include "render_node/scene/sea_light.h"
#include "render_node/shaders/frame_uniforms.h"

namespace aquarama::bench {
namespace {

// 44 x 52 degrees, reversed depth with the far plane at infinity.
glm::mat4 clipFromWorld() {
    glm::mat4 clip{0.0F};
    clip[0][0] = 1.0F / glm::tan(glm::radians(22.0F));
    clip[1][1] = 1.0F / glm::tan(glm::radians(26.0F));
    clip[2][3] = -1.0F;
    clip[3][2] = 0.05F;
    return clip * glm::translate(glm::mat4{1.0F}, -place::kEyePosition);
}

void light(benchmark::State& state) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    shaders::FrameUniforms uniforms{};
    uniforms.clipFromWorld = clipFromWorld();
    uniforms.worldFromClip = glm::inverse(uniforms.clipFromWorld);
    uniforms.eyeAndTime = glm::vec4(place::kEyePosition, 0.0F);
    uniforms.sharedEyeAndPixel = glm::vec4(place::kEyePosition, 0.0016F);
    uniforms.sunAndFilterDepth = glm::vec4(scene::sunInWater(), 4.9F);
    uniforms.sunlight = glm::vec4(1.0F);
    uniforms.skylight = glm::vec4(1.0F);
    const gl::Buffer block;
    glNamedBufferStorage(block.name(), sizeof(uniforms), &uniforms, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, block.name());
    const auto tier = static_cast<config::QualityTier>(state.range(0));
    state.SetLabel(std::string(config::kTierNames.at(static_cast<std::size_t>(state.range(0)))));
    scene::SeaLight sea{{.quality = scene::qualityOf(tier).light}};
    double time = 0;
    for (auto iteration : state) {
        time += 1.0 / 60.0;
        sea.update(time, place::kEyePosition);
        sea.drawShafts(place::kEyePosition, uniforms.worldFromClip);
        glFinish();
    }
}
BENCHMARK(light)
    ->Name("frame_part/light")
    ->ArgName("tier")
    ->DenseRange(0, 3)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
