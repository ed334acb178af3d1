// SPDX-License-Identifier: Apache-2.0
// What culling and levels of detail save of the fish's stages alone, which are drawn into a picture
// of their own, in the light of a sea without fish. Whole frames: whole_frame_bench.cpp.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/scene/scene.h"
#include "render_node/surface/school_surface.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"

namespace aquarama::bench {
namespace {

constexpr glm::ivec2 kPicture{480, 360};  // a channel of config/desk.txtpb
constexpr float kPixelRadians = 0.0016F;
constexpr std::size_t kInView = 40;
constexpr std::size_t kMany = 250'000;
// As heroes without culling.
constexpr std::size_t kHeroes = 2'000;

scene::View lookingAhead() {
    scene::View view;
    view.sizePixels = kPicture;
    // 44 x 52 degrees, reversed depth with the far plane at infinity.
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = 1.0F / glm::tan(glm::radians(22.0F));
    view.clipFromCamera[1][1] = 1.0F / glm::tan(glm::radians(26.0F));
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = 0.05F;
    view.cameraFromWorld = glm::translate(glm::mat4{1.0F}, -place::kEyePosition);
    return view;
}

// The first forty are before the eye, at one metre to thirteen; all others behind it.
std::vector<motion::PresentedFish> fishOf(std::size_t count) {
    std::vector<motion::PresentedFish> school;
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = static_cast<float>(i);
        const bool ahead = i < kInView;
        const float away = ahead ? 1.0F + 0.3F * k : 3.0F + std::fmod(0.618F * k, 40.0F);
        const glm::vec2 slope{(ahead ? 0.3F : 1.0F) * std::sin(12.9898F * k),
                              (ahead ? 0.3F : 0.5F) * std::sin(78.233F * k)};
        const glm::vec3 place = away * glm::normalize(glm::vec3{slope, ahead ? -1.0F : 1.0F});
        school.push_back(test::fishAt(place::kEyePosition + place,
                                      glm::angleAxis(2.4F * k, glm::vec3{0, 1, 0})));
        school.back().id = static_cast<std::uint32_t>(i);
        school.back().phase = std::fmod(0.377F * k, 1.0F);
    }
    return school;
}

// One frame's fish, again and again.
class FishStages {
  public:
    FishStages(std::size_t fish, bool savesWork)
        : recorded_{fishOf(fish)}, sea_{{.place = {.kind = config::PlaceKind::OpenSea}}, {}} {
        const config::Species scad = test::castMember("bigeye_scad");
        const body::FishBody body = body::makeBody(scad);
        const std::vector<surface::SchoolSpecies> cast{
            {body, body::skinOf(scad), test::swaying(body, 0.05F), recorded_.traits}};
        school_ = std::make_unique<surface::SchoolSurface>(
            cast,
            surface::SurfaceOptions{.culling = savesWork, .levelsOfDetail = savesWork},
            surface::makeSkinPrograms());
        glTextureStorage2D(colour_.name(), 1, GL_RGBA16F, kPicture.x, kPicture.y);
        glTextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, kPicture.x, kPicture.y);
        glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
        glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
        // Leaves the sea's light and the frame's uniform block bound.
        sea_.update({.timeSeconds = 12.0, .eyePositionMetres = place::kEyePosition});
        sea_.draw(view_);
        glFinish();
    }

    void cull() {
        school_->update({recorded_.records, recorded_.records, 0.5F});
        school_->look(view_.clipFromCamera * view_.cameraFromWorld,
                      {place::kEyePosition, kPixelRadians});
    }
    void draw() {
        glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
        glViewport(0, 0, kPicture.x, kPicture.y);
        glClearDepth(0.0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GEQUAL);
        school_->drawBodies();
        school_->drawBlended();
        glDisable(GL_DEPTH_TEST);
    }
    // Reconstruction, surface and vertices: no pixel.
    void surface() {
        glEnable(GL_RASTERIZER_DISCARD);
        draw();
        glDisable(GL_RASTERIZER_DISCARD);
    }
    void frame() {
        cull();
        draw();
        glFinish();
    }

  private:
    test::RecordedSchool recorded_;
    scene::View view_ = lookingAhead();
    scene::SceneRenderer sea_;
    std::unique_ptr<surface::SchoolSurface> school_;
    gl::Texture colour_{GL_TEXTURE_2D}, depth_{GL_TEXTURE_2D};
    gl::Framebuffer target_;
};

std::unique_ptr<gl::Context> contextFor() {
    return gl::makeOffscreenContext("auto", {16, 16});
}

// The driver draws on threads of its own: what all of them used is what counts.
void inMilliseconds(benchmark::internal::Benchmark* bench) {
    bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

double processSeconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double secondsOfAFrame(std::size_t fish, bool savesWork, int frames) {
    FishStages stages(fish, savesWork);
    stages.frame();
    const double start = processSeconds();
    for (int i = 0; i < frames; ++i) stages.frame();
    return (processSeconds() - start) / frames;
}

// How many times a frame's fish cost without culling and levels of detail what they cost with.
void lodFactor(benchmark::State& state) {
    const auto context = contextFor();
    double on = 0, off = 0;
    for (auto iteration : state) {
        on = secondsOfAFrame(kHeroes, true, 5);
        off = secondsOfAFrame(kHeroes, false, 1);
    }
    state.counters["factor"] = off / on;
    state.counters["on_ms"] = 1e3 * on;
    state.counters["off_ms"] = 1e3 * off;
}
BENCHMARK(lodFactor)->Name("fish_stages/factor")->Iterations(1)->Apply(inMilliseconds);

void framePart(benchmark::State& state, void (*part)(FishStages&)) {
    const auto context = contextFor();
    FishStages stages(kMany, true);
    stages.frame();
    for (auto iteration : state) {
        part(stages);
        glFinish();
    }
}
BENCHMARK_CAPTURE(framePart, cull, [](FishStages& stages) { stages.cull(); })
    ->Name("frame_part/cull")
    ->Apply(inMilliseconds);
// Reconstruction and surface are one kernel.
BENCHMARK_CAPTURE(framePart, surface, [](FishStages& stages) { stages.surface(); })
    ->Name("frame_part/reconstruct_and_surface")
    ->Apply(inMilliseconds);
BENCHMARK_CAPTURE(framePart, fish, [](FishStages& stages) { stages.draw(); })
    ->Name("frame_part/fish")
    ->Apply(inMilliseconds);

}  // namespace
}  // namespace aquarama::bench
