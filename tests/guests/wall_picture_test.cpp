// SPDX-License-Identifier: Apache-2.0
// The small picture of a wall: it adds up as light on the screen does, and its places are where
// visitors see them.
#include "guests/wall_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "common/base/picture.h"
#include "common/wall/wall.h"

namespace aquarama::guests {
namespace {

using namespace std::chrono_literals;

config::Rig desk() {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
}

// What a projector throws where the wall is to be of even light: its blend weights.
WallMap::ChannelCodes blendOf(const wall::Wall& wall, std::size_t channel, glm::ivec2 size) {
    const wall::WarpMap warp = wall.warp(channel);
    WallMap::ChannelCodes codes{.sizePixels = size, .rgb = {}};
    for (const glm::vec4& texel : warp.pointAndWeight)
        for (int part = 0; part < 3; ++part)
            codes.rgb.push_back(static_cast<std::uint8_t>(
                std::lround(255 * srgbFromLinear(static_cast<double>(texel.w)))));
    return codes;
}

TEST(WallMap, addsLightAsTheScreenDoes) {
    const config::Rig rig = desk();
    const wall::Wall wall(rig);
    const WallMap map(rig);
    std::map<std::size_t, WallMap::ChannelCodes> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        channels[i] = blendOf(wall, i, rig.channels[i].sizePixels);
    const auto rgb = map.composed(channels);
    ASSERT_EQ(rgb.size(), std::size_t{3} * kWallPictureWidth * 177);
    // Within the borders of the screen, which stay dark.
    int dark = 0;
    for (int row = 10; row < 167; ++row)
        for (int column = 8; column < kWallPictureWidth - 8; ++column)
            dark +=
                rgb[3 * static_cast<std::size_t>(row * kWallPictureWidth + column)] < 250 ? 1 : 0;
    EXPECT_LT(dark, 157 * 384 / 500) << "of 60 288 pixels, in the seams' steps of pixels";
}

TEST(WallMap, placesAreWhereVisitorsSeeThem) {
    const WallMap map(desk());
    const auto middle = map.directionAt({0.5F, 0.5F});
    ASSERT_TRUE(middle);
    EXPECT_LT(glm::distance(*middle, glm::vec3(0, 0, -1)), 0.02F);
    // The screen reaches over 120 degrees about its axis.
    const auto left = map.directionAt({0.002F, 0.5F});
    ASSERT_TRUE(left);
    EXPECT_NEAR(std::atan2(left->x, -left->z), -60 * M_PI / 180, 0.03);
    EXPECT_GT(map.directionAt({0.5F, 0.05F})->y, 0.3F) << "up is up";
    EXPECT_FALSE(map.directionAt({-0.1F, 0.5F}));
    EXPECT_FALSE(map.directionAt({0.5F, 1.0F}));
}

// A JPEG of one colour.
std::string plain(std::uint8_t red, glm::ivec2 size) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < size.x * size.y; ++i) rgb.insert(rgb.end(), {red, 0, 0});
    const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    tjCompress2(
        encoder.get(), rgb.data(), size.x, 0, size.y, TJPF_RGB, &bytes, &count, TJSAMP_444, 90, 0);
    const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(bytes, tjFree);
    return {reinterpret_cast<const char*>(bytes), count};
}

// A node that is asked brings its picture; one that is no JPEG changes nothing.
TEST(WallPicture, isPutTogetherOfWhatNodesBring) {
    config::Rig rig = desk();
    rig.guests.emplace();
    rig.guests->picturesAddress = "tcp://127.0.0.1:*";
    WallPicture wall(rig, std::nullopt);
    EXPECT_EQ(wall.jpeg(), "");
    const auto node = net::connectNode(wall.address(), {}, std::nullopt);
    const auto say = [&](const v1::Envelope& message) {
        node->sendControl(wire::encode(0, message));
    };
    const auto offer = [&](const std::string& jpeg) {
        v1::Envelope message;
        v1::FramePicture& picture = *message.mutable_frame_picture();
        picture.set_number(1);
        picture.set_frame(1);
        picture.set_width_px(240);
        picture.set_height_px(180);
        picture.set_jpeg(jpeg);
        say(message);
    };
    v1::Envelope hello;
    hello.mutable_watch_hello()->set_channel("middle");
    std::uint32_t width = 0;
    for (int i = 0; i < 500 && width == 0; ++i) {
        say(hello);
        wall.ask();
        node->wait(20ms);
        while (const auto bytes = node->receiveControl())
            if (const auto asked = wire::decode(*bytes))
                width = asked->picture_request().width_px();
    }
    EXPECT_EQ(width, 240U);
    offer("\xFF\xD8 no JPEG");
    offer(plain(200, {240, 180}));
    for (int i = 0; i < 500 && wall.number() == 0; ++i) node->wait(20ms);
    EXPECT_EQ(wall.number(), 1U);
    EXPECT_GT(wall.jpeg().size(), 300U);
    EXPECT_LE(wall.jpeg().size(), kMostWallPictureBytes);
}

}  // namespace
}  // namespace aquarama::guests
