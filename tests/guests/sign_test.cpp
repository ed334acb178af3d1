// SPDX-License-Identifier: Apache-2.0
#include "guests/sign.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::guests {
namespace {

constexpr const char* kAddress = "HTTP://192.168.200.100:7490/P/7Q2K4M9XHT";

bool isLit(const wire::Sign& sign, std::size_t column, std::size_t row) {
    const std::size_t i = row * sign.columns + column;
    return (static_cast<unsigned char>(sign.dots[i / 8]) >> (7 - i % 8) & 1U) != 0;
}

// What zbarimg reads in a picture of the sign.
std::string readBack(const wire::Sign& sign) {
    const TemporaryFolder folder("sign");
    const std::string path = (folder.path() / "sign.pgm").string();
    constexpr std::size_t kPixels = 6;
    std::ofstream picture(path);
    picture << "P2 " << sign.columns * kPixels << ' ' << sign.rows * kPixels << " 255\n";
    for (std::size_t y = 0; y < sign.rows * kPixels; ++y)
        for (std::size_t x = 0; x < sign.columns * kPixels; ++x)
            picture << (isLit(sign, x / kPixels, y / kPixels) ? 255 : 0) << '\n';
    picture.close();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> reader(
        popen(("zbarimg --nodbus --quiet --raw -Sdisable -Sqrcode.enable " + path).c_str(), "r"),
        &pclose);
    std::string text;
    for (int c = 0; (c = std::fgetc(reader.get())) != EOF && c != '\n';)
        text += static_cast<char>(c);
    return text;
}

TEST(Sign, hasACodeOfFewModulesOnLitGround) {
    const wire::Sign sign = signOf(kAddress, "042", false);
    EXPECT_EQ(sign.columns, 25U + 8U);
    EXPECT_LE(sign.rows, 64U);
    EXPECT_EQ(sign.dots.size(), (sign.columns * sign.rows + 7) / 8);
    for (std::size_t i = 0; i < sign.columns; ++i)
        for (std::size_t edge = 0; edge < 4; ++edge) {
            EXPECT_TRUE(isLit(sign, i, edge));
            EXPECT_TRUE(isLit(sign, edge, i));
            EXPECT_TRUE(isLit(sign, sign.columns - 1 - edge, i));
            EXPECT_TRUE(isLit(sign, i, sign.columns - 1 - edge));
        }
    for (const auto& [x, y] : {std::pair(4U, 4U), std::pair(22U, 4U), std::pair(4U, 22U)})
        for (std::size_t i = 0; i < 7; ++i) {
            EXPECT_FALSE(isLit(sign, x + i, y)) << "the finder's frame";
            EXPECT_FALSE(isLit(sign, x, y + i));
        }
}

TEST(Sign, isReadBack) {
    if (std::system("zbarimg --version > /dev/null 2>&1") != 0)  // NOLINT(concurrency-mt-unsafe)
        GTEST_SKIP() << "zbarimg of zbar-tools is needed to read the code";
    EXPECT_EQ(readBack(signOf(kAddress, "042", false)), kAddress);
    EXPECT_EQ(readBack(signOf(kAddress, "5", true)), kAddress);
    EXPECT_EQ(readBack(signOf("HTTP://10.0.0.1:80/P/0123456789", "999", false)),
              "HTTP://10.0.0.1:80/P/0123456789");
}

// The longest address of version 6: brackets are none of the code's dense characters.
TEST(Sign, hasRoomForAnAddressOfVersion6) {
    const std::string address =
        "HTTP://[2001:DB8:1234:5678:9ABC:DEF0:1234:5678]:65535/P/7Q2K4M9XHT";
    const wire::Sign sign = signOf(address, "042", false);
    EXPECT_EQ(sign.columns, 29U + 8U);
    EXPECT_LE(sign.rows, 64U);
    if (std::system("zbarimg --version > /dev/null 2>&1") != 0)  // NOLINT(concurrency-mt-unsafe)
        GTEST_SKIP() << "zbarimg of zbar-tools is needed to read the code";
    EXPECT_EQ(readBack(sign), address);
}

TEST(Sign, showsItsCharacters) {
    const wire::Sign one = signOf(kAddress, "042", false), other = signOf(kAddress, "043", false);
    EXPECT_NE(one.dots, other.dots);
    const wire::Sign last = signOf(kAddress, "5", true);
    EXPECT_EQ(last.rows, one.rows) << "it stands where it stood";
    EXPECT_FALSE(isLit(last, 0, last.rows - 1));
}

TEST(Sign, refusesAnAddressThatIsTooLong) {
    EXPECT_THROW(static_cast<void>(signOf(std::string(300, 'A'), "042", false)), Error);
}

}  // namespace
}  // namespace aquarama::guests
