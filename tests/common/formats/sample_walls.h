// SPDX-License-Identifier: Apache-2.0
// Small walls of every profile, manifests as text, and comparison of walls bit by bit.
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/mpcdi.h"
#include "common/formats/pfm.h"
#include "common/formats/wall_file.h"

namespace aquarama::test {

inline constexpr float kUnlit = std::numeric_limits<float>::quiet_NaN();

[[nodiscard]] inline std::vector<std::byte> bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// What reading complains of; empty where it does not.
[[nodiscard]] inline std::string complaintOf(const std::function<void()>& reading) {
    try {
        reading();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

[[nodiscard]] inline std::string complaintOf(const std::vector<std::byte>& bytes) {
    return complaintOf([&] { (void)formats::readMpcdi(bytes, "wall.mpcdi"); });
}

// A warp of any values between 0 and 1, three of them unlit.
[[nodiscard]] inline formats::Warp sampleWarp(glm::ivec2 size, std::uint32_t seed) {
    formats::Warp warp{.size = size, .samples = {}};
    for (int i = 0; i < size.x * size.y; ++i) {
        glm::vec3 sample{};
        for (int k = 0; k < 2; ++k) {
            seed = seed * 1664525 + 1013904223;
            sample[k] = static_cast<float>(seed >> 8) / 16777216.0F;
        }
        warp.samples.push_back(i % 7 == 3 ? glm::vec3(kUnlit) : sample);
    }
    return warp;
}

[[nodiscard]] inline formats::Mask sampleMask(int components, int bits, double gamma) {
    formats::Mask mask{
        .size = {4, 3}, .components = components, .bits = bits, .gamma = gamma, .codes = {}};
    for (int i = 0; i < 12 * components; ++i)
        mask.codes.push_back(static_cast<std::uint16_t>(i * (bits == 16 ? 1801 : 7)));
    return mask;
}

// A mix that no short decimal says, and responses of several lengths: one with a flat foot and a
// knee.
[[nodiscard]] inline formats::ChannelColour sampleColour() {
    formats::ChannelColour colour{.mix = {0.8F, 1.0F / 3, -0.0F, 1e-30F, 0.7F, -0.1F, 0, 0.05F, 1},
                                  .response = {}};
    for (int i = 0; i < 1024; ++i)
        colour.response[0].push_back(std::pow(static_cast<float>(i) / 1023, 2.4F));
    colour.response[1] = {0, 0, 0.1F, 0.1F, 0.95F, 1};
    colour.response[2] = {0, 1};
    return colour;
}

// Two channels side by side with all that the profile has.
[[nodiscard]] inline formats::WallFile sampleWall(formats::Profile profile) {
    using formats::Profile;
    formats::WallFile wall;
    wall.profile = profile;
    wall.date = "2026-11-24 10:11:12";
    for (int i = 0; i < 2; ++i) {
        formats::FileChannel channel;
        channel.name = i == 0 ? "left + 1.a" : "rechts";
        channel.sizePixels = {16, 12};
        channel.corner = {0.4 * i, 0.06};
        channel.extent = {0.6, 0.9};
        channel.warp = sampleWarp({16, 12}, 5 + static_cast<std::uint32_t>(i));
        channel.blend = sampleMask(i == 0 ? 3 : 1, i == 0 ? 16 : 8, 2.2);
        channel.black = sampleMask(1, 8, 1.8);
        if (profile == Profile::View || profile == Profile::Projector)
            channel.frustum = {0.1, -0.3, 2.9, -0.5, 0.51, -0.25, 0.27};
        if (profile == Profile::Projector) {
            channel.coordinateFrame = formats::CoordinateFrame{{1.5, -0.7, 0.1}};
            channel.distortion = sampleWarp({5, 4}, 77);
        }
        wall.channels.push_back(channel);
    }
    if (profile == Profile::Screen) {
        wall.origin = formats::DataOrigin::FloorCentre;
        for (formats::FileChannel& channel : wall.channels)
            for (glm::vec3& sample : channel.warp->samples)
                sample = sample * glm::vec3(4, 2, 0) - glm::vec3(2, 1, 3.3F);
    }
    return wall;
}

[[nodiscard]] inline bool sameFloat(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) || a == b;
}

inline void expectSame(const formats::Warp& a, const formats::Warp& b, float tolerance) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.sampling, b.sampling);
    EXPECT_EQ(a.stored, b.stored);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        for (int k = 0; k < 3; ++k)
            ASSERT_TRUE(sameFloat(a.samples[i][k], b.samples[i][k]) ||
                        std::abs(a.samples[i][k] - b.samples[i][k]) <= tolerance)
                << "number " << k << " of sample " << i << ": " << a.samples[i][k] << " and "
                << b.samples[i][k];
}

inline void expectSame(const formats::Mask& a, const formats::Mask& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.bits, b.bits);
    EXPECT_EQ(a.gamma, b.gamma);
    EXPECT_EQ(a.codes, b.codes);
}

// To the bit.
inline void expectSame(const formats::ChannelColour& a, const formats::ChannelColour& b) {
    EXPECT_EQ(std::memcmp(&a.mix, &b.mix, sizeof a.mix), 0);
    EXPECT_EQ(a.response, b.response);
}

inline void expectSame(const std::vector<formats::Extension>& a,
                       const std::vector<formats::Extension>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].xml, b[i].xml);
        EXPECT_EQ(a[i].files, b[i].files);
        EXPECT_EQ(a[i].place, b[i].place);
    }
}

template <typename Part, typename... Tolerance>
void expectSameOptional(const std::optional<Part>& a,
                        const std::optional<Part>& b,
                        Tolerance... tolerance) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) expectSame(*a, *b, tolerance...);
}

inline void expectSamePose(const formats::FileChannel& a, const formats::FileChannel& b) {
    ASSERT_EQ(a.frustum.has_value(), b.frustum.has_value());
    if (a.frustum) {
        for (const formats::AngleName& name : formats::kAngleNames)
            EXPECT_EQ((*a.frustum).*name.angle, (*b.frustum).*name.angle) << name.name;
    }
    ASSERT_EQ(a.coordinateFrame.has_value(), b.coordinateFrame.has_value());
    if (!a.coordinateFrame) return;
    for (const formats::AxisName& name : formats::kAxisNames)
        EXPECT_EQ((*a.coordinateFrame).*name.axis, (*b.coordinateFrame).*name.axis);
}

// To the last bit, but for samples, which may differ by a tolerance.
inline void expectSame(const formats::WallFile& a,
                       const formats::WallFile& b,
                       float tolerance = 0) {
    EXPECT_EQ(a.profile, b.profile);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.date, b.date);
    expectSame(a.extensions, b.extensions);
    ASSERT_EQ(a.channels.size(), b.channels.size());
    for (std::size_t i = 0; i < a.channels.size(); ++i) {
        const formats::FileChannel& x = a.channels[i];
        const formats::FileChannel& y = b.channels[i];
        SCOPED_TRACE(x.name);
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.sizePixels, y.sizePixels);
        EXPECT_EQ(x.buffer, y.buffer);
        EXPECT_EQ(x.bufferPixels, y.bufferPixels);
        EXPECT_EQ(x.corner, y.corner);
        EXPECT_EQ(x.extent, y.extent);
        EXPECT_EQ(x.interpolation, y.interpolation);
        expectSamePose(x, y);
        expectSameOptional(x.warp, y.warp, tolerance);
        expectSameOptional(x.distortion, y.distortion, tolerance);
        expectSameOptional(x.blend, y.blend);
        expectSameOptional(x.black, y.black);
        expectSameOptional(x.colour, y.colour);
        expectSame(x.extensions, y.extensions);
    }
}

// A manifest of one region, "a", as plain as can be. {ROOT} and the like are places for what a test
// adds.
inline constexpr const char* kManifest = R"(<?xml version="1.0" encoding="UTF-8"?>
<MPCDI profile="2d" date="2026-11-24 10:11:12" level="1" version="1.0">
  <display>
    <buffer id="buffer1" Xresolution="8" Yresolution="6">
      <region id="a" Xresolution="4" Yresolution="2" x="0" y="0" xsize="1" ysize="1"/>
    </buffer>
  </display>
  <files>
    <fileset region="a">
      <geometryWarpFile><path>a.pfm</path><interpolation>linear</interpolation></geometryWarpFile>
      <alphaMap/>
    </fileset>
  </files>
</MPCDI>
)";

// Texels of 4 x 2, bottom row first: 0.125 0.125, 0.25 0.125, ... and the top row with 0.75.
[[nodiscard]] inline formats::Pfm smallPfm() {
    formats::Pfm pfm{.size = {4, 2}, .texels = {}};
    for (int i = 0; i < 8; ++i)
        pfm.texels.emplace_back(
            0.125F * static_cast<float>(i % 4 + 1), i < 4 ? 0.125F : 0.75F, 0.0F);
    return pfm;
}

// An archive of a manifest and a.pfm.
[[nodiscard]] inline std::vector<std::byte> archiveOf(const std::string& manifest,
                                                      const formats::Pfm& pfm = smallPfm(),
                                                      const std::string& name = "mpcdi.xml") {
    return formats::encodeArchive({{name, bytesOf(manifest)}, {"a.pfm", formats::encodePfm(pfm)}});
}

}  // namespace aquarama::test
