// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/decode.h"

#include <gmock/gmock.h>

#include "common/base/log.h"
#include "tests/calibration/scan/synthetic_camera.h"

namespace aquarama::scan {
namespace {

using Kind = config::ScanPattern::Kind;

config::Rig touring() {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/touring.txtpb");
}
config::Rig oneChannel() {
    config::Rig rig = touring();
    rig.channels = {rig.channels[1]};
    return rig;
}

struct Errors {
    int valid = 0, inside = 0, wrong = 0;
    double chiSquare = 0, averagedRms = 0;
};

// Errors of places, singly and of the mean over 5 x 5 pixels.
Errors errorsOf(const SyntheticCamera& camera, const CameraView& view, glm::ivec2 channelPixels) {
    Errors errors;
    const glm::ivec2 size = view.sizePixels;
    const auto errorAt = [&](int x, int y) {
        const glm::vec2 place = view.channels[0].place[static_cast<std::size_t>(y * size.x + x)];
        return glm::dvec2(place) - camera.placeAt(0, glm::dvec2(x, y) + 0.5);
    };
    double averages = 0;
    for (int y = 2; y + 2 < size.y; ++y)
        for (int x = 2; x + 2 < size.x; ++x) {
            const glm::dvec2 truth = camera.placeAt(0, glm::dvec2(x, y) + 0.5);
            const bool inside = truth.x > 0 && truth.y > 0 && truth.x < channelPixels.x && truth.y < channelPixels.y;
            errors.inside += inside ? 1 : 0;
            const glm::dvec2 error = errorAt(x, y);
            if (std::isnan(error.x)) continue;
            ++errors.valid;
            const glm::dvec2 sigma(view.channels[0].sigma[static_cast<std::size_t>(y * size.x + x)]);
            errors.chiSquare += 0.5 * (error.x * error.x / sigma.x / sigma.x + error.y * error.y / sigma.y / sigma.y);
            if (std::max(std::abs(error.x), std::abs(error.y)) > 8) ++errors.wrong;
            if (x % 5 != 2 || y % 5 != 2) continue;
            glm::dvec2 mean(0);
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) mean += errorAt(x + i, y + j) / 25.0;
            if (std::isnan(mean.x)) continue;
            errors.averagedRms += 0.5 * (mean.x * mean.x + mean.y * mean.y);
            ++averages;
        }
    errors.chiSquare /= errors.valid;
    errors.averagedRms = std::sqrt(errors.averagedRms / averages);
    return errors;
}

Errors decodeWith(const SyntheticSettings& settings) {
    const config::Rig rig = oneChannel();
    SyntheticCamera camera(rig, settings);
    const CameraView view = decode(camera, 0, rig);
    EXPECT_TRUE(view.faults.empty()) << view.faults[0].advice;
    return errorsOf(camera, view, rig.channels[0].sizePixels);
}

TEST(DecodeTest, PlacesAreGoodToATwentiethOfAPixelAndTheirSigmaIsHonest) {
    const Errors errors = decodeWith({});
    EXPECT_LT(errors.averagedRms, 0.05);
    EXPECT_NEAR(errors.chiSquare, 1, 0.15);
    EXPECT_GT(errors.valid, 0.9 * errors.inside);
    EXPECT_EQ(errors.wrong, 0);
}

TEST(DecodeTest, IndirectLightGivesNoWrongPeriod) {
    const Errors errors = decodeWith({.sizePixels = {480, 300}, .indirect = 0.3});
    EXPECT_EQ(errors.wrong, 0);
    EXPECT_GT(errors.valid, 100'000);
    EXPECT_NEAR(errors.chiSquare, 1, 0.15);
}

TEST(DecodeTest, AResponseThatIsNotStraightShiftsNoPlaces) {
    EXPECT_LT(decodeWith({.bend = 0.25}).averagedRms, 0.06);
}

TEST(DecodeTest, EightBitsWillDo) {
    EXPECT_LT(decodeWith({.bits = 8, .response = config::ScanCamera::Response::Srgb}).averagedRms, 0.06);
}

// Causes of all faults, for three channels side by side or one.
std::vector<std::string> causesOf(const config::Rig& rig, const SyntheticSettings& settings) {
    SyntheticCamera camera(rig, settings);
    std::vector<std::string> causes;
    for (const ScanFault& fault : decode(camera, 0, rig).faults) {
        causes.push_back(fault.cause);
    }
    return causes;
}

std::size_t pictureOf(const config::Rig& rig, Kind kind, int step) {
    const std::vector<config::ScanPattern> sequence = sequenceOf(rig);
    return static_cast<std::size_t>(std::ranges::find_if(sequence, [&](const auto& pattern) {
               return pattern.kind == kind && pattern.step == step;
           }) - sequence.begin());
}

TEST(DecodeTest, ThreeChannelsAreToldApartAndNothingIsWrong) {
    const config::Rig rig = touring();
    SyntheticCamera camera(rig, {.sizePixels = {960, 240}, .indirect = 0.15});
    const CameraView view = decode(camera, 0, rig);
    EXPECT_TRUE(view.faults.empty());
    for (std::size_t c = 0; c < 3; ++c) {
        int valid = 0, wrong = 0;
        for (int y = 0; y < 240; ++y)
            for (int x = 0; x < 960; ++x) {
                const glm::vec2 place = view.channels[c].place[static_cast<std::size_t>(y * 960 + x)];
                if (std::isnan(place.x)) continue;
                ++valid;
                const glm::dvec2 error = glm::dvec2(place) - camera.placeAt(c, glm::dvec2(x, y) + 0.5);
                wrong += std::max(std::abs(error.x), std::abs(error.y)) > 4 ? 1 : 0;
            }
        EXPECT_GT(valid, 50'000);
        EXPECT_EQ(wrong, 0);
    }
}

TEST(DecodeTest, OverExposureIsNamed) {
    EXPECT_THAT(causesOf(oneChannel(), {.white = 1.1}), testing::Contains("over_exposed"));
}
TEST(DecodeTest, UnderExposureIsNamed) {
    EXPECT_THAT(causesOf(oneChannel(), {.white = 0.01, .black = 0.001}), testing::Contains("under_exposed"));
    EXPECT_THAT(causesOf(oneChannel(), {.white = 0.1, .noise = 0.03}), testing::Contains("under_exposed"));
}
TEST(DecodeTest, ARepeatedPictureIsNamed) {
    const config::Rig rig = oneChannel();
    for (const Kind kind : {Kind::GrayColumns, Kind::PhaseRows, Kind::GrayRows})
        for (const int step : {1, 3}) {
            const std::size_t late = pictureOf(rig, kind, step);
            EXPECT_THAT(causesOf(rig, {.shown = [=](std::size_t i) { return i == late ? i - 1 : i; }}),
                        testing::Contains("dropped_frame"));
        }
}
TEST(DecodeTest, ALostPictureIsNamed) {
    const config::Rig rig = oneChannel();
    const std::size_t lost = pictureOf(rig, Kind::PhaseColumns, 2);
    EXPECT_THAT(causesOf(rig, {.shown = [=](std::size_t i) { return i == lost ? i + 3 : i; }}),
                testing::Contains("dropped_frame"));
}
TEST(DecodeTest, AutoExposureIsNamed) {
    const config::Rig rig = oneChannel();
    const std::size_t first = pictureOf(rig, Kind::PhaseColumns, 0);
    EXPECT_THAT(causesOf(rig, {.gain = [=](std::size_t i) { return i < first ? 1.0 : 0.75; }}),
                testing::Contains("auto_exposure"));
}
TEST(DecodeTest, ALampIsNamed) {
    const config::Rig rig = oneChannel();
    const std::size_t first = pictureOf(rig, Kind::PhaseColumns, 2);
    EXPECT_THAT(causesOf(rig, {.lamp = [=](std::size_t i) { return i < first ? 0.0 : 0.1; }}),
                testing::Contains("ambient_light"));
}
TEST(DecodeTest, ABlockedViewIsNamed) {
    EXPECT_THAT(causesOf(oneChannel(), {.blockedTo = 0.4}), testing::Contains("blocked"));
}
TEST(DecodeTest, MovementIsNamed) {
    const config::Rig rig = oneChannel();
    for (const std::size_t first : {pictureOf(rig, Kind::PhaseColumns, 0), pictureOf(rig, Kind::GrayRows, 0), pictureOf(rig, Kind::GrayColumns, 3)})
        for (const double shift : {3.0, -12.0, 40.0})
            EXPECT_THAT(causesOf(rig, {.shift = [=](std::size_t i) { return i < first ? 0.0 : shift; }}),
                        testing::Contains("moved"));
}
TEST(DecodeTest, ADarkChannelIsNamed) {
    const config::Rig rig = touring();
    EXPECT_THAT(causesOf(rig, {.sizePixels = {480, 120}, .dark = {2}}), testing::Contains("channel_not_seen"));
}

}  // namespace
}  // namespace aquarama::scan
