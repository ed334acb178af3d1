// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/compose.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <future>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "calibration/compose/room.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/base/worker_pool.h"
#include "common/wall/wall.h"

namespace aquarama::compose {

namespace {

// Whether the point is on the edge of a panel that meets this one: a point is one panel's.
bool isShownBefore(const wall::Wall& wall, std::size_t channel, glm::dvec3 point) {
    if (!wall.channel(channel).wallFromPanel()) return false;
    for (std::size_t other = 0; other < channel; ++other)
        if (wall.channel(other).pixelOf(point)) return true;
    return false;
}

std::vector<PanoramaMap::Sample> samplesOf(const wall::Wall& wall,
                                           glm::ivec2 panoramaPixels,
                                           std::size_t channel) {
    const wall::Optics& optics = wall.channel(channel);
    std::vector<PanoramaMap::Sample> samples;
    for (int y = 0; y < panoramaPixels.y; ++y)
        for (int x = 0; x < panoramaPixels.x; ++x) {
            const auto point =
                wall.screen().at(glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(panoramaPixels));
            const auto pixel = point ? optics.pixelOf(*point) : std::nullopt;
            if (pixel && !isShownBefore(wall, channel, *point))
                samples.push_back(
                    {static_cast<std::uint32_t>(y * panoramaPixels.x + x), glm::vec2(*pixel)});
        }
    return samples;
}

constexpr double kEyeBackRadii = 1.15;  // behind the sweet spot, so that the whole arc is in view
constexpr double kEyeUpMetres = 0.35;   // standing, behind people who sit
constexpr double kMargin = 1.09;        // of the screen's width
constexpr double kShareAbove = 0.3;     // of the free height; the floor gets the rest
constexpr std::size_t kSamplesPerSide = 2;  // of a pixel

// An eye that looks level, so that vertical edges stay vertical; its picture is shifted, not
// tilted.
struct Eye {
    glm::dvec3 position;
    double left, top, tangentPerPixel;

    [[nodiscard]] wall::Ray ray(glm::dvec2 pixel) const {
        return {position,
                glm::normalize(glm::dvec3(
                    left + pixel.x * tangentPerPixel, top - pixel.y * tangentPerPixel, -1))};
    }
};

// Chooses the view so that it shows all of the screen that is not too near.
Eye eyeAtTheBack(const wall::ScreenSurface& screen, glm::dvec2 sizePixels) {
    constexpr double kNearest = 0.5;  // of the screen's reach
    const ScreenReach reach = reachOf(screen);
    Eye eye{};
    eye.position = {0, kEyeUpMetres, kEyeBackRadii * reach.radius};
    double halfWidth = 0, bottom = 1e9, top = -1e9;  // tangents
    for (const glm::dvec3& point : pointsOn(screen)) {
        const double ahead = eye.position.z - point.z;
        if (ahead < kNearest * reach.radius) continue;
        halfWidth = std::max(halfWidth, std::abs(point.x) / ahead);
        bottom = std::min(bottom, (point.y - eye.position.y) / ahead);
        top = std::max(top, (point.y - eye.position.y) / ahead);
    }
    const double height = top - bottom;
    const double width = std::max(2 * halfWidth, height * sizePixels.x / sizePixels.y);
    eye.tangentPerPixel = kMargin * width / sizePixels.x;
    eye.left = -kMargin * width / 2;
    const double free = eye.tangentPerPixel * sizePixels.y - height;
    eye.top = top + kShareAbove * free;
    return eye;
}

void drawRow(const Room& room, const Eye& eye, int y, Light& hall) {
    std::array<wall::Ray, kSamplesPerSide * kSamplesPerSide> rays;
    for (int x = 0; x < hall.sizePixels.x; ++x) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec2 offset(i % kSamplesPerSide, i / kSamplesPerSide);
            rays[i] = eye.ray(glm::dvec2(x, y) + (offset + 0.5) / double(kSamplesPerSide));
        }
        hall.at(x, y) = room.seen(rays);
    }
}

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

// `eye` is empty for what the display shows, or of one eye: ".left_eye".
Picture readChannel(const config::Channel& channel,
                    const std::string& folder,
                    const std::string& eye) {
    const std::string path = folder + "/channel-" + channel.name + eye + ".png";
    Picture picture = readPng(path);
    if (picture.sizePixels != channel.sizePixels)
        throw Error(path + ": is " + sizeText(picture.sizePixels) +
                    " pixels, the rig's channel \"" + channel.name + "\" has " +
                    sizeText(channel.sizePixels) + "; take the snapshot with this rig");
    return picture;
}

// Whether the picture is what the display throws on the wall. Displays of the other modes part the
// two eyes of it and throw both, one over the other.
bool showsAsItIs(config::StereoMode mode) {
    return mode == config::StereoMode::Mono || mode == config::StereoMode::Anaglyph;
}

Light meanOf(Light one, const Light& other) {
    for (std::size_t i = 0; i < one.rgb.size(); ++i)
        one.rgb[i] = 0.5F * (one.rgb[i] + other.rgb[i]);
    return one;
}

// As one eye behind its glasses sees it; a mono channel has one picture for both.
std::vector<Light> readEye(const config::Rig& rig,
                           const std::string& folder,
                           const std::string& eye) {
    const Projectors projectors(rig);
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const bool two = wall::stereoOf(rig, i).mode != config::StereoMode::Mono;
        channels.push_back(
            projectors.thrown(i, readChannel(rig.channels[i], folder, two ? eye : "")));
    }
    return channels;
}

bool hasStereo(const config::Rig& rig) {
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        if (wall::stereoOf(rig, i).mode != config::StereoMode::Mono) return true;
    return false;
}

}  // namespace

namespace {

// The light of the projector's own red, green and blue.
std::array<std::vector<float>, 3> lightOfCodes(const formats::ChannelColour& colour, int bits) {
    std::array<std::vector<float>, 3> light;
    const std::size_t codes = std::size_t{1} << bits;
    for (std::size_t c = 0; c < light.size(); ++c)
        for (std::size_t code = 0; code < codes; ++code)
            light[c].push_back(static_cast<float>(formats::lightFor(
                colour.response[c], static_cast<double>(code) / static_cast<double>(codes - 1))));
    return light;
}

}  // namespace

Light Projectors::thrown(std::size_t channel, const Picture& picture) const {
    assert(channel < colours_.size());
    const std::optional<formats::ChannelColour>& colour = colours_[channel];
    if (!colour) return lightOf(picture);
    const auto [red, green, blue] = lightOfCodes(*colour, picture.bits);
    const glm::mat3 lightFromOwn(glm::inverse(glm::dmat3(colour->mix)));
    Light light = darkness(picture.sizePixels);
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
        const std::uint16_t* codes = &picture.rgb[3 * i];
        light.rgb[i] = lightFromOwn * glm::vec3(red[codes[0]], green[codes[1]], blue[codes[2]]);
    }
    return light;
}

PanoramaMap::PanoramaMap(const config::Rig& rig) : sizePixels_{rig.panoramaPixels} {
    const wall::Wall wall(rig);
    std::vector<std::future<std::vector<Sample>>> pending;
    for (std::size_t channel = 0; channel < wall.channels(); ++channel)
        pending.push_back(std::async(
            std::launch::async, samplesOf, std::cref(wall), rig.panoramaPixels, channel));
    for (auto& samples : pending) samples_.push_back(samples.get());
}

Light PanoramaMap::compose(std::span<const Light> channels) const {
    assert(channels.size() == samples_.size());
    Light panorama = darkness(sizePixels_);
    for (std::size_t i = 0; i < samples_.size(); ++i)
        for (const Sample& sample : samples_[i])
            panorama.rgb[sample.place] += bilinear(channels[i], glm::dvec2(sample.pixel));
    return panorama;
}

Light composePanorama(const config::Rig& rig, std::span<const Light> channels) {
    return PanoramaMap(rig).compose(channels);
}

namespace {

// The light that the screen reflects at one of its points.
ScreenLight screenLight(const wall::Wall& wall,
                        const Light& panorama,
                        std::span<const Light> channels) {
    if (channels.empty())
        return [&wall, &panorama](glm::dvec3 point) {
            return bilinear(panorama,
                            wall.screen().unrolled(point) * glm::dvec2(panorama.sizePixels));
        };
    return [&wall, channels](glm::dvec3 point) {
        for (std::size_t i = 0; i < channels.size(); ++i)
            if (const auto pixel = wall.channel(i).pixelOf(point))
                return bilinear(channels[i], *pixel);
        return glm::vec3(0);
    };
}

}  // namespace

Light composeHall(const wall::ScreenSurface& screen,
                  const Light& panorama,
                  const ScreenLight& light,
                  glm::ivec2 sizePixels) {
    assert(sizePixels.x > 0);
    assert(sizePixels.y > 0);
    const Eye eye = eyeAtTheBack(screen, sizePixels);
    const Room room(screen, panorama, light, eye.position);
    Light hall = darkness(sizePixels);
    WorkerPool(std::thread::hardware_concurrency())
        .run(static_cast<std::size_t>(sizePixels.y),
             [&](std::size_t y) { drawRow(room, eye, static_cast<int>(y), hall); });
    return hall;
}

Light composeHall(const config::Rig& rig,
                  const Light& panorama,
                  glm::ivec2 sizePixels,
                  std::span<const Light> channels) {
    if (rig.screen.shape != config::ScreenShape::Panels) channels = {};
    const wall::Wall wall(rig);
    return composeHall(wall.screen(), panorama, screenLight(wall, panorama, channels), sizePixels);
}

std::vector<Light> readChannels(const config::Rig& rig, const std::string& folder) {
    const Projectors projectors(rig);
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const auto light = [&](const char* eye) {
            return projectors.thrown(i, readChannel(rig.channels[i], folder, eye));
        };
        channels.push_back(showsAsItIs(wall::stereoOf(rig, i).mode)
                               ? light("")
                               : meanOf(light(".left_eye"), light(".right_eye")));
    }
    return channels;
}

namespace {

void writeHall(const config::Rig& rig,
               const Light& panorama,
               std::span<const Light> channels,
               const std::string& folder,
               int bits) {
    writePng(folder + "/hall.png",
             pictureOf(composeHall(rig, panorama, kHallPixels, channels), bits, 0));
}

}  // namespace

void writePanoramaAndHall(const config::Rig& rig,
                          const Light& panorama,
                          std::span<const Light> channels,
                          const std::string& folder,
                          int bits) {
    assert(bits == 8 || bits == 16);
    // While the hall is composed, which takes longer.
    auto written = std::async(std::launch::async, [&] {
        writePng(folder + "/panorama.png", pictureOf(panorama, bits, 0));
    });
    writeHall(rig, panorama, channels, folder, bits);
    written.get();
}

void composeSnapshot(const config::Rig& rig,
                     const std::string& folder,
                     int bits,
                     bool keepPanorama) {
    const PanoramaMap map(rig);
    const std::vector<Light> channels = readChannels(rig, folder);
    const auto write = keepPanorama ? writeHall : writePanoramaAndHall;
    write(rig, map.compose(channels), channels, folder, bits);
    if (!hasStereo(rig)) return;
    for (const std::string eye : {".left_eye", ".right_eye"})
        writePng(fmt::format("{}/panorama{}.png", folder, eye),
                 pictureOf(map.compose(readEye(rig, folder, eye)), bits, 0));
}

}  // namespace aquarama::compose
