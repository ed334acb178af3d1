// SPDX-License-Identifier: Apache-2.0
// A frame of one channel of the desk, and its last pass alone.
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/scene.h"
#include "render_node/show/projection.h"
#include "tests/common/wall/rigs.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama::bench {
namespace {

constexpr std::size_t kMiddle = 1;
constexpr double kMarginRadians = 0.0175;

// Reads one pixel, so that nothing is left to be done when the clock stops.
void finish(const gl::Target& target) {
    std::uint32_t pixel = 0;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel);
    benchmark::DoNotOptimize(pixel);
}

// A school all round the eye, so that culling has something to leave out.
std::vector<motion::PresentedFish> schoolAround() {
    constexpr int kFish = 51;
    std::vector<motion::PresentedFish> fish;
    for (int i = 0; i < kFish; ++i) {
        const float angle = 2.4F * static_cast<float>(i);  // about the golden angle
        const float range = 1.5F + 0.1F * static_cast<float>(i);
        const glm::vec3 place(
            range * std::sin(angle), 0.3F * std::sin(5 * angle), -range * std::cos(angle));
        fish.push_back(
            test::fishAt(place::kEyePosition + place, glm::angleAxis(angle, glm::vec3(0, 1, 0))));
    }
    return fish;
}

void channelFrame(benchmark::State& state, bool culling, bool levelsOfDetail) {
    const config::Rig rig = wall::shippedRig("desk");
    const auto context = gl::makeOffscreenContext("auto", rig.channels[kMiddle].sizePixels);
    const wall::ChannelFrustum frustum = wall::Wall(rig).frustum(kMiddle, kMarginRadians);
    const show::ProjectionMap map = show::projectionMap(wall::Wall(rig).warp(kMiddle), frustum);
    const body::FishBody body = test::scadBody();
    const show::Projection projection(map, 0);
    const gl::Target target(GL_RGBA8, map.sizePixels);
    const test::RecordedSchool fish{schoolAround()};
    const std::vector<surface::SchoolSpecies> cast{
        {.body = body, .skin = {}, .repertoire = test::swaying(body, 0.05F), .fish = fish.traits}};
    scene::SceneRenderer scene({.culling = culling, .levelsOfDetail = levelsOfDetail}, cast);
    const glm::dmat4 wallFromWorld =
        glm::translate(glm::dmat4(1), -glm::dvec3(place::kEyePosition));
    const scene::View view{.clipFromCamera = wall::clipFromCamera(frustum, 0.05F),
                           .cameraFromWorld = glm::mat4(frustum.cameraFromWall * wallFromWorld),
                           .sizePixels = show::scenePictureSize(map)};
    double seconds = 0;
    const auto drawFrame = [&] {
        const scene::SceneFrame frame{.timeSeconds = seconds += 1.0 / 60,
                                      .eyePositionMetres = place::kEyePosition,
                                      .fish = fish.moment()};
        scene.update(frame);
        projection.draw(
            {.sceneTexture = scene.draw(view), .framebuffer = target.framebuffer(), .frame = {}});
        finish(target);
    };
    drawFrame();  // compiles what the driver compiles on first use
    for (auto _ : state) drawFrame();
    state.counters["frames"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void projectPass(benchmark::State& state, const char* rigName) {
    const config::Rig rig = wall::shippedRig(rigName);
    const auto context = gl::makeOffscreenContext("auto", rig.channels[kMiddle].sizePixels);
    const show::ProjectionMap map = show::projectionMap(
        wall::Wall(rig).warp(kMiddle), wall::Wall(rig).frustum(kMiddle, kMarginRadians));
    const show::Projection projection(map, 0);
    const gl::Target scene(GL_RGBA16F, show::scenePictureSize(map));
    const gl::Target target(GL_RGBA8, map.sizePixels);
    glBindFramebuffer(GL_FRAMEBUFFER, scene.framebuffer());
    glClearColor(0.1F, 0.2F, 0.3F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    for (auto _ : state) {
        projection.draw(
            {.sceneTexture = scene.texture(), .framebuffer = target.framebuffer(), .frame = {}});
        finish(target);
    }
    const double pixels = static_cast<double>(map.sizePixels.x) * map.sizePixels.y;
    state.counters["pixels"] =
        benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate);
}

// The driver draws on threads of its own: what all of them used is what counts.
void inMilliseconds(benchmark::internal::Benchmark* bench) {
    bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK_CAPTURE(channelFrame, culling_lod, true, true)
    ->Name("channel_frame/culling:1/lod:1")
    ->Apply(inMilliseconds);
BENCHMARK_CAPTURE(channelFrame, lod, false, true)
    ->Name("channel_frame/culling:0/lod:1")
    ->Apply(inMilliseconds);
BENCHMARK_CAPTURE(channelFrame, culling, true, false)
    ->Name("channel_frame/culling:1/lod:0")
    ->Apply(inMilliseconds);
BENCHMARK_CAPTURE(channelFrame, neither, false, false)
    ->Name("channel_frame/culling:0/lod:0")
    ->Apply(inMilliseconds);
BENCHMARK_CAPTURE(projectPass, desk, "desk")->Name("frame_part/warp/desk")->Apply(inMilliseconds);
BENCHMARK_CAPTURE(projectPass, theatre, "theatre")
    ->Name("frame_part/warp/theatre")
    ->Apply(inMilliseconds);

}  // namespace
}  // namespace aquarama::bench
