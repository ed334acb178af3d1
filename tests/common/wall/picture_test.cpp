// SPDX-License-Identifier: Apache-2.0
// Codes and light, dither, and PNG files.
#include "common/base/picture.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::wall {
namespace {

TEST(Picture, theTransferFunctionsAreTheStandards) {
    EXPECT_EQ(linearFromSrgb(0), 0);
    EXPECT_NEAR(linearFromSrgb(1), 1, 1e-12);
    EXPECT_NEAR(linearFromSrgb(0.5), 0.21404114048, 1e-9);  // IEC 61966-2-1
    EXPECT_NEAR(srgbFromLinear(0.18), 0.46135612950, 1e-9);
    for (int i = 0; i <= 512; ++i)
        EXPECT_NEAR(linearFromSrgb(srgbFromLinear(i / 512.0)), i / 512.0, 1e-7);
}

Light ramp() {
    Light light = darkness({64, 8});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x)
            light.at(x, y) = glm::vec3(static_cast<float>(x) / 63.0F, 0.18F, 0.0F);
    return light;
}

TEST(Picture, sixteenBitsReturnTheLightToAHundredThousandth) {
    const Light light = ramp();
    const Light back = lightOf(pictureOf(light, 16, 1));
    for (std::size_t i = 0; i < light.rgb.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.rgb[i][c], light.rgb[i][c], 2e-5F);
}

// Rounding alone would show 0.18 as code 118, 0.3 % too bright, everywhere.
TEST(Picture, ditherKeepsTheMeanOfAFlatArea) {
    Light light = darkness({256, 256});
    for (glm::vec3& pixel : light.rgb) pixel = glm::vec3(0.1812F);
    const Light back = lightOf(pictureOf(light, 8, 3));
    double sum = 0;
    for (const glm::vec3& pixel : back.rgb) sum += static_cast<double>(pixel.x);
    EXPECT_NEAR(sum / static_cast<double>(back.rgb.size()) / 0.1812, 1, 0.0005);
}

TEST(Picture, blackStaysBlackAndWhiteStaysWhite) {
    Light light = darkness({32, 32});
    for (const std::uint16_t code : pictureOf(light, 8, 9).rgb) EXPECT_EQ(code, 0);
    for (glm::vec3& pixel : light.rgb) pixel = glm::vec3(1);
    for (const std::uint16_t code : pictureOf(light, 16, 9).rgb) EXPECT_EQ(code, 65535);
}

TEST(Picture, bilinearIsExactAtCentresAndStraightBetween) {
    const Light light = ramp();
    EXPECT_EQ(bilinear(light, {10.5, 3.5}), light.at(10, 3));
    EXPECT_NEAR(bilinear(light, {10.75, 4}).x, 10.25F / 63.0F, 1e-6F);
    EXPECT_EQ(bilinear(light, {0, 0}), light.at(0, 0));
    EXPECT_EQ(bilinear(light, {64, 8}), light.at(63, 7));
}

class Png : public testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(path_); }
    const std::string path_ = testing::TempDir() + "picture-" + std::to_string(getpid()) + ".png";
};

TEST_F(Png, whatIsWrittenIsReadBackInBothDepths) {
    for (const int bits : {8, 16}) {
        const Picture picture = pictureOf(ramp(), bits, 2);
        writePng(path_, picture);
        const Picture back = readPng(path_);
        EXPECT_EQ(back.sizePixels, picture.sizePixels);
        EXPECT_EQ(back.bits, bits);
        EXPECT_EQ(back.rgb, picture.rgb);
    }
}

TEST_F(Png, masksKeepTheirDepthAndTheNumberOfTheirComponents) {
    for (const int bits : {8, 16})
        for (const int components : {1, 3}) {
            PngPicture mask{
                .sizePixels = {5, 3}, .components = components, .bits = bits, .codes = {}};
            for (int i = 0; i < 15 * components; ++i)
                mask.codes.push_back(static_cast<std::uint16_t>(i * (bits == 16 ? 1021 : 5)));
            const PngPicture back = decodePng(encodePng(mask, PngMeaning::Unsaid), "a mask");
            EXPECT_EQ(back.sizePixels, mask.sizePixels);
            EXPECT_EQ(back.components, components);
            EXPECT_EQ(back.bits, bits);
            EXPECT_EQ(back.codes, mask.codes);
        }
}

TEST_F(Png, bandsMakeTheFileOfTheWholePicture) {
    const Light light = ramp();
    const int half = light.sizePixels.y / 2;
    for (const int bits : {8, 16}) {
        PngBands bands(light.sizePixels, bits);
        for (const auto& [first, rows] :
             {std::pair{0, half}, std::pair{half, light.sizePixels.y - half}}) {
            Light band = darkness({light.sizePixels.x, rows});
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < light.sizePixels.x; ++x) band.at(x, y) = light.at(x, first + y);
            bands.add(pictureOf(band, bits, 3, first));
        }
        const Picture whole = pictureOf(light, bits, 3);
        EXPECT_EQ(decodePng(bands.finish(), "bands").codes, whole.rgb);
    }
}

TEST_F(Png, greyIsReadAsThreeEqualColours) {
    const std::vector<std::byte> grey = encodePng(
        {.sizePixels = {2, 1}, .components = 1, .bits = 8, .codes = {7, 200}}, PngMeaning::Unsaid);
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(grey.data()),
               static_cast<std::streamsize>(grey.size()));
    EXPECT_EQ(readPng(path_).rgb, (std::vector<std::uint16_t>{7, 7, 7, 200, 200, 200}));
}

TEST_F(Png, aFileCutShortAnywhereIsRefused) {
    writePng(path_, pictureOf(ramp(), 8, 2));
    const auto whole = std::filesystem::file_size(path_);
    for (std::uintmax_t size = whole - 13; size > 0; size = size * 2 / 3) {
        std::filesystem::resize_file(path_, size);
        EXPECT_THROW((void)readPng(path_), Error) << size << " bytes";
    }
}

TEST_F(Png, aFileOfAnotherKindOrNoneIsRefused) {
    EXPECT_THROW((void)readPng(path_), Error);
    std::ofstream(path_) << "This is no picture, it is a text of more than eight bytes.";
    EXPECT_THROW((void)readPng(path_), Error);
    EXPECT_THROW(writePng("/proc/no/such/folder/picture.png", pictureOf(ramp(), 8, 0)), Error);
}

}  // namespace
}  // namespace aquarama::wall
