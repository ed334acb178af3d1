// SPDX-License-Identifier: Apache-2.0
// Float maps byte by byte, and what their numbers mean.
#include "common/formats/pfm.h"

#include <bit>
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {
namespace {

using test::bytesOf;
using test::kUnlit;
using test::smallPfm;

std::string complaint(const std::string& file) {
    return test::complaintOf([&] { (void)decodePfm(bytesOf(file), "a.pfm"); });
}

std::string texels(std::size_t count) {
    return std::string(12 * count, '\1');
}

TEST(PfmFile, theHeaderIsExactAndEveryBitComesBack) {
    Pfm pfm = smallPfm();
    pfm.texels[3].z = std::bit_cast<float>(0xFFC12345U);  // a NaN with a payload
    pfm.texels[5].x = -0.0F;
    const std::vector<std::byte> bytes = encodePfm(pfm);
    const std::string header = "PF\n4 2\n-1.000000\n";
    ASSERT_EQ(bytes.size(), header.size() + 96);
    EXPECT_EQ(std::memcmp(bytes.data(), header.data(), header.size()), 0);
    EXPECT_EQ(encodePfm(decodePfm(bytes, "a.pfm")), bytes);
}

TEST(PfmFile, bigEndianIsRead) {
    const Pfm pfm = smallPfm();
    std::string file = "PF\n4 2\n1.0\n";
    for (const glm::vec3& texel : pfm.texels)
        for (int i = 0; i < 3; ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(texel[i]);
            for (int shift = 24; shift >= 0; shift -= 8)
                file.push_back(static_cast<char>(bits >> shift & 0xFF));
        }
    EXPECT_EQ(decodePfm(bytesOf(file), "a.pfm").texels, pfm.texels);
}

TEST(PfmFile, anyWhiteSpaceSeparatesTheHeader) {
    for (const char* header :
         {"PF 4 2 -1 ", "PF\t4\n2\n-1.0\n", "PF\r4\r2\r-2.5\r", "PF\r\n4 2\r\n-1\r\n"})
        EXPECT_EQ(decodePfm(bytesOf(header + texels(8)), "a.pfm").size, glm::ivec2(4, 2)) << header;
}

// A texel may begin with a byte that is white space.
TEST(PfmFile, onlyOneWhiteSpaceEndsTheHeader) {
    const Pfm pfm = decodePfm(bytesOf("PF\n1 1\n-1\n" + std::string("\n\n\n\n ") + "1234567"), "a");
    EXPECT_EQ(std::bit_cast<std::uint32_t>(pfm.texels[0].x), 0x0A0A0A0AU);
}

TEST(PfmFile, wrongHeadersAndCountsAreRefusedBeforeMemoryIsTaken) {
    EXPECT_THAT(complaint("Pf\n4 2\n-1\n" + texels(8)), testing::HasSubstr("a.pfm: is a grey"));
    EXPECT_THAT(complaint("P6\n4 2\n-1\n"), testing::HasSubstr("does not begin with PF"));
    EXPECT_THAT(complaint(""), testing::HasSubstr("does not begin with PF"));
    for (const char* header : {"PF\n4 x\n-1\n",
                               "PF\n-4 2\n-1\n",
                               "PF\n4.5 2\n-1\n",
                               "PF\n0 2\n-1\n",
                               "PF\n4000000000 4000000000\n-1\n",
                               "PF\n"})
        EXPECT_THAT(complaint(header), testing::HasSubstr("one way, not 1 to 16384")) << header;
    for (const char* header : {"PF\n4 2\n0\n", "PF\n4 2\nnan\n", "PF\n4 2\n"})
        EXPECT_THAT(complaint(header), testing::HasSubstr("has a scale of")) << header;
    EXPECT_THAT(complaint("PF\n16384 16384\n-1\n" + texels(8)),
                testing::HasSubstr("has 96 bytes of texels where 16384 x 16384 need 3221225472"));
    EXPECT_THAT(complaint("PF\n4 2\n-1\n" + texels(7)), testing::HasSubstr("has 84 bytes"));
    EXPECT_THAT(complaint("PF\n4 2\n-1\n" + texels(9)), testing::HasSubstr("has 108 bytes"));
}

Warp meant(const Pfm& pfm, TexelMeaning meaning) {
    guessMeaning(meaning, pfm);
    return warpOf(pfm, meaning);
}

TEST(PfmMeaning, rowsAndValuesRunFromTheBottomInTheFileAndFromTheTopHere) {
    const Warp warp = meant(smallPfm(), {});
    EXPECT_EQ(warp.samples[0], glm::vec3(0.125F, 0.25F, 0));  // top left: v = 0.75
    EXPECT_EQ(warp.samples[7], glm::vec3(0.5F, 0.875F, 0));
    EXPECT_EQ(warp.sampling, Sampling::Centres);
}

TEST(PfmMeaning, valuesOfARegionAreMovedToTheBuffer) {
    const TexelMeaning meaning{.corner = {0.5, 0}, .extent = {0.5, 0.5}};  // top right
    const Warp warp = meant(smallPfm(), meaning);
    EXPECT_EQ(warp.stored, Stored::Places);
    EXPECT_EQ(warp.samples[0], glm::vec3(0.5F + 0.0625F, 0.125F, 0));
}

// Two projectors side by side whose values already span the buffer: u from 0.5 to 1.
TEST(PfmMeaning, valuesThatLieAsTheRegionDoesAreOfTheWholeBuffer) {
    Pfm pfm = smallPfm();
    for (glm::vec3& texel : pfm.texels) texel.x = texel.x == 0.125F ? 0.505F : 0.5F + texel.x;
    pfm.texels[3].x = pfm.texels[7].x = 0.995F;
    TexelMeaning meaning{.corner = {0.5, 0}, .extent = {0.5, 1}};
    const Warp warp = meant(pfm, meaning);
    EXPECT_EQ(warp.stored, Stored::WholeBuffer);
    EXPECT_EQ(warp.samples[0].x, 0.505F);
    meaning.corner.x = 0.4;  // it is elsewhere: so they are of the region
    EXPECT_EQ(meant(pfm, meaning).stored, Stored::Places);
    EXPECT_EQ(meant(pfm, {}).stored, Stored::Places);  // all of the buffer
}

// Regions above one another: u covers the whole buffer in both readings, v decides.
TEST(PfmMeaning, theWholeWidthIsNoSignOfTheWholeBuffer) {
    Pfm pfm = smallPfm();
    const TexelMeaning meaning{.corner = {0, 0}, .extent = {1, 0.5}};
    EXPECT_EQ(meant(pfm, meaning).stored, Stored::Places);
    for (glm::vec3& texel : pfm.texels) texel.y = texel.y < 0.5F ? 0.501F : 0.999F;
    EXPECT_EQ(meant(pfm, meaning).stored, Stored::WholeBuffer);
}

TEST(PfmMeaning, valuesAboutZeroAreOffsetsFromNodes) {
    Pfm pfm{.size = {3, 2}, .texels = std::vector<glm::vec3>(6, {0.0F, 0.0F, kUnlit})};
    pfm.texels[0] = {-0.25F, 0.125F, kUnlit};  // bottom left
    pfm.texels[5] = {0.25F, -0.125F, kUnlit};  // top right
    const Warp warp = meant(pfm, {.profile = Profile::View});
    EXPECT_EQ(warp.stored, Stored::Offsets);
    EXPECT_EQ(warp.sampling, Sampling::Nodes);
    EXPECT_EQ(warp.samples[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(warp.samples[1], glm::vec3(0.5F, 0, 0));
    EXPECT_EQ(warp.samples[2], glm::vec3(1.25F, 0.125F, 0));
    EXPECT_EQ(warp.samples[3], glm::vec3(-0.25F, 0.875F, 0));
    EXPECT_EQ(meant(smallPfm(), {.profile = Profile::View}).stored, Stored::Places);
}

TEST(PfmMeaning, aMapOfZerosMovesNothing) {
    const Pfm pfm{.size = {3, 2}, .texels = std::vector<glm::vec3>(6)};
    EXPECT_EQ(meant(pfm, {.profile = Profile::View}).samples[4], glm::vec3(0.5F, 1, 0));
    EXPECT_TRUE(std::isnan(meant(pfm, {}).samples[4].x));
}

TEST(PfmMeaning, noNumbersAndZerosAreUnlit) {
    Pfm pfm = smallPfm();
    pfm.texels[0].x = kUnlit;
    pfm.texels[1].y = std::numeric_limits<float>::infinity();
    pfm.texels[2] = {9e-6F, -9e-6F, 0};
    pfm.texels[3] = {0, 2e-5F, 0};
    pfm.texels[4].z = kUnlit;
    for (const Profile profile : {Profile::Content, Profile::View, Profile::Screen}) {
        const Warp warp = meant(pfm, {.profile = profile});
        EXPECT_TRUE(std::isnan(warp.samples[4].x));
        EXPECT_TRUE(std::isnan(warp.samples[5].x));
        EXPECT_TRUE(std::isnan(warp.samples[6].x));
        EXPECT_FALSE(std::isnan(warp.samples[7].x));
        // The third counts for points alone.
        EXPECT_EQ(std::isnan(warp.samples[0].x), profile == Profile::Screen);
    }
}

TEST(PfmMeaning, pointsAreMetres) {
    Pfm pfm = smallPfm();
    pfm.texels[4] = {1000, 250, -3000};
    const Warp warp = meant(pfm, {.profile = Profile::Screen, .unitMetres = 0.001});
    EXPECT_EQ(warp.samples[0], glm::vec3(1, 0.25F, -3));
}

// The promise of pfmOf(), for many values.
TEST(PfmMeaning, whatWasReadIsWrittenSoThatItIsReadAgain) {
    const Warp random = test::sampleWarp({64, 64}, 99);
    const Pfm pfm{.size = random.size, .texels = random.samples};
    for (const Profile profile :
         {Profile::Content, Profile::View, Profile::Screen, Profile::Projector})
        for (const Stored stored : {Stored::Places, Stored::WholeBuffer, Stored::Offsets}) {
            if (profile == Profile::Screen && stored != Stored::Places) continue;
            const TexelMeaning meaning{.profile = profile,
                                       .corner = {0.01, 1 - 0.07 - 0.92},
                                       .extent = {0.9, 0.92},
                                       .unitMetres = 0.3048,
                                       .stored = stored};
            Warp read = warpOf(pfm, meaning);
            read.texels.clear();
            test::expectSame(warpOf(pfmOf(read, meaning), meaning), read, 0);
        }
}

TEST(PfmMeaning, texelsThatWereReadAreWrittenToTheBitUnlessTheirSampleIsAnother) {
    Pfm pfm = smallPfm();
    pfm.texels[0] = {};
    pfm.texels[1] = {std::bit_cast<float>(0xFFC12345U), 0.1F, 7};
    pfm.texels[2] = {0.1F, 0.1F, 7};
    const TexelMeaning meaning{.corner = {0.3, 0.1}, .extent = {0.7, 0.7}};
    Warp warp = warpOf(pfm, meaning);
    EXPECT_EQ(encodePfm(pfmOf(warp, meaning)), encodePfm(pfm));
    warp.samples[4 + 2] = {0.5F, 0.5F, 0};
    const Pfm other = pfmOf(warp, meaning);
    EXPECT_NEAR(other.texels[2].x, 0.2 / 0.7, 1e-6);
    EXPECT_NEAR(other.texels[2].y, 0.3 / 0.7, 1e-6);
    EXPECT_EQ(other.texels[2].z, 0);
    EXPECT_EQ(other.texels[3], pfm.texels[3]);
}

TEST(PfmMeaning, anySampleIsWrittenToThePrecisionOfTheFormat) {
    const Warp any = test::sampleWarp({64, 64}, 7);
    for (const TexelMeaning& meaning :
         {TexelMeaning{.profile = Profile::View},
          TexelMeaning{.profile = Profile::Content, .corner = {0.3, 0.2}, .extent = {0.7, 0.8}},
          TexelMeaning{.profile = Profile::Content, .stored = Stored::WholeBuffer},
          TexelMeaning{.profile = Profile::Projector, .stored = Stored::Offsets}})
        test::expectSame(warpOf(pfmOf(any, meaning), meaning),
                         {.size = any.size, .samples = any.samples, .stored = meaning.stored},
                         std::ldexp(1.0F, -24));
    const TexelMeaning screen{.profile = Profile::Screen};
    test::expectSame(warpOf(pfmOf(any, screen), screen), any, 0);
}

TEST(PfmMeaning, noLegalPlaceIsWrittenAsZero) {
    const Warp corner{.size = {2, 1}, .samples = {{0, 1, 0}, glm::vec3(kUnlit)}};  // bottom left
    const Pfm pfm = pfmOf(corner, {});
    EXPECT_EQ(pfm.texels[0], glm::vec3(1e-4F, 0, 0));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isnan(pfm.texels[1][i]));
    EXPECT_FALSE(std::isnan(warpOf(pfm, {}).samples[0].x));
}

}  // namespace
}  // namespace aquarama::formats
