// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/frames.h"

#include <algorithm>

#include <glm/common.hpp>

#include "calibration/scan/decode.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

// The most columns of a small copy.
constexpr int kSmallColumns = 1024;

glm::ivec2 smallSize(glm::ivec2 size, int factor) {
    return glm::max(glm::ivec2(1), size / factor);
}

float luminanceOf(const std::uint16_t* rgb, const std::vector<float>& table) {
    return cameraLuminance(table[rgb[0]], table[rgb[1]], table[rgb[2]]);
}

}  // namespace

std::vector<float> lightOfCodes(int bits, config::ScanCamera::Response response) {
    std::vector<float> table(std::size_t{1} << static_cast<unsigned>(bits));
    for (std::size_t code = 0; code < table.size(); ++code) {
        const double share = static_cast<double>(code) / static_cast<double>(table.size() - 1);
        const bool linear = response == config::ScanCamera::Response::Linear;
        table[code] = static_cast<float>(linear ? share : linearFromSrgb(share));
    }
    return table;
}

Light lightOf(const Picture& picture, config::ScanCamera::Response response) {
    const std::vector<float> table = lightOfCodes(picture.bits, response);
    Light light;
    light.sizePixels = picture.sizePixels;
    light.rgb.resize(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
        const std::uint16_t* code = &picture.rgb[3 * i];
        light.rgb[i] = {table[code[0]], table[code[1]], table[code[2]]};
    }
    return light;
}

Plane SmallPictures::shrunk(const Plane& full, int fullWidth) const {
    Plane small(static_cast<std::size_t>(sizePixels.x * sizePixels.y));
    const auto width = static_cast<std::size_t>(fullWidth);
    const auto side = static_cast<std::size_t>(factor);
    const auto columns = static_cast<std::size_t>(sizePixels.x);
    for (std::size_t row = 0; row < static_cast<std::size_t>(sizePixels.y) * side; ++row)
        for (std::size_t x = 0; x < columns * side; ++x)
            small[row / side * columns + x / side] += full[row * width + x];
    for (float& value : small) value /= static_cast<float>(factor * factor);
    return small;
}

const Plane* SmallPictures::of(std::size_t index) const {
    const auto found = std::ranges::find(pictures, index, &SmallPicture::index);
    return found == pictures.end() ? nullptr : &found->light;
}

FrameReader::FrameReader(PictureSource& source, std::uint32_t camera, WorkerPool& pool)
    : source_{source}, camera_{source.scan().cameras.at(camera)}, pool_{pool} {}

float FrameReader::exposureScale(std::size_t index) const {
    return static_cast<float>(*exposure_ / source_.scan().pictures[index].exposureSeconds);
}

ScanFrame FrameReader::read(std::size_t index, std::optional<std::size_t> next) {
    ScanFrame frame{.index = index,
                    .pattern = &source_.scan().pictures.at(index).pattern,
                    .picture = {},
                    .luminance = {}};
    const bool isRead = ahead_.valid() && aheadIndex_ == index;
    frame.picture = isRead ? ahead_.get() : source_.picture(index);
    if (next) {
        aheadIndex_ = *next;
        ahead_ = std::async(std::launch::async, [this, at = *next] { return source_.picture(at); });
    }
    measure(frame);
    return frame;
}

void FrameReader::measure(ScanFrame& frame) {
    if (!exposure_) {
        exposure_ = source_.scan().pictures[frame.index].exposureSeconds;
        size_ = frame.picture.sizePixels;
        small_.factor = std::max(1, (size_.x + kSmallColumns - 1) / kSmallColumns);
        small_.sizePixels = smallSize(size_, small_.factor);
    }
    if (frame.picture.sizePixels != size_)
        throw Error(source_.scan().pictures[frame.index].file +
                    " has another size than the other pictures; take all with one setting");
    if (tableBits_ != frame.picture.bits) {
        tableBits_ = frame.picture.bits;
        table_ = lightOfCodes(tableBits_, camera_.response);
    }
    frame.luminance.resize(frame.picture.rgb.size() / 3);
    const float scale = exposureScale(frame.index);
    forPixels(pool_, frame.luminance.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            frame.luminance[i] = scale * luminanceOf(&frame.picture.rgb[3 * i], table_);
    });
    small_.pictures.push_back({frame.index, small_.shrunk(frame.luminance, size_.x)});
}

}  // namespace aquarama::scan
