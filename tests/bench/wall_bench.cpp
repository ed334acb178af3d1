// SPDX-License-Identifier: Apache-2.0
// What a node pays once at start (its warp map) and a snapshot at its end (the composed pictures).
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "calibration/compose/compose.h"
#include "common/formats/mpcdi.h"
#include "common/wall/optics.h"
#include "common/wall/surface.h"
#include "common/wall/wall.h"
#include "tests/support/projected.h"

namespace aquarama::bench {
namespace {

config::Rig shipped(const std::string& name) {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

config::Rig theatre() {
    return shipped("theatre");
}

// The rig with projectors of 1920 x 1200 pixels in place of its own.
config::Rig fine(config::Rig rig) {
    constexpr glm::ivec2 kFine(1920, 1200);
    for (config::Channel& channel : rig.channels) {
        const glm::dvec2 factor = glm::dvec2(kFine) / glm::dvec2(channel.sizePixels);
        channel.projector.focalPixels *= factor;
        channel.projector.principalPixels *= factor;
        channel.sizePixels = kFine;
    }
    return rig;
}

// What a projector lights, its blend and a black level, as a file has them.
formats::FileChannel written(const wall::Wall& wall, const config::Rig& rig, std::size_t index) {
    const wall::WarpMap map = wall.warp(index);
    formats::FileChannel channel;
    channel.name = rig.channels[index].name;
    channel.sizePixels = map.sizePixels;
    channel.warp = formats::Warp{.size = map.sizePixels, .samples = {}};
    channel.blend = formats::Mask{.size = map.sizePixels, .bits = 16, .gamma = 2.2, .codes = {}};
    for (const glm::vec4& pixel : map.pointAndWeight) {
        constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
        channel.warp->samples.push_back(pixel.w > 0 ? glm::vec3(pixel) : glm::vec3(kNothing));
        channel.blend->codes.push_back(static_cast<std::uint16_t>(65535 * pixel.w));
    }
    channel.black = channel.blend;
    return channel;
}

// The rig with a wall file in place of its projectors.
config::Rig calibrated(config::Rig rig) {
    const wall::Wall wall(rig);
    formats::WallFile file;
    file.profile = formats::Profile::Screen;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        file.channels.push_back(written(wall, rig, i));
        rig.channels[i].wallFile = {"hall.mpcdi", rig.channels[i].name, ""};
    }
    rig.files["hall.mpcdi"] =
        std::make_shared<const std::vector<std::byte>>(formats::encodeMpcdi(file, 2));
    return rig;
}

// Rays of the middle channel's pixels, of which nearly all meet the screen.
void raysOnScreen(benchmark::State& state, const std::string& name) {
    const config::Rig rig = shipped(name);
    const config::Channel& channel = rig.channels[1];
    const auto screen = wall::makeSurface(rig);
    const wall::Lens lens(channel.projector, channel.sizePixels);
    std::vector<wall::Ray> rays;
    for (int y = 0; y < channel.sizePixels.y; y += 10)
        for (int x = 0; x < channel.sizePixels.x; x += 10)
            rays.push_back(lens.ray({x + 0.5, y + 0.5}));
    for (auto _ : state)
        for (const wall::Ray& ray : rays)
            benchmark::DoNotOptimize(screen->hit(ray, wall::kSpillMetres));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}
BENCHMARK_CAPTURE(raysOnScreen, cylinder, "theatre")->Name("rays_on_cylinder");
BENCHMARK_CAPTURE(raysOnScreen, flat, "flat_3")->Name("rays_on_flat");
BENCHMARK_CAPTURE(raysOnScreen, dome, "dome_5")->Name("rays_on_dome");
BENCHMARK_CAPTURE(raysOnScreen, measured, "measured_3")->Name("rays_on_measured");

void opticsOfWallFile(benchmark::State& state) {
    const config::Rig rig = calibrated(fine(shipped("flat_3")));
    const auto screen = wall::makeSurface(rig);
    const wall::WallFiles files = wall::readWallFiles(rig);
    for (auto _ : state) benchmark::DoNotOptimize(wall::makeOptics(rig, 1, *screen, files));
}
BENCHMARK(opticsOfWallFile)->Name("calibrated_optics")->Unit(benchmark::kMillisecond);

void pixelsOfWallFile(benchmark::State& state) {
    const config::Rig rig = calibrated(fine(shipped("flat_3")));
    const auto screen = wall::makeSurface(rig);
    const auto optics = wall::makeOptics(rig, 1, *screen, wall::readWallFiles(rig));
    std::vector<glm::dvec3> points;
    for (int y = 5; y < 1200; y += 20)
        for (int x = 5; x < 1920; x += 20)
            if (const auto point = optics->pointOf({x, y}, 0)) points.push_back(*point);
    for (auto _ : state)
        for (const glm::dvec3& point : points) benchmark::DoNotOptimize(optics->pixelOf(point));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(pixelsOfWallFile)->Name("calibrated_optics_inverse");

// Of a mask at each pixel of 1920 x 1200: by a table over its codes, and by the reference.
template <typename Light>
void lightOfMask(benchmark::State& state, const Light& makeLight) {
    formats::Mask mask{.size = {1920, 1200}, .bits = 16, .gamma = 2.2, .codes = {}};
    for (int i = 0; i < 1920 * 1200; ++i) mask.codes.push_back(static_cast<std::uint16_t>(i * 31));
    for (auto _ : state) {
        const auto light = makeLight(mask);
        for (int y = 0; y < 1200; ++y)
            for (int x = 0; x < 1920; ++x)
                benchmark::DoNotOptimize(
                    light(glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(mask.size)));
    }
}
void lightByTable(benchmark::State& state) {
    lightOfMask(state, [](const formats::Mask& mask) {
        return [light = formats::MaskLight(mask)](glm::dvec2 place) { return light.at(place); };
    });
}
BENCHMARK(lightByTable)->Name("mask_light")->Unit(benchmark::kMillisecond);
void lightByPowers(benchmark::State& state) {
    lightOfMask(state, [](const formats::Mask& mask) {
        return [&mask](glm::dvec2 place) { return formats::lightAt(mask, place); };
    });
}
BENCHMARK(lightByPowers)->Name("mask_light_reference")->Unit(benchmark::kMillisecond);

// Of three channels, whose blends ask each other.
void warpMap(benchmark::State& state, const config::Rig& rig) {
    const wall::Wall wall(rig);
    for (auto _ : state) benchmark::DoNotOptimize(wall.warp(1));
}
void warpMapOf(benchmark::State& state, const std::string& name) {
    warpMap(state, fine(shipped(name)));
}
BENCHMARK_CAPTURE(warpMapOf, flat, "flat_3")
    ->Name("warp_map_1920x1200_flat")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(warpMapOf, measured, "measured_3")
    ->Name("warp_map_1920x1200_measured")
    ->Unit(benchmark::kMillisecond);
void warpMapOfWallFile(benchmark::State& state) {
    warpMap(state, calibrated(fine(shipped("flat_3"))));
}
BENCHMARK(warpMapOfWallFile)->Name("warp_map_1920x1200_wall_file")->Unit(benchmark::kMillisecond);

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
    for (auto _ : state) benchmark::DoNotOptimize(compose::composePanorama(rig, channels));
}
BENCHMARK(panoramaOfTheatre)->Name("compose_panorama")->Unit(benchmark::kMillisecond);

void hallOfTheatre(benchmark::State& state) {
    const config::Rig rig = theatre();
    const Light panorama = test::directPanorama(rig, wall::TestPattern::Grey);
    for (auto _ : state) benchmark::DoNotOptimize(compose::composeHall(rig, panorama, {1600, 900}));
}
BENCHMARK(hallOfTheatre)->Name("compose_hall")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
