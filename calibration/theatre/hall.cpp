// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

#include "calibration/theatre/compose.h"
#include "calibration/theatre/room.h"
#include "common/units/worker_pool.h"

namespace aquarama::theatre {

namespace {

constexpr double kEyeBackRadii = 1.15;  // behind the sweet spot, so that the whole arc is in view
constexpr double kEyeUpMetres = 0.35;   // standing, behind people who sit
constexpr double kMargin = 1.09;        // of the screen's width
constexpr double kShareAbove = 0.3;     // of the free height; the floor gets the rest
constexpr std::size_t kSamplesPerSide = 2;  // of a pixel

// An eye that looks level, so that upright edges stay upright; its picture is shifted, not tilted.
struct Eye {
    glm::dvec3 position;
    double left, top, tangentPerPixel;

    [[nodiscard]] wall::Ray ray(glm::dvec2 pixel) const {
        return {position,
                glm::normalize(glm::dvec3(
                    left + pixel.x * tangentPerPixel, top - pixel.y * tangentPerPixel, -1))};
    }
};

Eye eyeAtTheBack(const config::Screen& screen, glm::dvec2 sizePixels) {
    Eye eye{};
    eye.position = {0, kEyeUpMetres, kEyeBackRadii * screen.radiusMetres};
    const double halfArc = screen.arcRadians / 2;
    const double toEdge = eye.position.z + screen.radiusMetres * std::cos(halfArc);
    const double halfWidth = screen.radiusMetres * std::sin(halfArc) / toEdge;
    const double height = screen.heightMetres / toEdge;
    const double width = std::max(2 * halfWidth, height * sizePixels.x / sizePixels.y);
    eye.tangentPerPixel = kMargin * width / sizePixels.x;
    eye.left = -kMargin * width / 2;
    const double free = eye.tangentPerPixel * sizePixels.y - height;
    eye.top = (screen.heightMetres / 2 - eye.position.y) / toEdge + kShareAbove * free;
    return eye;
}

void drawRow(const Room& room, const Eye& eye, int y, wall::Light& hall) {
    std::array<wall::Ray, kSamplesPerSide * kSamplesPerSide> rays;
    for (int x = 0; x < hall.sizePixels.x; ++x) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec2 offset(i % kSamplesPerSide, i / kSamplesPerSide);
            rays[i] = eye.ray(glm::dvec2(x, y) + (offset + 0.5) / double(kSamplesPerSide));
        }
        hall.at(x, y) = room.seen(rays);
    }
}

}  // namespace

// On all processors: a hall takes seconds on one.
wall::Light composeHall(const config::Rig& rig,
                        const wall::Light& panorama,
                        glm::ivec2 sizePixels) {
    const Eye eye = eyeAtTheBack(rig.screen, sizePixels);
    const Room room(rig.screen, panorama, eye.position);
    wall::Light hall = wall::darkness(sizePixels);
    WorkerPool(std::thread::hardware_concurrency())
        .run(static_cast<std::size_t>(sizePixels.y),
             [&](std::size_t y) { drawRow(room, eye, static_cast<int>(y), hall); });
    return hall;
}

}  // namespace aquarama::theatre
