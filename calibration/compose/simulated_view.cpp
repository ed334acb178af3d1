// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/simulated_view.h"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <vector>

#include "calibration/compose/compose.h"
#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/hall_view.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "common/base/log.h"
#include "common/base/worker_pool.h"
#include "common/wall/wall.h"

namespace aquarama::compose {

namespace {

// Fixed: the same command gives the same picture, with the same noise.
constexpr std::uint32_t kCameraSeed = 1;

// The rig by which nodes draw.
config::Rig drawnRig(const SimulatedView& options) {
    if (options.wallPath.empty()) return config::readRig(options.rigPath);
    return hall::withWallFile(config::readRigAsHung(options.rigPath), options.wallPath);
}

// One picture is enough. A channel in stereo has one for each eye instead of the plain one.
bool hasChannelPictures(const config::Rig& rig, const std::string& folder) {
    return std::ranges::any_of(rig.channels, [&](const config::Channel& channel) {
        const std::string name = folder + "/channel-" + channel.name;
        return std::filesystem::exists(name + ".png") ||
               std::filesystem::exists(name + ".left_eye.png");
    });
}

// The pictures that the channels are sent, as the light of sRGB codes; drawn from a panorama where
// there are no others.
std::vector<Light> sentPictures(const SimulatedView& options, const config::Rig& drawn) {
    const std::string panorama = options.folder + "/panorama.png";
    if (hasChannelPictures(drawn, options.folder) || !std::filesystem::exists(panorama)) {
        config::Rig plain = drawn;  // no colour of a wall file is undone
        for (config::Channel& channel : plain.channels) channel.wallFile.reset();
        return readChannels(plain, options.folder);
    }
    const Light content = lightOf(readPng(panorama));
    const hall::DrawnWall wall(drawn);
    return wall.pictures(hall::contentOf(content, wall.wall().screen()));
}

// The panorama for the light of the screen on the room.
constexpr glm::ivec2 kGlowPixels(640, 320);

// By an eye at the back of the hall, in 8 bits of sRGB.
Picture seenInHall(const hall::TrueHall& truth, const std::vector<Light>& sent) {
    const hall::LitScreen screen(truth, sent);
    const auto light = [&](glm::dvec3 point) { return screen.at(point); };
    return pictureOf(
        composeHall(truth.screen().shape(), screen.panorama(kGlowPixels), light, kHallPixels),
        8,
        0);
}

// With the faults and the noise of the simulated camera, unlike seenByPlainCamera().
Picture seenByCamera(const hall::TrueHall& truth, const std::vector<Light>& sent) {
    std::vector<config::ScanPattern> whites;  // the camera is exposed for them
    for (std::size_t i = 0; i < truth.channels(); ++i) whites.push_back({.lit = config::bitOf(i)});
    const hall::SimulatedCamera camera(truth, whites, kCameraSeed);
    return camera.pictureOf(hall::allThrown(truth, sent));
}

// The light falls by the hall of --hall; the pictures are drawn by the rig and its wall file.
Picture seenIn(const config::Rig& hung, const SimulatedView& options, bool isCamera) {
    if (!options.wallPath.empty() && hasChannelPictures(hung, options.folder))
        throw Error("--wall: " + options.folder +
                    " has pictures of channels, which are thrown as they are: leave --wall out, or "
                    "give a folder with panorama.png alone");
    const hall::TrueHall truth(hung, hall::hallFrom("--hall", options.hall, hung));
    const std::vector<Light> sent = sentPictures(options, drawnRig(options));
    return isCamera ? seenByCamera(truth, sent) : seenInHall(truth, sent);
}

// As the rig and its wall file say that all hangs, by a camera without faults.
Light seenByPlainCamera(const config::Rig& drawn, const config::Rig& hung, const Light& panorama) {
    const hall::TrueHall plain(hung,
                               hall::plainHall(hung, kCameraSeed, hall::cameraScaleFor(hung)));
    const auto screen = wall::makeSurface(drawn);
    const hall::Content content = hall::contentOf(panorama, *screen);
    Light seen = darkness(plain.hall().camera.sizePixels);
    WorkerPool(std::thread::hardware_concurrency())
        .run(static_cast<std::size_t>(seen.sizePixels.y), [&](std::size_t y) {
            for (int x = 0; x < seen.sizePixels.x; ++x) {
                const glm::dvec2 pixel(x + 0.5, static_cast<double>(y) + 0.5);
                if (const auto point = screen->hit(plain.cameraLens().ray(pixel), 0))
                    seen.at(x, static_cast<int>(y)) = content(*point);
            }
        });
    return seen;
}

// Without --hall: the pictures are composed as the rig and its wall file say.
Picture seenAsDrawn(const SimulatedView& options, bool isCamera) {
    const config::Rig drawn = drawnRig(options);
    const Projectors projectors(drawn);
    std::vector<Light> thrown = sentPictures(options, drawn);
    for (std::size_t i = 0; i < thrown.size(); ++i)
        thrown[i] = projectors.thrown(i, pictureOf(thrown[i], 16, 0));
    const Light panorama = composePanorama(drawn, thrown);
    return pictureOf(
        isCamera ? seenByPlainCamera(drawn, config::readRigAsHung(options.rigPath), panorama)
                 : composeHall(drawn, panorama, kHallPixels, thrown),
        8,
        0);
}

}  // namespace

// A hall decides between the true wall and the wall as the rig has it.
void drawView(const SimulatedView& options) {
    const bool isCamera = options.view == "camera";
    writePng(options.outPath,
             options.hall.empty()
                 ? seenAsDrawn(options, isCamera)
                 : seenIn(config::readRigAsHung(options.rigPath), options, isCamera));
}

}  // namespace aquarama::compose
