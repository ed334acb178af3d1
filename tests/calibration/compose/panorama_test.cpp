// SPDX-License-Identifier: Apache-2.0
// What three projectors throw adds up to one wall: the grid's lines are where a direct render has
// them, and grey is flat, overlaps included.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "calibration/compose/compose.h"
#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/formats/mpcdi.h"
#include "tests/support/panorama_measure.h"
#include "tests/support/projected.h"

namespace aquarama::compose {
namespace {

config::Rig shippedRig(const std::string& name) {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

// The large rigs with half as many pixels each way: the same geometry in a quarter of the time.
config::Rig testRig(const std::string& name) {
    config::Rig rig = shippedRig(name);
    if (name == "desk") return rig;
    rig.panoramaPixels /= 2;
    for (config::Channel& channel : rig.channels) {
        channel.sizePixels /= 2;
        channel.projector.focalPixels /= 2;
        channel.projector.principalPixels /= 2;
    }
    return rig;
}

std::vector<Light> projected(const config::Rig& rig, wall::TestPattern pattern) {
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        channels.push_back(test::projectedLight(rig, i, pattern));
    return channels;
}

// Through the codes that the channels' pictures are stored in.
Light composed(const config::Rig& rig, const std::vector<Light>& projected, int bits) {
    std::vector<Light> channels;
    for (std::size_t i = 0; i < projected.size(); ++i)
        channels.push_back(lightOf(pictureOf(projected[i], bits, static_cast<std::uint32_t>(i))));
    return composePanorama(rig, channels);
}

double largest(const std::vector<test::LineOffset>& offsets) {
    double worst = 0;
    for (const test::LineOffset& line : offsets)
        worst = std::max(worst, std::abs(line.offsetPixels));
    return worst;
}

class OneWall : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, OneWall, testing::Values("theatre", "touring", "desk"));

TEST_P(OneWall, everyLineOfTheGridIsWithinHalfAPanoramaPixel) {
    const config::Rig rig = testRig(GetParam());
    const std::vector<Light> channels = projected(rig, wall::TestPattern::Grid);
    const Light direct = test::directPanorama(rig, wall::TestPattern::Grid);
    for (const int bits : {16, 8}) {
        const auto offsets = test::lineOffsets(rig, composed(rig, channels, bits), direct);
        EXPECT_GT(offsets.size(), 5000U);
        EXPECT_LT(largest(offsets), 0.5) << bits << " bits";
    }
}

TEST_P(OneWall, greyIsFlatInLinearLightToOnePerCent) {
    const config::Rig rig = testRig(GetParam());
    const std::vector<Light> channels = projected(rig, wall::TestPattern::Grey);
    const Light deep = composed(rig, channels, 16);
    EXPECT_LT(test::unevenness(deep, 1), 0.01);
    EXPECT_LT(test::unevenness(composed(rig, channels, 8), 16), 0.01);
    const glm::ivec2 middle = rig.panoramaPixels / 2;
    EXPECT_NEAR(static_cast<double>(deep.at(middle.x, middle.y).y), wall::kGreyLight, 1e-4);
}

// Codes that were made with the colour of a channel are light again, each of the others sRGB.
TEST(Projectors, throwWhatTheirWallFileSays) {
    config::Rig rig = shippedRig("desk");
    formats::WallFile file;
    formats::FileChannel& region = file.channels.emplace_back();
    region.name = "middle";
    region.sizePixels = {2, 1};
    region.colour = {.mix = {0.7F, 0.1F, 0, 0.2F, 0.9F, 0, 0, 0.05F, 0.8F},
                     .response = {{{0, 0.1F, 1}, {0, 0.2F, 0.5F, 1}, {0, 1}}}};
    rig.files["hall.mpcdi"] =
        std::make_shared<const std::vector<std::byte>>(formats::encodeMpcdi(file, 1));
    rig.channels[1].wallFile = {"hall.mpcdi", "middle", ""};
    const Projectors projectors(rig);
    for (const int bits : {8, 16}) {
        const double most = (1 << bits) - 1;
        Picture picture{.sizePixels = {2, 1}, .bits = bits, .rgb = {}};
        const std::array<glm::dvec3, 2> light{glm::dvec3(0.3, 0.05, 0.6), glm::dvec3(0.1, 0.9, 0)};
        for (const glm::dvec3& wanted : light)
            for (int c = 0; c < 3; ++c)
                picture.rgb.push_back(static_cast<std::uint16_t>(std::lround(
                    most * formats::codeFor(region.colour->response[static_cast<std::size_t>(c)],
                                            (glm::dmat3(region.colour->mix) * wanted)[c]))));
        const Light thrown = projectors.thrown(1, picture);
        for (std::size_t i = 0; i < light.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(static_cast<double>(thrown.rgb[i][c]), light[i][c], 3 / most);
        EXPECT_EQ(projectors.thrown(0, picture).rgb, lightOf(picture).rgb);
    }
}

// The measures must see what they are there to refuse.

TEST(Measure, aProjectorThatWasPushedIsSeenWhereItLightsAlone) {
    const config::Rig rig = shippedRig("desk");
    const std::vector<Light> channels = projected(rig, wall::TestPattern::Grid);
    config::Rig pushed = rig;
    pushed.channels[0].projector.yawPitchRollRadians.x += 0.1 * kRadiansPerDegree<double>;
    // The pictures were made for the rig; the hall has the left projector turned by 0.1 degrees.
    const auto offsets = test::lineOffsets(
        rig, composed(pushed, channels, 16), test::directPanorama(rig, wall::TestPattern::Grid));
    EXPECT_GT(largest(offsets), 1);
    for (const test::LineOffset& line : offsets) {
        if (!line.upright || line.lineDegrees < -15) continue;  // the middle and right thirds
        EXPECT_LT(std::abs(line.offsetPixels), 0.1) << line.lineDegrees;
    }
}

TEST(Measure, aShiftIsMeasuredInPanoramaPixelsAndWithItsSign) {
    const config::Rig rig = shippedRig("desk");
    const Light direct = test::directPanorama(rig, wall::TestPattern::Grid);
    Light shifted = direct;
    for (int y = 0; y < direct.sizePixels.y; ++y)
        for (int x = 0; x < direct.sizePixels.x; ++x)
            shifted.at(x, y) = bilinear(direct, {x + 0.5 - 0.75, y + 0.5 + 0.25});
    const auto offsets = test::lineOffsets(rig, shifted, direct);
    ASSERT_FALSE(offsets.empty());
    for (const test::LineOffset& line : offsets)
        EXPECT_NEAR(line.offsetPixels, line.upright ? 0.75 : -0.25, 0.02);
}

TEST(Measure, aMissingLineIsInfinitelyOff) {
    const config::Rig rig = shippedRig("desk");
    const auto offsets = test::lineOffsets(
        rig, darkness(rig.panoramaPixels), test::directPanorama(rig, wall::TestPattern::Grid));
    ASSERT_FALSE(offsets.empty());
    EXPECT_TRUE(std::ranges::all_of(
        offsets, [](const test::LineOffset& line) { return std::isinf(line.offsetPixels); }));
}

TEST(Measure, aSeamOfTwoPerCentIsSeen) {
    const config::Rig rig = shippedRig("desk");
    std::vector<Light> channels = projected(rig, wall::TestPattern::Grey);
    for (glm::vec3& light : channels[2].rgb) light *= 1.03F;
    EXPECT_GT(test::unevenness(composed(rig, channels, 8), 16), 0.015);
}

// Blending in codes instead of light is the classic mistake: the sum is then too dark.
TEST(Measure, blendingInCodesInsteadOfLightIsSeen) {
    const config::Rig rig = shippedRig("desk");
    std::vector<Light> channels = projected(rig, wall::TestPattern::Grey);
    const double greyCode = srgbFromLinear(wall::kGreyLight);
    for (Light& channel : channels)
        for (glm::vec3& light : channel.rgb) {
            const double share = static_cast<double>(light.x) / wall::kGreyLight;
            light = glm::vec3(static_cast<float>(linearFromSrgb(greyCode * share)));
        }
    EXPECT_GT(test::unevenness(composed(rig, channels, 16), 1), 0.2);
}

}  // namespace
}  // namespace aquarama::compose
