// SPDX-License-Identifier: Apache-2.0
// Simulated halls are calibrated from the pictures of their camera, and held to the truth. With
// AQUARAMA_SOAK at full size and in numbers.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "calibration/geometry/solve.h"
#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/hall/true_hall.h"
#include "calibration/light/seams.h"
#include "calibration/result/figures.h"
#include "calibration/result/wall_of.h"
#include "calibration/scan/decode.h"
#include "calibration/scan/pictures.h"
#include "common/base/statistics.h"
#include "common/formats/mpcdi.h"

namespace aquarama::result {
namespace {

bool isSoak() {
    return std::getenv("AQUARAMA_SOAK") != nullptr;
}

// What the solve says, and what is true.
struct Outcome {
    Figures figures;
    WallErrors errors;
    light::Seams seams;
};

Outcome calibrated(const config::Rig& rig, const config::Hall& hall, bool measuresSeams = false) {
    const hall::TrueHall truth(rig, hall);
    hall::SimulatedCamera camera(truth, scan::sequenceOf(rig));
    const std::vector<scan::CameraView> views{scan::decode(camera, 0, rig)};
    const wall::Wall wall(rig);
    const geometry::Solved solved =
        geometry::solveHall(rig, wall, views, [](const std::string&) {});
    Outcome outcome{.figures = {.verdict = judged(views, solved), .solve = solved.figures},
                    .errors = {},
                    .seams = {}};
    if (outcome.figures.verdict.judgement == Judgement::Refuse) return outcome;
    constexpr std::size_t kPoints = 10000;
    const ShadedWall shaded = shadedWallOf(*solved.hall, views.front());
    outcome.figures.verdict = judgedLight(outcome.figures.verdict, shaded.brightness, shaded.seams);
    outcome.figures.brightness = shaded.brightness;
    outcome.figures.foreseen = shaded.seams;
    outcome.errors = errorsOf(truth, rig, shaded.file, kPoints);
    if (!measuresSeams) return outcome;
    const std::string path = testing::TempDir() + "aquarama-calibration.mpcdi";
    formats::writeMpcdi(path, shaded.file, 2);
    outcome.seams = light::seamsOf(truth, hall::DrawnWall(hall::withWallFile(rig, path)));
    return outcome;
}

void print(const std::string& what, const Outcome& outcome) {
    const WallErrors& errors = outcome.errors;
    std::printf(
        "%s: %s %s; overlap RMS %.3f, 95 %% %.3f, most %.3f of %zu; absolute RMS %.3f, "
        "most %.3f panorama px; seams %.2f, %.2f and %.2f %% at 2, 18 and 100 %% grey, CIEDE2000 "
        "%.2f\n",
        what.c_str(),
        nameOf(outcome.figures.verdict.judgement),
        outcome.figures.verdict.cause.c_str(),
        rootMeanSquare(errors.overlap),
        quantile(errors.overlap, 0.95),
        quantile(errors.overlap, 1),
        errors.overlap.size(),
        rootMeanSquare(errors.absolute),
        quantile(errors.absolute, 1),
        100 * outcome.seams.grey2,
        100 * outcome.seams.grey18,
        100 * outcome.seams.grey100,
        outcome.seams.colour);
    std::fflush(stdout);
}

bool isWithinBounds(const WallErrors& errors) {
    return rootMeanSquare(errors.overlap) <= 0.2 && quantile(errors.overlap, 0.95) <= 0.45 &&
           quantile(errors.overlap, 1) <= 1.0 && rootMeanSquare(errors.absolute) <= 1.0;
}

TEST(Calibration, ofRandomHallsIsWithinItsBounds) {
    const double scale = isSoak() ? 1 : 0.25;
    const std::uint32_t rigs = isSoak() ? 20 : 6;
    for (std::uint32_t seed = 1; seed <= rigs; ++seed) {
        const config::Rig rig = hall::randomRig(seed, scale);
        const Outcome outcome = calibrated(rig, hall::randomHall(rig, seed, scale), true);
        print("rig " + std::to_string(seed), outcome);
        // At full size a pixel is a millimetre or two: one rig is within the bounds and warned of.
        const bool isUnsure = isSoak() && outcome.figures.verdict.cause == "place_not_sure";
        EXPECT_TRUE(outcome.figures.verdict.judgement == Judgement::Pass || isUnsure)
            << "rig " << seed << ": " << outcome.figures.verdict.cause;
        EXPECT_GT(outcome.errors.overlap.size(), 500U);
        EXPECT_TRUE(isWithinBounds(outcome.errors)) << "rig " << seed;
        const bool hasLight = outcome.figures.brightness && outcome.figures.foreseen;
        EXPECT_TRUE(hasLight) << "rig " << seed;
        if (!hasLight) continue;
        EXPECT_GT(outcome.figures.brightness->keptLight, 0.7) << "rig " << seed;
        EXPECT_LE(outcome.seams.grey18, 0.01) << "rig " << seed;
        EXPECT_LE(outcome.seams.grey100, 0.01) << "rig " << seed;
        EXPECT_LE(outcome.seams.colour, 0.7) << "rig " << seed;
        EXPECT_LE(outcome.seams.grey2, 0.03) << "rig " << seed;
        EXPECT_NEAR(outcome.figures.foreseen->grey18, outcome.seams.grey18, 0.004);
        EXPECT_NEAR(outcome.figures.foreseen->grey100, outcome.seams.grey100, 0.004);
    }
}

// Of channels that hang apart; each is a position along x, and the angle that it is turned by.
config::Rig rigOf(const std::string& screen,
                  glm::ivec2 panorama,
                  glm::ivec2 pixels,
                  const std::vector<std::string>& projectors) {
    std::string text =
        "name: \"alone\" screen { " + screen +
        " } panorama { width_px: " + std::to_string(panorama.x) +
        " height_px: " + std::to_string(panorama.y) +
        " } network { control: \"tcp://127.0.0.1:1\" state: \"tcp://127.0.0.1:2\" } timing { "
        "refresh_hz: 60 present_deadline_s: 2 membership_s: 5 } scene: \"reef.txtpb\"\n";
    for (std::size_t i = 0; i < projectors.size(); ++i) {
        const std::string id = std::to_string(i);
        text += "channels { id: " + id + " name: \"channel" + id +
                "\" width_px: " + std::to_string(pixels.x) +
                " height_px: " + std::to_string(pixels.y) + " projector { " + projectors[i] +
                " } display { mode: WINDOW window_x_px: 0 window_y_px: 0 } }\n";
    }
    return config::parseRig(text, "alone.txtpb");
}

const std::string kFlat = "flat { width_m: 4 height_m: 2.25 distance_m: 3 }";
const std::string kBefore =
    "position { x_m: 0 y_m: 1.4 z_m: 1.08 } focal_x_px: 480 focal_y_px: 480 principal_y_px: -32";
const std::string kSmall =
    "position { x_m: 0 y_m: 1.4 z_m: 1.08 } focal_x_px: 320 focal_y_px: 320 principal_y_px: -21";
constexpr double kHallScale = 0.15;

// Nothing of overlap is asked of a rig that has none: one channel, or two that hang apart.
TEST(Calibration, ofChannelsWithoutNeighboursIsWithinItsBounds) {
    const std::string lens = " y_m: 0 z_m: 0 } focal_x_px: 960 focal_y_px: 960 principal_y_px: 135";
    for (const config::Rig& rig :
         {rigOf(kFlat, {600, 338}, {480, 270}, {kBefore}),
          rigOf(kFlat,
                {600, 338},
                {480, 270},
                {"position { x_m: -1.2" + lens, "position { x_m: 1.2" + lens})}) {
        const Outcome outcome = calibrated(rig, hall::randomHall(rig, 7, kHallScale));
        print("alone", outcome);
        EXPECT_EQ(outcome.figures.verdict.judgement, Judgement::Pass)
            << outcome.figures.verdict.cause;
        EXPECT_EQ(outcome.figures.overlap().points, 0U);
        EXPECT_TRUE(outcome.errors.overlap.empty());
        EXPECT_LE(rootMeanSquare(outcome.errors.absolute), 1);
        EXPECT_TRUE(outcome.figures.brightness && outcome.figures.foreseen);
        EXPECT_NE(jsonOf(outcome.figures).find("\"overlap_rms_px\": null"), std::string::npos);
    }
}

// A dome's round edge does not tell all, and no neighbour checks it.
TEST(Calibration, ofADomeOfOneChannelIsWarnedOf) {
    const config::Rig rig =
        rigOf("dome { radius_m: 3 opening_deg: 80 } tilt_deg: 90",
              {300, 300},
              {320, 180},
              {"position { x_m: 0 y_m: 0 z_m: 0.3 } focal_x_px: 93 focal_y_px: 93"});
    const Outcome outcome = calibrated(rig, hall::randomHall(rig, 7, kHallScale));
    print("dome", outcome);
    EXPECT_EQ(outcome.figures.verdict.judgement, Judgement::Warn);
    EXPECT_EQ(outcome.figures.verdict.cause, "place_not_checked");
}

// As the guide says: Gray codes of OpenCV with their inverses, white and black, by their names.
TEST(Calibration, ofOneChannelTakesGrayCodesOfOpenCv) {
    const config::Rig rig = rigOf(kFlat, {600, 338}, {320, 180}, {kSmall});
    std::vector<config::ScanPattern> sequence;
    for (const auto kind :
         {config::ScanPattern::Kind::GrayColumns, config::ScanPattern::Kind::GrayRows})
        for (std::uint8_t step = 0; step < (kind == config::ScanPattern::Kind::GrayColumns ? 9 : 8);
             ++step)
            for (const bool inverse : {false, true})
                sequence.push_back({.kind = kind,
                                    .step = step,
                                    .finestPixels = 1,
                                    .inverse = inverse,
                                    .lit = 1,
                                    .tagged = false});
    sequence.push_back({.lit = 1, .tagged = false});
    sequence.push_back({.light = glm::vec3(0), .lit = 0, .tagged = false});
    const hall::TrueHall truth(rig, hall::randomHall(rig, 7, kHallScale));
    hall::SimulatedCamera camera(truth, sequence);
    const std::string folder = testing::TempDir() + "aquarama-gray codes";
    scan::writeFolder(camera, folder, rig);
    std::filesystem::remove(folder + "/scan.txtpb");
    const auto source = scan::openFolder(folder, rig);
    const std::vector<scan::CameraView> views{scan::decode(*source, 0, rig)};
    const wall::Wall wall(rig);
    const geometry::Solved solved =
        geometry::solveHall(rig, wall, views, [](const std::string&) {});
    const CalibrationVerdict verdict = judged(views, solved);
    EXPECT_EQ(verdict.cause, "outline_not_seen") << "no picture of the room";
    ASSERT_EQ(verdict.judgement, Judgement::Warn) << verdict.cause << ": " << verdict.advice;
    EXPECT_LT(solved.figures.fitRms, 0.3) << "pixels of the projector";
    std::filesystem::remove_all(folder);
}

// What the windows of a scan would tell, but for what goes wrong in decoding it: a scan at full
// size takes minutes.
std::vector<geometry::Tie> exactTies(const hall::TrueHall& truth) {
    constexpr int kWindow = 55;  // pixels of the camera
    constexpr double kNoise = 0.02;
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, kNoise);
    const glm::ivec2 windows = truth.hall().camera.sizePixels / kWindow;
    std::vector<geometry::Tie> ties;
    for (int i = 0; i < windows.x * windows.y; ++i) {
        const glm::ivec2 at(i % windows.x, i / windows.x);
        const glm::dvec2 seen = (glm::dvec2(at) + 0.5) * double{kWindow};
        const auto point = truth.pointSeen(seen);
        for (std::uint32_t channel = 0; point && channel < truth.channels(); ++channel)
            if (const auto place = truth.pixelOf(channel, *point))
                ties.push_back({.camera = 0,
                                .channel = channel,
                                .seen = seen,
                                .place = *place + glm::dvec2(normal(random), normal(random)),
                                .sigma = kNoise,
                                .heldOut = (at.x + 2 * at.y) % 5 == 0,
                                .window = static_cast<std::uint32_t>(i)});
    }
    return ties;
}

// How far the picture lies from where it belongs, in panorama pixels, and whether the solve warns.
struct PlaceOutcome {
    double absolute = 0;
    bool warns = false;
};
PlaceOutcome placed(const config::Rig& rig, const config::Hall& hall) {
    const hall::TrueHall truth(rig, hall);
    hall::SimulatedCamera camera(truth, {{.kind = config::ScanPattern::Kind::Room}});
    std::vector<scan::CameraView> views(1);
    views[0].sizePixels = hall.camera.sizePixels;
    views[0].room = scan::lightOf(camera.picture(0), camera.scan().cameras.front().response);
    const wall::Wall wall(rig);
    const geometry::Solved solved =
        geometry::solveTies(rig, wall, views, exactTies(truth), [](const std::string&) {});
    std::vector<double> errors;
    for (const glm::dvec3& point : truth.screenPoints(2000)) {
        const auto pixel = truth.cameraPixelOf(point);
        const auto place = pixel ? solved.hall->placeSeen(0, *pixel) : std::nullopt;
        const glm::dvec2 belongs = truth.unrolled(point) * glm::dvec2(rig.panoramaPixels);
        if (place && !std::isnan(belongs.x))
            errors.push_back(glm::distance(solved.hall->panoramaPixel(place->point), belongs));
    }
    EXPECT_GT(errors.size(), 1000U);
    return {rootMeanSquare(errors), judged(views, solved).judgement != Judgement::Pass};
}

// At full size, where a pixel of the panorama is about a millimetre. Without the crew's tape a
// picture may be off, but the solve says so.
TEST(Calibration, knowsWhereThePictureIsByTheMarksOnTheScreen) {
    std::vector<std::uint32_t> seeds{1, 3, 4};  // a dome, a flat wall, a cylinder
    if (isSoak()) {
        seeds.resize(20);
        std::iota(seeds.begin(), seeds.end(), 1U);
    }
    int beyond = 0;
    for (const std::uint32_t seed : seeds) {
        const config::Rig rig = hall::randomRig(seed, 1);
        config::Hall hall = hall::randomHall(rig, seed, 1);
        const PlaceOutcome marked = placed(rig, hall);
        hall.screen.marksOffMetres.clear();
        const PlaceOutcome bare = placed(rig, hall);
        std::printf("rig %u: absolute RMS %.3f panorama px%s; without marks %.3f%s\n",
                    seed,
                    marked.absolute,
                    marked.warns ? ", warned of" : "",
                    bare.absolute,
                    bare.warns ? ", warned of" : "");
        std::fflush(stdout);
        // One of twenty is at 1.01, and warned of: docs/appendices/calibration.md.
        EXPECT_TRUE(marked.absolute <= 1.0 || marked.warns) << "rig " << seed;
        beyond += marked.absolute > 1.0 ? 1 : 0;
        EXPECT_TRUE(bare.absolute <= 1.0 || bare.warns) << "rig " << seed;
    }
    EXPECT_LE(beyond, isSoak() ? 1 : 0);
}

// Each is refused or warned of, or solved within the bounds.
TEST(Calibration, passesNoHallWithAFaultThatItDoesNotSolve) {
    // Swapped cables; of 18 the camera sees next to nothing, the projector of 66 moves behind its
    // own patterns, and 165 is a dome with a stretched picture.
    std::vector<std::uint32_t> draws{2, 18, 66, 165};
    if (isSoak()) {
        draws.resize(200);
        std::iota(draws.begin(), draws.end(), 0U);
    }
    for (const std::uint32_t draw : draws) {
        const std::size_t kind = draw % hall::kHallFaultNames.size();
        const config::Rig rig = hall::randomRig(100 + draw, 0.25);
        const config::Hall hall = hall::withFault(rig,
                                                  hall::randomHall(rig, 100 + draw, 0.25),
                                                  static_cast<hall::HallFault>(kind),
                                                  draw,
                                                  scan::sequenceOf(rig).size());
        const std::string what =
            std::string(hall::kHallFaultNames.at(kind)) + " " + std::to_string(draw);
        const Outcome outcome = calibrated(rig, hall);
        print(what, outcome);
        const bool isNamed =
            !outcome.figures.verdict.cause.empty() && !outcome.figures.verdict.advice.empty();
        EXPECT_TRUE(outcome.figures.verdict.judgement == Judgement::Pass || isNamed) << what;
        const bool isFalse =
            outcome.figures.verdict.judgement == Judgement::Pass && !isWithinBounds(outcome.errors);
        EXPECT_FALSE(isFalse) << what << " is a false accept";
    }
}

}  // namespace
}  // namespace aquarama::result
