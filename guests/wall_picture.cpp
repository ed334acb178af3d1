// SPDX-License-Identifier: Apache-2.0
#include "guests/wall_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <turbojpeg.h>

#include "common/base/picture.h"
#include "common/wall/wall.h"

namespace aquarama::guests {

namespace {

// Of a channel's picture, as it is asked for.
constexpr std::uint32_t kChannelWidth = 240;
constexpr int kMostChannelPixels = 1920;
constexpr int kBestQuality = 70, kLeastQuality = 10, kQualityStep = 10;

std::size_t codesIn(glm::ivec2 size) {
    return std::size_t{3} * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

// Empty where it is no JPEG of at most kMostChannelPixels each way.
WallMap::ChannelCodes decoded(const std::string& jpeg) {
    const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
    WallMap::ChannelCodes codes;
    int sampling = 0;
    int space = 0;
    const int header = tjDecompressHeader3(decoder.get(),
                                           bytes,
                                           jpeg.size(),
                                           &codes.sizePixels.x,
                                           &codes.sizePixels.y,
                                           &sampling,
                                           &space);
    const glm::ivec2 size = codes.sizePixels;
    if (header != 0 || std::min(size.x, size.y) < 1 ||
        std::max(size.x, size.y) > kMostChannelPixels)
        return {};
    codes.rgb.resize(codesIn(size));
    const int done = tjDecompress2(
        decoder.get(), bytes, jpeg.size(), codes.rgb.data(), size.x, 0, size.y, TJPF_RGB, 0);
    return done == 0 ? codes : WallMap::ChannelCodes{};
}

// Of the best quality that fits into kMostWallPictureBytes; empty where none does.
std::string encoded(glm::ivec2 size, const std::vector<std::uint8_t>& rgb) {
    const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
    for (int quality = kBestQuality; quality >= kLeastQuality; quality -= kQualityStep) {
        unsigned char* bytes = nullptr;
        unsigned long count = 0;
        const int failed = tjCompress2(encoder.get(),
                                       rgb.data(),
                                       size.x,
                                       0,
                                       size.y,
                                       TJPF_RGB,
                                       &bytes,
                                       &count,
                                       TJSAMP_420,
                                       quality,
                                       0);
        const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(bytes, tjFree);
        if (failed == 0 && count <= kMostWallPictureBytes)
            return {reinterpret_cast<const char*>(bytes), count};
    }
    return {};
}

// Of each code of 8 bits.
std::vector<float> lightOfCodes() {
    std::vector<float> light;
    for (int code = 0; code < 256; ++code)
        light.push_back(static_cast<float>(linearFromSrgb(code / 255.0)));
    return light;
}

std::uint8_t codeOf(float light) {
    return static_cast<std::uint8_t>(
        std::lround(255 * srgbFromLinear(std::min(double{light}, 1.0))));
}

}  // namespace

WallMap::WallMap(const config::Rig& rig)
    : size_{kWallPictureWidth,
            std::max(1, kWallPictureWidth * rig.panoramaPixels.y / rig.panoramaPixels.x)} {
    const wall::Wall wall(rig);
    const glm::dvec3 viewer = wall::eyePosition(rig, wall::EyeSide::Between);
    for (int row = 0; row < size_.y; ++row)
        for (int column = 0; column < size_.x; ++column) {
            const auto point =
                wall.screen().at((glm::dvec2(column, row) + 0.5) / glm::dvec2(size_));
            const auto pixel = static_cast<std::uint32_t>(directions_.size());
            directions_.push_back(point ? std::optional<glm::vec3>(glm::normalize(*point - viewer))
                                        : std::nullopt);
            if (point) addSources(wall, rig, pixel, *point);
        }
}

void WallMap::addSources(const wall::Wall& wall,
                         const config::Rig& rig,
                         std::uint32_t pixel,
                         glm::dvec3 point) {
    for (std::uint32_t i = 0; i < wall.channels(); ++i)
        if (const auto place = wall.channel(i).pixelOf(point))
            sources_.push_back({pixel,
                                i,
                                glm::vec2(*place) / glm::vec2(rig.channels[i].sizePixels) *
                                    wall::firstEyeShare(wall::stereoOf(rig, i).mode)});
}

std::optional<glm::vec3> WallMap::directionAt(glm::vec2 share) const {
    const glm::ivec2 at(glm::floor(share * glm::vec2(size_)));
    if (at.x < 0 || at.y < 0 || at.x >= size_.x || at.y >= size_.y) return std::nullopt;
    return directions_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
                       static_cast<std::size_t>(at.x)];
}

std::vector<std::uint8_t> WallMap::composed(
    const std::map<std::size_t, ChannelCodes>& channels) const {
    static const std::vector<float> lightOf = lightOfCodes();
    std::vector<glm::vec3> light(directions_.size());
    for (const Source& source : sources_) {
        const auto channel = channels.find(source.channel);
        if (channel == channels.end()) continue;
        const ChannelCodes& codes = channel->second;
        const glm::ivec2 at = glm::clamp(glm::ivec2(source.share * glm::vec2(codes.sizePixels)),
                                         glm::ivec2(0),
                                         codes.sizePixels - 1);
        const std::uint8_t* const rgb = &codes.rgb[codesIn({codes.sizePixels.x, at.y}) +
                                                   std::size_t{3} * static_cast<std::size_t>(at.x)];
        light[source.pixel] += glm::vec3(lightOf[rgb[0]], lightOf[rgb[1]], lightOf[rgb[2]]);
    }
    std::vector<std::uint8_t> rgb;
    rgb.reserve(codesIn(size_));
    for (const glm::vec3& one : light)
        for (const int part : {0, 1, 2}) rgb.push_back(codeOf(one[part]));
    return rgb;
}

WallPicture::WallPicture(const config::Rig& rig, const std::optional<net::MasterKeys>& keys)
    : map_{rig},
      hub_{rig.guests->picturesAddress,
           keys,
           {.picture = [this](const std::string& channel,
                              const v1::FramePicture& picture) { take(channel, picture); },
            .fish = [](const v1::FishReply&) {}}} {
    for (const config::Channel& channel : rig.channels) channels_.push_back(channel.name);
}

void WallPicture::ask() {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        number = ++asked_;
    }
    for (const std::string& channel : channels_) hub_.askPicture(channel, number, kChannelWidth);
}

// Of a hub's thread. A picture is put together anew with each that comes.
void WallPicture::take(const std::string& channel, const v1::FramePicture& picture) {
    WallMap::ChannelCodes codes = decoded(picture.jpeg());
    const std::lock_guard lock(mutex_);
    const auto known = std::ranges::find(channels_, channel);
    if (codes.rgb.empty() || known == channels_.end()) return;
    pictures_[static_cast<std::size_t>(known - channels_.begin())] = std::move(codes);
    std::string jpeg = encoded(map_.sizePixels(), map_.composed(pictures_));
    if (jpeg.empty()) return;
    jpeg_ = std::move(jpeg);
    ++number_;
}

std::string WallPicture::jpeg() const {
    const std::lock_guard lock(mutex_);
    return jpeg_;
}

std::uint64_t WallPicture::number() const {
    const std::lock_guard lock(mutex_);
    return number_;
}

}  // namespace aquarama::guests
