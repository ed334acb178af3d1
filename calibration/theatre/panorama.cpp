// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <future>
#include <vector>

#include "calibration/theatre/compose.h"
#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama::theatre {

namespace {

std::vector<PanoramaMap::Sample> samplesOf(const config::Rig& rig, const config::Channel& channel) {
    const wall::Pinhole projector(channel);
    std::vector<PanoramaMap::Sample> samples;
    for (int y = 0; y < rig.panoramaPixels.y; ++y)
        for (int x = 0; x < rig.panoramaPixels.x; ++x) {
            const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(rig.panoramaPixels);
            const glm::dvec3 point = wall::screenPointAt(rig.screen, at);
            const auto pixel = projector.pixelOf(point);
            if (pixel && wall::lightsInside(projector, point))
                samples.push_back(
                    {static_cast<std::uint32_t>(y * rig.panoramaPixels.x + x), glm::vec2(*pixel)});
        }
    return samples;
}

}  // namespace

PanoramaMap::PanoramaMap(const config::Rig& rig) : sizePixels_{rig.panoramaPixels} {
    std::vector<std::future<std::vector<Sample>>> pending;
    for (const config::Channel& channel : rig.channels)
        pending.push_back(
            std::async(std::launch::async, samplesOf, std::cref(rig), std::cref(channel)));
    for (auto& samples : pending) samples_.push_back(samples.get());
}

wall::Light PanoramaMap::compose(std::span<const wall::Light> channels) const {
    wall::Light panorama = wall::darkness(sizePixels_);
    for (std::size_t i = 0; i < samples_.size(); ++i)
        for (const Sample& sample : samples_[i])
            panorama.rgb[sample.place] += wall::bilinear(channels[i], glm::dvec2(sample.pixel));
    return panorama;
}

wall::Light composePanorama(const config::Rig& rig, std::span<const wall::Light> channels) {
    return PanoramaMap(rig).compose(channels);
}

}  // namespace aquarama::theatre
