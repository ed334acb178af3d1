// SPDX-License-Identifier: Apache-2.0
#include "calibration/result/wall_of.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <thread>

#include "common/base/worker_pool.h"
#include "common/wall/mark.h"

namespace aquarama::result {

namespace {

// Where a viewer at the sweet spot sees a point, on the rig's screen.
std::optional<glm::dvec3> seenOnScreen(const geometry::SolvedHall& hall, glm::dvec3 point) {
    const glm::dvec3 eye = hall.rig.sweetSpotMetres;
    return hall.nominal.screen().hit({eye, point - eye}, wall::kSpillMetres);
}

formats::FileChannel regionOf(const geometry::SolvedHall& hall,
                              std::size_t channel,
                              WorkerPool& pool) {
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

// The view without what it knows of samples on the crew's tape.
scan::CameraView withoutMarks(const geometry::SolvedHall& hall, scan::CameraView view) {
    constexpr double kMarginMetres = 0.03;
    const auto marks = wall::markPlaces(hall.rig.screen.shape, hall.nominal.screen());
    if (view.samples.empty() || marks.empty()) return view;
    const glm::ivec2 samples = view.samples.front().light.sizePixels;
    for (int y = 0; y < samples.y; ++y)
        for (int x = 0; x < samples.x; ++x) {
            const std::size_t pixel = scan::pixelOfSample(view, x, y);
            const auto width = static_cast<std::size_t>(view.sizePixels.x);
            const auto seen = hall.placeSeen(0, glm::dvec2(pixel % width, pixel / width) + 0.5);
            const auto isMark = [&](const wall::MarkPlace& mark) {
                return seen && mark.covers(seen->point, 0, kMarginMetres);
            };
            if (std::ranges::any_of(marks, isMark))
                for (scan::ChannelView& channel : view.channels)
                    if (!channel.place.empty())
                        channel.place[pixel] = glm::vec2(std::numeric_limits<float>::quiet_NaN());
        }
    return view;
}

}  // namespace

formats::WallFile wallFileOf(const geometry::SolvedHall& hall) {
    WorkerPool pool(std::thread::hardware_concurrency());
    formats::WallFile file;
    file.profile = formats::Profile::Screen;
    file.origin = formats::DataOrigin::IdealEyePoint;
    for (std::size_t i = 0; i < hall.rig.channels.size(); ++i)
        file.channels.push_back(regionOf(hall, i, pool));
    return file;
}

ShadedWall shadedWallOf(const geometry::SolvedHall& hall, const scan::CameraView& view) {
    ShadedWall wall{.file = wallFileOf(hall), .brightness = {}, .seams = {}};
    const scan::CameraView bare = withoutMarks(hall, view);
    if (const auto lights = light::measureLight(hall.rig, bare)) {
        wall.brightness = light::shade(hall, *lights, wall.file);
        wall.seams = light::foreseenSeams(*lights, wall.file, bare);
    }
    return wall;
}

}  // namespace aquarama::result
