// SPDX-License-Identifier: Apache-2.0
// What the fish of a node cost before a pixel is drawn, with the captured repertoire of the show:
// records, culling and levels of detail; then control points, limit surface and vertices.
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include "capture/capture_repertoire.h"
#include "render_node/gl/context.h"
#include "render_node/surface/school_surface.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama::bench {
namespace {

using surface::DetailLevel;

constexpr int kFish = 51;

// Inside of the level where nothing is left of the coarser one.
float metresFor(DetailLevel level) {
    const surface::SharedView view;
    const float pixels = 1.5F * surface::detailLimits(1.0F).at(std::size_t(level));
    return 0.24F / (pixels * view.pixelRadians);
}

const motion::Repertoire& scadRepertoire() {
    static const motion::Repertoire kRepertoire = capture::captureRepertoire(
        config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"),
        [](double) {});
    return kRepertoire;
}

// A school of which all fish are at one level, drawn without pixels.
class DrawnSchool {
  public:
    explicit DrawnSchool(DetailLevel level) : level_(level), school_(fishAt(level)) {
        glNamedFramebufferParameteri(nowhere_.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 8);
        glNamedFramebufferParameteri(nowhere_.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 8);
        glBindFramebuffer(GL_FRAMEBUFFER, nowhere_.name());
        glEnable(GL_RASTERIZER_DISCARD);
    }

    void sort() {
        surface_.update(school_.moment());
        surface_.look(glm::mat4{1.0F}, {});
    }
    void draw() { surface_.drawBodies(); }
    [[nodiscard]] bool isAtLevel() const {
        return surface_.counts().atLevel.at(std::size_t(level_)) == kFish;
    }

  private:
    static std::vector<motion::PresentedFish> fishAt(DetailLevel level) {
        std::vector<motion::PresentedFish> fish;
        for (int i = 0; i < kFish; ++i) {
            fish.push_back(test::fishAt({0, 0, -metresFor(level)}, {1, 0, 0, 0}));
            fish.back().phase = static_cast<float>(i) / kFish;
        }
        return fish;
    }

    DetailLevel level_;
    test::RecordedSchool school_;
    std::vector<surface::SchoolSpecies> cast_{
        {test::scadBody(), {}, scadRepertoire(), school_.traits}};
    surface::SchoolSurface surface_{cast_, {.culling = false}, surface::makeSkinPrograms()};
    gl::Framebuffer nowhere_;
};

template <class Work>
void measure(benchmark::State& state, DetailLevel level, const Work& work) {
    const auto context = gl::makeOffscreenContext("auto", {64, 64});
    DrawnSchool school(level);
    for (auto _ : state) {
        work(school);
        glFinish();
    }
    if (!school.isAtLevel()) state.SkipWithError("not at the wanted level");
    state.counters["per_fish"] = benchmark::Counter(
        kFish, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void surfaceSort(benchmark::State& state) {
    measure(state, DetailLevel::ControlMesh, [](DrawnSchool& school) { school.sort(); });
}
BENCHMARK(surfaceSort)
    ->Name("surface_sort")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void surfaceUpdate(benchmark::State& state) {
    const auto level = static_cast<DetailLevel>(std::size_t(DetailLevel::ControlMesh) +
                                                static_cast<std::size_t>(state.range(0)));
    measure(state, level, [](DrawnSchool& school) {
        school.sort();
        school.draw();
    });
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
}  // namespace aquarama::bench
