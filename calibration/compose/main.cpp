// SPDX-License-Identifier: Apache-2.0
// aquarama-compose: checks a rig, says what it does, and composes what its projectors show.
#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "calibration/compose/check.h"
#include "calibration/compose/compose.h"
#include "calibration/compose/film.h"
#include "calibration/compose/join.h"
#include "calibration/compose/simulated_view.h"
#include "common/base/counted.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "common/cli/commands.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/config/text_file.h"
#include "common/wall/wall.h"

namespace aquarama {
namespace {

// Throws Error for a mistake in the file, or for a projector that misses the screen.
config::Rig checkedRig(const std::string& text, const std::string& path) {
    config::Rig rig = config::parseRig(text, path);
    config::readRigFiles(rig, path);
    wall::checkGeometry(rig, path);
    return rig;
}

// Throws Error as checkedRig() does, and where the file cannot be read.
config::Rig readCheckedRig(const std::string& path) {
    return checkedRig(config::readTextFile(path), path);
}

// How much the rig's file of adjustments holds.
std::string byHand(const config::Adjustments& adjustments) {
    return fmt::format("by hand: {} control points, {} masks, {} limits of blends",
                       adjustments.points.size(),
                       adjustments.masks.size(),
                       adjustments.blends.size());
}

// Says what each channel lights; checks the scene that the rig shows as well.
void checkRig(const config::Rig& rig, const std::string& path) {
    const wall::Wall wall(rig);
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        cli::say(compose::oneLine(compose::surveyChannel(rig, wall, i)));
    const double dark = wall::darkShare(wall);
    if (dark > 0) cli::say(fmt::format("dark: {:.1f} % of the screen", 100 * dark));
    if (!rig.adjustments.empty()) cli::say(byHand(wall.adjustments()));
    const bool blendsItself = std::ranges::none_of(
        rig.channels, [](const config::Channel& channel) { return channel.wallFile.has_value(); });
    const double worst = compose::worstBlendSum(wall);
    if (blendsItself && worst > 1e-6)
        throw Error(path + ": the channels' shares of light do not sum to one");
    const std::string scene = config::scenePathOf(rig, path);
    (void)compose::inventoryOf(config::readScene(scene), scene);
    cli::say(fmt::format("{}: good; the {} sum to one within {:.0e}",
                         path,
                         blendsItself ? "channels' shares of light" : "blends of its wall files",
                         worst));
}

// A rig, a scene or a species, whichever the file holds; `showRig` is called for a rig.
void show(const std::string& path, void (*showRig)(const config::Rig&, const std::string&)) {
    const std::string text = config::readTextFile(path);
    switch (config::fileKindOf(text)) {
        case config::FileKind::Rig:
            return showRig(checkedRig(text, path), path);
        case config::FileKind::Scene:
            return cli::say(compose::inventoryOf(config::parseScene(text, path), path));
        case config::FileKind::Species:
            return cli::say(compose::inventoryOf(config::parseSpecies(text, path), path));
    }
}

// All of them; `program` begins each error. Returns the exit status.
int checkAll(const std::string& program, const std::vector<std::string>& paths) {
    int status = 0;
    for (const std::string& path : paths) {
        try {
            show(path, checkRig);
        } catch (const Error& error) {
            cli::sayError(program + " check", error.what());
            status = 1;
        }
    }
    return status;
}

// Lengths in metres, angles in degrees.
std::string textOf(const config::Screen& screen) {
    const double degrees = screen.arcRadians / kRadiansPerDegree<double>;
    const std::string tilt = screen.tiltRadians == 0
                                 ? ""
                                 : fmt::format(", tilted {:.1f} degrees",
                                               screen.tiltRadians / kRadiansPerDegree<double>);
    switch (screen.shape) {
        case config::ScreenShape::Cylinder:
            return fmt::format("radius {:.3f} m, {:.1f} degrees ({:.3f} m of arc), {:.3f} m high",
                               screen.radiusMetres,
                               degrees,
                               screen.arcRadians * screen.radiusMetres,
                               screen.heightMetres) +
                   tilt;
        case config::ScreenShape::Flat:
            return fmt::format("flat, {:.3f} x {:.3f} m, {:.3f} m away",
                               screen.widthMetres,
                               screen.heightMetres,
                               screen.distanceMetres) +
                   tilt;
        case config::ScreenShape::Dome:
            return fmt::format(
                       "dome, radius {:.3f} m, {:.1f} degrees open", screen.radiusMetres, degrees) +
                   tilt;
        case config::ScreenShape::Measured:
            return "measured, " + screen.meshFile;
        case config::ScreenShape::Panels:
            return "panels";
    }
    return {};
}

std::string placeOf(const config::Display& display) {
    if (display.mode == config::DisplayMode::Window)
        return "window at " + std::to_string(display.windowPosition.x) + ", " +
               std::to_string(display.windowPosition.y);
    return "fullscreen on " +
           (display.connector.empty() ? "the only monitor" : "monitor " + display.connector);
}

// Says what the file holds, without any geometry of the wall. show() wants the path, which is not
// used.
void inspectRig(const config::Rig& rig, const std::string& /*path*/) {
    cli::say(fmt::format("rig \"{}\": {}", rig.name, counted(rig.channels.size(), "channel")));
    cli::say("scene: " + rig.scene);
    cli::say("screen: " + textOf(rig.screen));
    cli::say(fmt::format("panorama: {} x {} pixels", rig.panoramaPixels.x, rig.panoramaPixels.y));
    if (rig.stereo.mode != config::StereoMode::Mono)
        cli::say(fmt::format("stereo: {}, eyes {:.0f} mm apart",
                             config::nameOf(rig.stereo.mode),
                             1000 * rig.stereo.eyeSeparationMetres));
    cli::say(fmt::format("addresses: control {}, state {}", rig.controlAddress, rig.stateAddress));
    cli::say(fmt::format("timing: {:g} Hz, present deadline {:g} s, membership {:g} s",
                         rig.timing.refreshHertz,
                         rig.timing.presentDeadlineSeconds,
                         rig.timing.membershipSeconds));
    for (const config::Channel& channel : rig.channels)
        cli::say(fmt::format("channel {} \"{}\": {} x {} pixels, {}, device {}",
                             channel.id,
                             channel.name,
                             channel.sizePixels.x,
                             channel.sizePixels.y,
                             placeOf(channel.display),
                             channel.display.device));
}

// Options of `compose` and `clip`.
struct Composition {
    std::string rig;
    std::string folder;
    bool deep = false;
    bool keepPanorama = false;
};

struct Clip {
    std::string rig;
    compose::Filming filming;
};

void addCompose(cli::CommandLine& line) {
    const auto [command, options] =
        line.add<Composition>("compose",
                              "make DIR/panorama.png and DIR/hall.png from DIR/channel-NAME.png",
                              [](const Composition& chosen) {
                                  compose::composeSnapshot(readCheckedRig(chosen.rig),
                                                           chosen.folder,
                                                           chosen.deep ? 16 : 8,
                                                           chosen.keepPanorama);
                              });
    command.add_option("RIG", options.rig, "rig file that the pictures were taken with")
        ->required();
    command.add_option("DIR", options.folder, "folder of the pictures")->required();
    command.add_flag("--deep", options.deep, "write 16 bits instead of 8");
    command.add_flag(
        "--keep-panorama", options.keepPanorama, "leave the panorama.png that is there");
}

void addEncode(cli::CommandLine& line) {
    const auto [command, options] = line.add<compose::SentPictures>(
        "encode",
        "make FILE.mp4 or FILE.webp of the pictures that a program sends",
        compose::encode);
    command.add_option("FILE", options.clipPath, "the clip")->required();
    command.add_option("--pipe", options.pipe, "the socket by which they come")->required();
    command.add_option("--every", options.ticksBetween, "sixtieths of a second to one picture")
        ->check(cli::wholeNumber(1, 10000));
}

void addClip(cli::CommandLine& line) {
    const auto [command, options] = line.add<Clip>(
        "clip",
        "make FILE.mp4 or FILE.webp of the frames that running nodes send (--film)",
        [](const Clip& chosen) { compose::film(readCheckedRig(chosen.rig), chosen.filming); });
    command.add_option("RIG", options.rig, "rig file that is shown")->required();
    command.add_option("FILE", options.filming.clipPath, "the clip")->required();
    command
        .add_option("--pipes",
                    options.filming.pipes,
                    "folder of the sockets by which the nodes send frames")
        ->required();
    command.add_option("--of", options.filming.of, "panorama, hall or a channel's name");
    command
        .add_option("--every", options.filming.ticksBetween, "frames of the show to one picture")
        ->check(cli::wholeNumber(1, 10000));
    command
        .add_option("--frames",
                    options.filming.frames,
                    "how many frames the show has, to say how long it takes")
        ->check(cli::wholeNumber(1, cli::kMostShownFrames));
    command.add_option("--from-frame",
                       options.filming.fromFrame,
                       "the frame of the film at which this part of it begins");
    command.add_option("--first",
                       options.filming.firstPictures,
                       "folder for panorama.png and hall.png of the first frame, at once");
}

void addJoin(cli::CommandLine& line) {
    const auto [command, options] = line.add<compose::JoinedClips>(
        "join",
        "make FILE.mp4 of clips, one behind the other, without encoding again",
        compose::join);
    command.add_option("FILE", options.out, "the whole clip")->required();
    command.add_option("CLIP", options.clips, "the clips, in order")->required();
    command.add_option("--every", options.ticksBetween, "sixtieths of a second to one picture")
        ->check(cli::wholeNumber(1, 10000));
}

void drawView(const compose::SimulatedView& view) {
    cli::requireFile("--out", view.outPath);
    compose::drawView(view);
}

void addView(cli::CommandLine& line) {
    const auto [command, options] = line.add<compose::SimulatedView>(
        "view", "what an eye in the hall or a camera sees of the channels' pictures", drawView);
    command.add_option("RIG", options.rigPath, "the rig")->required();
    command
        .add_option("--frame",
                    options.folder,
                    "folder of channel-NAME.png, as run --snapshot writes them, or of a "
                    "panorama.png to be drawn")
        ->required();
    command.add_option("--wall",
                       options.wallPath,
                       "wall file by which a panorama is drawn and, without --hall, how the "
                       "projectors hang");
    command.add_option("--hall",
                       options.hall,
                       "how projectors and screen truly are: a simulated hall's file or "
                       "random:SEED; instead of as the rig says");
    command.add_option("--view", options.view, "hall: an eye at the back; or camera")
        ->required()
        ->check(CLI::IsMember({"hall", "camera"}));
    command.add_option("--out", options.outPath, "the picture (.png)")->required();
}

struct Files {
    std::vector<std::string> paths;
};

void addCheck(cli::CommandLine& line, const CLI::App& program) {
    const auto [command, options] = line.add<Files>(
        "check",
        "validate rigs and say what their projectors light; or scenes or "
        "species, and say what is in them",
        [&program](const Files& files) { return checkAll(program.get_name(), files.paths); });
    command
        .add_option("FILE", options.paths, "such as config/desk.txtpb; several are checked in turn")
        ->required();
}

struct InspectedFile {
    std::string path;
};

void addInspect(cli::CommandLine& line) {
    const auto [command, options] = line.add<InspectedFile>(
        "inspect", "say what a rig, a scene or a species holds", [](const InspectedFile& file) {
            show(file.path, inspectRig);
        });
    command.add_option("FILE", options.path, "a rig, a scene or a species")->required();
}

}  // namespace
}  // namespace aquarama

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app("Checks a rig and composes what its projectors show.", "aquarama-compose");
    app.require_subcommand(1);
    cli::CommandLine line(app);
    addCheck(line, app);
    addCompose(line);
    addClip(line);
    addEncode(line);
    addJoin(line);
    addView(line);
    addInspect(line);
    return cli::runProgram(app, count, arguments, [&] { return line.runChosen(); });
}
