// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/solved_hall.h"

namespace aquarama::geometry {

SolvedHall::SolvedHall(const config::Rig& theRig, const wall::Wall& wall, glm::ivec2 cells)
    : rig{theRig}, nominal{wall}, screen{wall.screen(), cells} {
    for (const config::Channel& channel : rig.channels)
        projectors.push_back({lensOf(channel.projector), poseOf(channel.projector)});
    corrections.resize(projectors.size());
}

std::optional<BumpyScreen::Place> SolvedHall::placeOf(std::size_t channel, glm::dvec2 pixel) const {
    const glm::dvec2 share = pixel / glm::dvec2(rig.channels[channel].sizePixels);
    const Device& projector = projectors[channel];
    return screen.hit(
        rayOf(projector.lens, projector.pose, pixel - corrections[channel].at(share)));
}

std::optional<BumpyScreen::Place> SolvedHall::placeSeen(std::size_t camera,
                                                        glm::dvec2 pixel) const {
    return screen.hit(rayOf(cameras[camera].lens, cameras[camera].pose, pixel));
}

std::optional<glm::dvec2> SolvedHall::modelled(const Tie& tie) const {
    const auto place = placeSeen(tie.camera, tie.seen);
    if (!place) return std::nullopt;
    const Device& projector = projectors[tie.channel];
    const Three<double> point{place->point.x, place->point.y, place->point.z};
    if (inFrame(projector.pose.data(), point)[2] <= 0) return std::nullopt;
    const Two<double> pixel = pixelOf(projector.lens.data(), projector.pose.data(), point);
    return glm::dvec2(pixel[0], pixel[1]);
}

glm::dvec2 SolvedHall::panoramaPixel(glm::dvec3 point) const {
    const glm::dvec3 eye = rig.sweetSpotMetres;
    constexpr double kBeyondMetres = 1.0;
    const auto there = nominal.screen().hit({eye, point - eye}, kBeyondMetres);
    return nominal.screen().unrolled(there.value_or(point)) * glm::dvec2(rig.panoramaPixels);
}

}  // namespace aquarama::geometry
