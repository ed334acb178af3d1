// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/snapshot.h"

#include <vector>

#include "calibration/theatre/compose.h"
#include "common/units/error.h"
#include "common/wall/png_file.h"

namespace aquarama {

namespace {

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

Light readChannel(const Channel& channel, const std::string& folder) {
    const std::string path = folder + "/channel-" + channel.name + ".png";
    const Picture picture = readPng(path);
    if (picture.sizePixels != channel.sizePixels)
        throw Error(path + ": is " + sizeText(picture.sizePixels) +
                    " pixels, the rig's channel \"" + channel.name + "\" has " +
                    sizeText(channel.sizePixels) + "; take the snapshot with this rig");
    return lightOf(picture);
}

}  // namespace

std::vector<Light> readChannels(const Rig& rig, const std::string& folder) {
    std::vector<Light> channels;
    for (const Channel& channel : rig.channels) channels.push_back(readChannel(channel, folder));
    return channels;
}

void composeSnapshot(const Rig& rig, const std::string& folder, int bits) {
    const Light panorama = composePanorama(rig, readChannels(rig, folder));
    writePng(folder + "/panorama.png", pictureOf(panorama, bits, 0));
    writePng(folder + "/hall.png", pictureOf(composeHall(rig, panorama, kHallPixels), bits, 0));
}

}  // namespace aquarama
