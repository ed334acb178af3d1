// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/drawn_wall.h"

#include <thread>

#include <glm/common.hpp>

#include "common/base/files.h"
#include "common/base/worker_pool.h"
#include "common/wall/pattern.h"

namespace aquarama::hall {

Content contentOf(const Light& panorama, const wall::ScreenSurface& screen) {
    return [&panorama, &screen](glm::dvec3 point) {
        return bilinear(panorama, screen.unrolled(point) * glm::dvec2(panorama.sizePixels));
    };
}

Content gridContent(const wall::Wall& wall) {
    const bool isAround = wall.screen().patternGround().isAround();
    const glm::dvec3 origin = wall.patternOrigin();
    return [origin, isAround](glm::dvec3 point) {
        return glm::vec3(static_cast<float>(wall::gridLight(point - origin, isAround)));
    };
}

config::Rig withWallFile(config::Rig rig, const std::string& path) {
    for (config::Channel& channel : rig.channels) channel.wallFile = {path, channel.name, ""};
    rig.files[path] =
        std::make_shared<const std::vector<std::byte>>(readWhole(path, config::kMostWallFileBytes));
    return rig;
}

namespace {

glm::vec3 codesOf(const formats::ChannelColour& colour, glm::vec3 light) {
    const glm::vec3 own = glm::clamp(colour.mix * light, 0.0F, 1.0F);
    glm::vec3 sent(0);
    for (int c = 0; c < 3; ++c)
        sent[c] = static_cast<float>(linearFromSrgb(formats::codeFor(
            colour.response[static_cast<std::size_t>(c)], static_cast<double>(own[c]))));
    return sent;
}

}  // namespace

glm::vec3 DrawnWall::shareAt(std::size_t channel, glm::dvec3 point, std::size_t pixelIndex) const {
    const std::vector<glm::vec3>& blend = wall_.channel(channel).blend();
    if (!blend.empty()) return blend[pixelIndex];
    return glm::vec3(static_cast<float>(wall_.weight(channel, point)));
}

glm::vec3 DrawnWall::sent(std::size_t channel, glm::dvec2 pixel, const Content& content) const {
    const wall::Optics& optics = wall_.channel(channel);
    const glm::ivec2 size = rig_.channels[channel].sizePixels;
    const glm::ivec2 at = glm::clamp(glm::ivec2(pixel), glm::ivec2(0), size - 1);
    const auto index = static_cast<std::size_t>(at.y * size.x + at.x);
    glm::vec3 light(0);
    if (const auto point = optics.pointOf(pixel, wall::kSpillMetres))
        light = shareAt(channel, *point, index) * content(*point);
    light = glm::clamp(light, 0.0F, 1.0F);
    if (!optics.black().empty())
        light = light * (1.0F - optics.black()[index]) + optics.black()[index];
    return optics.colour() != nullptr ? codesOf(*optics.colour(), light) : light;
}

std::vector<Light> DrawnWall::pictures(const Content& content) const {
    WorkerPool pool(std::thread::hardware_concurrency());
    std::vector<Light> pictures;
    for (std::size_t channel = 0; channel < rig_.channels.size(); ++channel) {
        Light& picture = pictures.emplace_back(darkness(rig_.channels[channel].sizePixels));
        pool.run(static_cast<std::size_t>(picture.sizePixels.y), [&](std::size_t y) {
            for (int x = 0; x < picture.sizePixels.x; ++x)
                picture.at(x, static_cast<int>(y)) =
                    sent(channel, {x + 0.5, static_cast<double>(y) + 0.5}, content);
        });
    }
    return pictures;
}

}  // namespace aquarama::hall
