// SPDX-License-Identifier: Apache-2.0
#include "calibration/solve/wall_of.h"

#include <limits>
#include <optional>
#include <thread>

#include "common/base/worker_pool.h"

namespace aquarama::solve {

namespace {

// Where a viewer at the sweet spot sees a point, on the rig's screen.
std::optional<glm::dvec3> seenOnScreen(const SolvedHall& hall, glm::dvec3 point) {
    const glm::dvec3 eye = hall.rig.sweetSpotMetres;
    return hall.nominal.screen().hit({eye, point - eye}, wall::kSpillMetres);
}

formats::FileChannel regionOf(const SolvedHall& hall, std::size_t channel, WorkerPool& pool) {
    const config::Channel& what = hall.rig.channels[channel];
    const glm::ivec2 size = what.sizePixels;
    formats::Warp warp{.size = size, .sampling = formats::Sampling::Centres, .samples = {}};
    warp.samples.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y),
                        glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    pool.run(static_cast<std::size_t>(size.y), [&](std::size_t row) {
        for (int column = 0; column < size.x; ++column) {
            const auto place =
                hall.placeOf(channel, {column + 0.5, static_cast<double>(row) + 0.5});
            if (!place) continue;
            if (const auto point = seenOnScreen(hall, place->point))
                warp.samples[row * static_cast<std::size_t>(size.x) +
                             static_cast<std::size_t>(column)] = glm::vec3(*point);
        }
    });
    formats::FileChannel region;
    region.name = what.name;
    region.sizePixels = size;
    region.warp = std::move(warp);
    return region;
}

}  // namespace

formats::WallFile wallFileOf(const SolvedHall& hall) {
    WorkerPool pool(std::thread::hardware_concurrency());
    formats::WallFile file;
    file.profile = formats::Profile::Screen;
    file.origin = formats::DataOrigin::IdealEyePoint;
    for (std::size_t i = 0; i < hall.rig.channels.size(); ++i)
        file.channels.push_back(regionOf(hall, i, pool));
    return file;
}

ShadedWall shadedWallOf(const SolvedHall& hall, const scan::CameraView& view) {
    ShadedWall wall{.file = wallFileOf(hall), .brightness = {}};
    if (const auto lights = measureLight(hall.rig, view))
        wall.brightness = shade(hall, *lights, wall.file);
    return wall;
}

}  // namespace aquarama::solve
