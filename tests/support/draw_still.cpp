// SPDX-License-Identifier: Apache-2.0
// Draws one still of the sea to a PNG: for documents, and for looking. See --help.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "common/base/picture.h"
#include "render_node/gl/context.h"
#include "tests/support/still.h"

namespace {

using namespace aquarama;

struct Options {
    std::vector<float> eye{0.0F, -6.0F, 0.0F};
    std::vector<std::string> portraits;
    float metresAway = 0.7F, turnDegrees = 0.0F, lengthMetres = 0.24F, phase = 0.1F, speed = 0.8F,
          spread = 0.0F, mouth = 0.0F, gazeDegrees = 0.0F;
    int ball = 0;
    float ballMetres = 6.0F;
    std::string tier = "ultra", water = "IA", out = "still.png";
    std::vector<std::string> drawings;
    bool plate = false;
    bool openSea = false;
};

// The whole cast at its true size, for docs/look.md: where each swims, metres right and up.
struct Placed {
    const char* species;
    float lengthMetres;
    glm::vec2 at;
};
constexpr float kPlateMetres = 2.1F;
constexpr Placed kPlate[]{{"blacktip_reef_shark", 1.30F, {-0.10F, 0.46F}},
                          {"trumpetfish", 0.50F, {-0.85F, 0.12F}},
                          {"parrotfish", 0.32F, {-0.22F, 0.08F}},
                          {"moorish_idol", 0.18F, {0.34F, 0.12F}},
                          {"moorish_idol", 0.17F, {0.66F, 0.02F}},
                          {"blue_tang", 0.22F, {-0.85F, -0.24F}},
                          {"blue_tang", 0.24F, {-0.50F, -0.36F}},
                          {"bigeye_scad", 0.24F, {0.02F, -0.24F}},
                          {"bigeye_scad", 0.23F, {0.36F, -0.22F}},
                          {"bigeye_scad", 0.25F, {0.24F, -0.40F}},
                          {"bigeye_scad", 0.24F, {0.66F, -0.32F}},
                          {"clownfish", 0.10F, {-0.20F, -0.52F}},
                          {"clownfish", 0.08F, {-0.02F, -0.57F}}};

void addPlate(test::Still& still) {
    const glm::vec3 centre =
        test::portraitOf("clownfish", still.camera, kPlateMetres, 0, 1).placeMetres;
    const glm::vec3 ahead = (centre - still.camera.eyeMetres) / kPlateMetres;
    const glm::vec3 right = glm::cross(ahead, glm::vec3{0, 1, 0});
    for (const Placed& one : kPlate) {
        still.fish.push_back(
            test::portraitOf(one.species, still.camera, kPlateMetres, 8, one.lengthMetres));
        still.fish.back().placeMetres += one.at.x * right + glm::vec3{0, one.at.y, 0};
    }
}

test::Still stillOf(const Options& options, test::Still still) {
    still.camera.eyeMetres = {options.eye.at(0), options.eye.at(1), options.eye.at(2)};
    if (options.openSea) still.options.place.kind = config::PlaceKind::OpenSea;
    const auto tier = std::ranges::find(config::kTierNames, options.tier);
    still.options.quality = static_cast<config::QualityTier>(tier - config::kTierNames.begin());
    const auto water = std::ranges::find(config::kWaterTypeNames, options.water);
    still.options.water = static_cast<config::WaterType>(water - config::kWaterTypeNames.begin());
    if (options.plate) addPlate(still);
    // Side by side, the first in the middle.
    test::Camera camera = still.camera;
    std::size_t portrait = 0;
    for (const std::string& species : options.portraits) {
        still.fish.push_back(test::portraitOf(
            species, camera, options.metresAway, options.turnDegrees, options.lengthMetres));
        still.fish.back().phase = options.phase;
        still.fish.back().speedBodyLengths = options.speed;
        still.fish.back().spread = options.spread;
        still.fish.back().mouth = options.mouth;
        still.fish.back().gazeDegrees = options.gazeDegrees;
        if (portrait < options.drawings.size())
            still.fish.back().drawing = options.drawings[portrait];
        ++portrait;
        camera.azimuthDegrees += 60.0F * options.lengthMetres / options.metresAway;
    }
    test::Camera ahead = still.camera;
    const glm::vec3 centre =
        test::portraitOf("bigeye_scad", ahead, options.ballMetres, 0.0F, 0.24F).placeMetres;
    for (test::StillFish& fish : test::ballOf("bigeye_scad", options.ball, centre, 1.6F))
        still.fish.push_back(std::move(fish));
    return still;
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app{"Draws one still of the sea to a PNG."};
    Options options;
    test::Still still;
    still.camera.sizePixels = {960, 540};
    app.add_option("--eye", options.eye, "x y z, metres")->expected(3);
    app.add_option("--azimuth", still.camera.azimuthDegrees, "degrees to the right of -z");
    app.add_option("--elevation", still.camera.elevationDegrees, "degrees up");
    app.add_option("--fov", still.camera.heightDegrees, "degrees, vertical");
    app.add_option("--width", still.camera.sizePixels.x, "pixels");
    app.add_option("--height", still.camera.sizePixels.y, "pixels");
    app.add_option("--time", still.timeSeconds, "seconds");
    app.add_option("--daylight", still.daylight, "1 noon .. 0 night");
    app.add_option("--time-of-day", still.timeOfDay, "0 midnight, 0.5 noon, 1 midnight");
    app.add_option("--seed", still.options.place.seed, "of the place");
    app.add_option("--quality", options.tier, "tier")
        ->check(CLI::IsMember({"low", "medium", "high", "ultra"}));
    app.add_option("--colour", still.colourReturned, "share that is given back, 0 .. 1");
    app.add_option("--water", options.water, "Jerlov's type")
        ->check(CLI::IsMember({"I", "IA", "IB", "II", "III", "1C", "3C"}));
    app.add_option("--portrait", options.portraits, "species before the camera");
    app.add_option("--away", options.metresAway, "of the portraits, metres");
    app.add_option("--turn", options.turnDegrees, "0 left side, 90 face, 180 right side");
    app.add_option("--length", options.lengthMetres, "of the portraits, metres");
    app.add_option("--phase", options.phase, "of the portraits' beat, 0 .. 1");
    app.add_option("--speed", options.speed, "of the portraits, body lengths a second");
    app.add_option("--brake", options.spread, "of the portraits, 0 .. 1");
    app.add_option("--mouth", options.mouth, "of the portraits, 0 shut .. 1 wide open");
    app.add_option("--gaze", options.gazeDegrees, "of the portraits, degrees to the right");
    app.add_option("--drawing", options.drawings, "PNG that a portrait wears, the first first");
    app.add_option("--ball", options.ball, "so many scad in a ball");
    app.add_option("--ball-away", options.ballMetres, "metres");
    app.add_flag_callback(
        "--no-lod", [&] { still.options.levelsOfDetail = false; }, "all fish are heroes");
    app.add_flag("--plate", options.plate, "the whole cast at its true size, 2 m away");
    app.add_flag("--open-sea", options.openSea, "no floor");
    app.add_option("--out", options.out, "PNG file");
    CLI11_PARSE(app, argc, argv);
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    writePng(options.out, test::pictureOf(stillOf(options, still)));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "aquarama_draw_still: %s\n", error.what());
    return 1;
}
