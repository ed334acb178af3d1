// SPDX-License-Identifier: Apache-2.0
// What drawings cost: frames of a reef with sixty fish in view that wear what visitors have
// painted, each beside a frame of the same fish in their own skins.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "common/body/side_skin.h"
#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/scene/scene.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"

namespace aquarama::bench {
namespace {

constexpr glm::ivec2 kPicture{480, 360};  // a channel of config/desk.txtpb
constexpr std::uint32_t kFish = 60;

scene::View lookingAhead() {
    scene::View view;
    view.sizePixels = kPicture;
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = 1.0F / glm::tan(glm::radians(26.0F));
    view.clipFromCamera[1][1] = 1.0F / glm::tan(glm::radians(22.0F));
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = 0.05F;
    view.cameraFromWorld = glm::translate(glm::mat4{1.0F}, -place::kEyePosition);
    return view;
}

// Half clownfish, half blue tangs, of 0.2 m, at one metre to seven; all in view.
std::vector<motion::PresentedFish> fishAhead() {
    std::vector<motion::PresentedFish> fish;
    for (std::uint32_t i = 0; i < kFish; ++i) {
        const float k = static_cast<float>(i), away = 1.0F + 0.1F * k;
        const glm::vec2 slope{0.35F * std::sin(12.9898F * k), 0.3F * std::sin(78.233F * k)};
        fish.push_back(test::fishAt(place::kEyePosition + away * glm::vec3{slope, -1.0F},
                                    glm::angleAxis(2.4F * k, glm::vec3{0, 1, 0}),
                                    0.2F));
        fish.back().id = i;
    }
    return fish;
}

// Stripes, so that no two texels side by side are alike.
std::shared_ptr<const body::SideSkin> anySkin(std::uint32_t number) {
    body::SideSkin skin;
    for (std::size_t level = 0; level < body::kSideLevels; ++level) {
        const glm::ivec2 size = body::sideTexelsAt(level);
        for (int i = 0; i < size.x * size.y; ++i)
            skin.levels.at(level).emplace_back((97 * i) % 256, (number * 40) % 256, i % 256, 255);
    }
    return std::make_shared<const body::SideSkin>(std::move(skin));
}

double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// `own` and `drawn`: processor time of a frame, milliseconds; `more`: the median of what a pair
// differs by, per cent.
void drawnSkins(benchmark::State& state, config::QualityTier quality) {
    const auto context = gl::makeOffscreenContext("auto", kPicture);
    const std::vector<motion::PresentedFish> fish = fishAhead();
    const test::RecordedSchool own{fish};
    test::RecordedSchool drawn = own;
    body::SkinsByNumber skins;
    for (std::uint32_t i = 0; i < kFish; ++i) {
        drawn.records[i].skin = i + 1;
        skins[i + 1] = anySkin(i + 1);
    }
    std::vector<surface::SchoolSpecies> cast;
    for (const char* name : {"clownfish", "blue_tang"}) {
        const body::FishBody body = body::makeBody(test::castMember(name));
        const auto first =
            own.traits.begin() + static_cast<std::ptrdiff_t>(cast.size() * kFish / 2);
        cast.push_back({.body = body,
                        .skin = body::skinOf(test::castMember(name)),
                        .repertoire = test::swaying(body, 0.05F),
                        .fish = {first, first + kFish / 2},
                        .takesDrawings = true});
    }
    scene::SceneRenderer scene({.quality = quality}, cast);
    const double before = processorSeconds();
    scene.wear(skins, skins.size());
    glFinish();
    state.counters["upload_ms"] = 1000 * (processorSeconds() - before) / kFish;
    double seconds = 0;
    const auto frame = [&](const test::RecordedSchool& school) {
        const double begin = processorSeconds();
        scene.update({.timeSeconds = seconds += 1.0 / 60,
                      .eyePositionMetres = place::kEyePosition,
                      .fish = school.moment()});
        scene.draw(lookingAhead());
        glFinish();
        return 1000 * (processorSeconds() - begin);
    };
    frame(own);  // compiles what the driver compiles on first use
    frame(drawn);
    std::vector<double> ownTimes, drawnTimes, more;
    for (auto iteration : state) {
        ownTimes.push_back(frame(own));
        drawnTimes.push_back(frame(drawn));
        more.push_back(100 * (drawnTimes.back() / ownTimes.back() - 1));
    }
    state.counters["own"] = medianOf(ownTimes);
    state.counters["drawn"] = medianOf(drawnTimes);
    state.counters["more"] = medianOf(more);
}

BENCHMARK_CAPTURE(drawnSkins, low, config::QualityTier::Low)
    ->Name("drawn_skins/low")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(30);
BENCHMARK_CAPTURE(drawnSkins, medium, config::QualityTier::Medium)
    ->Name("drawn_skins/medium")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

}  // namespace
}  // namespace aquarama::bench
