// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/snapshot.h"

#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::show {

namespace {

// Projects into a target of the sample's format and reads it back.
template <class Sample>
Picture readBack(ChannelPicture& picture, GLenum format, Encoding encoding, Shown shown) {
    const gl::Target target(format, picture.sizePixels());
    picture.project(target.framebuffer(), encoding, Overlays{}, shown);
    const std::vector<Sample> pixels = gl::readRgb<Sample>(target);
    return {
        picture.sizePixels(), 8 * static_cast<int>(sizeof(Sample)), {pixels.begin(), pixels.end()}};
}

}  // namespace

Picture takePicture(ChannelPicture& picture, PictureBits bits, Shown shown) {
    return bits == PictureBits::Deep16
               ? readBack<std::uint16_t>(picture, GL_RGBA16, Encoding::Plain, shown)
               : readBack<std::uint8_t>(picture, GL_RGBA8, Encoding::Dithered8, shown);
}

Shown flat(const ChannelPicture& picture) {
    const config::StereoMode mode = picture.stereo().mode;
    const bool whole = mode == config::StereoMode::Mono || mode == config::StereoMode::Anaglyph;
    return whole ? Shown::Display : Shown::LeftEye;
}

void writeSnapshot(const std::string& folder,
                   const std::string& channel,
                   ChannelPicture& picture,
                   PictureBits bits) {
    const std::string name = folder + "/channel-" + channel;
    writePng(name + ".png", takePicture(picture, bits, Shown::Display));
    if (picture.stereo().mode == config::StereoMode::Mono) return;
    writePng(name + ".left_eye.png", takePicture(picture, bits, Shown::LeftEye));
    writePng(name + ".right_eye.png", takePicture(picture, bits, Shown::RightEye));
}

}  // namespace aquarama::show
