// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/snapshot.h"

#include <future>
#include <vector>

#include "calibration/theatre/compose.h"
#include "common/units/log.h"
#include "common/wall/png_file.h"
#include "common/wall/wall.h"

namespace aquarama::theatre {

namespace {

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

// `eye` is empty for what the display shows, or of one eye: ".left_eye".
wall::Light readChannel(const config::Channel& channel,
                        const std::string& folder,
                        const std::string& eye) {
    const std::string path = folder + "/channel-" + channel.name + eye + ".png";
    const wall::Picture picture = wall::readPng(path);
    if (picture.sizePixels != channel.sizePixels)
        throw Error(path + ": is " + sizeText(picture.sizePixels) +
                    " pixels, the rig's channel \"" + channel.name + "\" has " +
                    sizeText(channel.sizePixels) + "; take the snapshot with this rig");
    return wall::lightOf(picture);
}

// Displays of the other modes part the eyes again: what they throw on the wall is both, over one
// another.
bool showsAsItIs(config::StereoMode mode) {
    return mode == config::StereoMode::Mono || mode == config::StereoMode::Anaglyph;
}

wall::Light meanOf(wall::Light one, const wall::Light& other) {
    for (std::size_t i = 0; i < one.rgb.size(); ++i)
        one.rgb[i] = 0.5F * (one.rgb[i] + other.rgb[i]);
    return one;
}

// As one eye behind its glasses sees it; a mono channel has one picture for both.
std::vector<wall::Light> readEye(const config::Rig& rig,
                                 const std::string& folder,
                                 const std::string& eye) {
    std::vector<wall::Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const bool two = wall::stereoOf(rig, i).mode != config::StereoMode::Mono;
        channels.push_back(readChannel(rig.channels[i], folder, two ? eye : ""));
    }
    return channels;
}

bool hasStereo(const config::Rig& rig) {
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        if (wall::stereoOf(rig, i).mode != config::StereoMode::Mono) return true;
    return false;
}

}  // namespace

std::vector<wall::Light> readChannels(const config::Rig& rig, const std::string& folder) {
    std::vector<wall::Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const config::Channel& channel = rig.channels[i];
        channels.push_back(showsAsItIs(wall::stereoOf(rig, i).mode)
                               ? readChannel(channel, folder, "")
                               : meanOf(readChannel(channel, folder, ".left_eye"),
                                        readChannel(channel, folder, ".right_eye")));
    }
    return channels;
}

void writePanoramaAndHall(const config::Rig& rig,
                          const wall::Light& panorama,
                          const std::string& folder,
                          int bits) {
    // While the hall is composed, which takes longer.
    auto written = std::async(std::launch::async, [&] {
        wall::writePng(folder + "/panorama.png", wall::pictureOf(panorama, bits, 0));
    });
    wall::writePng(folder + "/hall.png",
                   wall::pictureOf(composeHall(rig, panorama, kHallPixels), bits, 0));
    written.get();
}

void composeSnapshot(const config::Rig& rig, const std::string& folder, int bits) {
    const PanoramaMap map(rig);
    writePanoramaAndHall(rig, map.compose(readChannels(rig, folder)), folder, bits);
    if (!hasStereo(rig)) return;
    for (const std::string eye : {".left_eye", ".right_eye"})
        wall::writePng(folder + "/panorama" + eye + ".png",
                       wall::pictureOf(map.compose(readEye(rig, folder, eye)), bits, 0));
}

}  // namespace aquarama::theatre
