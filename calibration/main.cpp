// SPDX-License-Identifier: Apache-2.0
// aquarama-calibrate: checks a rig, says what it does, and composes what its projectors show.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "calibration/inventory.h"
#include "calibration/theatre/film.h"
#include "calibration/theatre/snapshot.h"
#include "calibration/theatre/survey.h"
#include "common/config/angle.h"
#include "common/config/cast.h"
#include "common/config/file_kind.h"
#include "common/config/stereo_names.h"
#include "common/units/error.h"
#include "common/wall/wall.h"

namespace aquarama {
namespace {

void say(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

Rig checkedRig(const std::string& path) {
    Rig rig = readRig(path);
    checkGeometry(rig, path);
    return rig;
}

// With the scene that it shows.
void checkRig(const std::string& path) {
    const Rig rig = checkedRig(path);
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        std::printf("%s\n", oneLine(surveyChannel(rig, i)).c_str());
    const double worst = worstBlendSum(rig);
    if (worst > 1e-6) throw Error(path + ": the channels' shares of light do not sum to one");
    (void)inventoryOfScene(scenePathOf(rig, path));
    std::printf(
        "%s: good; the channels' shares of light sum to one within %.0e\n", path.c_str(), worst);
}

// A rig, a scene or a species, whichever the file holds.
void check(const std::string& path) {
    switch (fileKindAt(path)) {
        case FileKind::Rig:
            return checkRig(path);
        case FileKind::Scene:
            return say(inventoryOfScene(path));
        case FileKind::Species:
            return say(inventoryOfSpecies(path));
    }
}

void inspect(const std::string& path) {
    const Rig rig = checkedRig(path);
    std::printf("rig \"%s\": %zu channels\n", rig.name.c_str(), rig.channels.size());
    std::printf("scene: %s\n", rig.scene.c_str());
    std::printf("screen: radius %.3f m, %.1f degrees (%.3f m of arc), %.3f m high\n",
                rig.screen.radiusMetres,
                rig.screen.arcRadians / kRadiansPerDegree,
                rig.screen.arcRadians * rig.screen.radiusMetres,
                rig.screen.heightMetres);
    std::printf("panorama: %d x %d pixels\n", rig.panoramaPixels.x, rig.panoramaPixels.y);
    if (rig.stereo.mode != StereoMode::Mono)
        std::printf("stereo: %s, eyes %.0f mm apart\n",
                    std::string(nameOf(rig.stereo.mode)).c_str(),
                    1000 * rig.stereo.eyeSeparationMetres);
    std::printf(
        "addresses: control %s, state %s\n", rig.controlAddress.c_str(), rig.stateAddress.c_str());
    std::printf("timing: %g Hz, present deadline %g s, membership %g s\n",
                rig.timing.refreshHertz,
                rig.timing.presentDeadlineSeconds,
                rig.timing.membershipSeconds);
    for (const Channel& channel : rig.channels) {
        const bool window = channel.display.mode == DisplayMode::Window;
        const std::string place =
            window ? "window at " + std::to_string(channel.display.windowPosition.x) + ", " +
                         std::to_string(channel.display.windowPosition.y)
                   : "fullscreen on monitor " + std::to_string(channel.display.monitor);
        std::printf("channel %u \"%s\": %d x %d pixels, %s, device %s\n",
                    channel.id,
                    channel.name.c_str(),
                    channel.sizePixels.x,
                    channel.sizePixels.y,
                    place.c_str(),
                    channel.display.device.c_str());
    }
}

int run(int argc, char** argv) {
    CLI::App app("Checks a rig and composes what its projectors show.", "aquarama-calibrate");
    app.require_subcommand(1);
    std::string path;
    std::string folder;
    bool deep = false;

    CLI::App* checkCommand =
        app.add_subcommand("check",
                           "Validate a rig and say what its projectors light; or a scene or a "
                           "species, and say what is in it");
    checkCommand->add_option("FILE", path, "such as config/desk.txtpb")->required();
    checkCommand->callback([&] { check(path); });

    CLI::App* composeCommand = app.add_subcommand(
        "compose", "Make DIR/panorama.png and DIR/hall.png from DIR/channel-NAME.png");
    composeCommand->add_option("RIG", path, "Rig file that the pictures were taken with")
        ->required();
    composeCommand->add_option("DIR", folder, "Folder of the pictures")->required();
    composeCommand->add_flag("--deep", deep, "Write 16 bits instead of 8");
    composeCommand->callback([&] { composeSnapshot(checkedRig(path), folder, deep ? 16 : 8); });

    Filming filming;
    CLI::App* clipCommand = app.add_subcommand(
        "clip", "Make FILE.mp4 or FILE.webp of the frames that running nodes send (--film)");
    clipCommand->add_option("RIG", path, "Rig file that is shown")->required();
    clipCommand->add_option("FILE", filming.clipPath, "The clip")->required();
    clipCommand->add_option("--pipes", filming.pipes, "Folder of the nodes' named pipes")
        ->required();
    clipCommand->add_option("--of", filming.of, "panorama, hall or a channel's name");
    clipCommand->add_option("--every", filming.ticksBetween, "Frames of the show to one picture")
        ->check(CLI::Range(1, 10000));
    clipCommand->callback([&] { film(checkedRig(path), filming); });

    CLI::App* inspectCommand = app.add_subcommand("inspect", "Say what a rig file holds");
    inspectCommand->add_option("FILE", path, "Rig file")->required();
    inspectCommand->callback([&] { inspect(path); });

    CLI11_PARSE(app, argc, argv);
    return 0;
}

}  // namespace
}  // namespace aquarama

int main(int argc, char** argv) {
    try {
        return aquarama::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
