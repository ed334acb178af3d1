// SPDX-License-Identifier: Apache-2.0
// A small file of each vendor's format, with values that tests know; also what fuzzing starts from.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {

using SampleBytes = std::vector<std::byte>;

// Little-endian bytes, one number after the other.
class SampleWriter {
  public:
    SampleWriter& text(std::string_view letters) {
        for (const char letter : letters) bytes.push_back(static_cast<std::byte>(letter));
        return *this;
    }
    SampleWriter& number(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> 8 * i));
        return *this;
    }
    SampleWriter& floats(std::initializer_list<float> values) {
        for (const float value : values) number(std::bit_cast<std::uint32_t>(value), 4);
        return *this;
    }
    SampleWriter& zeros(std::size_t count) {
        bytes.resize(bytes.size() + count);
        return *this;
    }
    SampleBytes bytes;
};

using test::bytesOf;

// Seen from (1, 2, 3), turned 90 degrees to the left; 2 by 2 vertices at the corners, which show
// the inner half of the picture of the frustum.
struct SampleSciss {
    std::uint8_t version = 1;
    std::uint32_t type = 0, first = 2, second = 2;
    float right = 1;  // place of the right vertices
};

inline SampleBytes sciss(const SampleSciss& sample = {}) {
    SampleWriter out;
    out.text("SGC").number(sample.version, 1).number(sample.type, 4);
    out.floats({0, 0.70710678F, 0, 0.70710678F}).floats({1, 2, 3}).floats({30, -20, -45, 40});
    out.number(sample.first, 4).number(sample.second, 4);
    out.floats({0, 0, 0, 0.25F, 0.75F, 0}).floats({sample.right, 0, 0, 0.75F, 0.75F, 0});
    out.floats({0, 1, 0, 0.25F, 0.25F, 0}).floats({sample.right, 1, 0, 0.75F, 0.25F, 0});
    out.number(4, 4).number(0, 4).number(2, 4).number(1, 4).number(3, 4);
    return out.bytes;
}

// One channel of 2 by 2 records, of which the last shows nothing.
struct SampleVioso {
    std::uint32_t blocks = 1, flags = 0, width = 2, height = 2, dataBytes = 64;
    bool points = false;
    float blackScale = 0;
};

inline SampleBytes viosoWarp(const SampleVioso& sample) {
    SampleWriter out;
    out.text("vwf0").number(380, 4).number(sample.flags | (sample.points ? 0x40U : 0U), 4);
    out.number(0, 4).number(sample.dataBytes, 4).number(sample.width, 4).number(sample.height, 4);
    out.zeros(68).floats({sample.blackScale}).zeros(24).text("left").zeros(252);
    const float third = sample.points ? 3.0F : 1.0F;
    const float fourth = sample.points ? 1.0F : 0.0F;
    out.floats({0.25F, 0.125F, third, fourth}).floats({0.75F, 0.125F, third, fourth});
    out.floats({0.25F, 0.875F, third, fourth}).floats({0.75F, 0.875F, 0, 0});
    return out.bytes;
}

// Two by two pixels, of which the lower left is the grey `code` and the others are black.
inline SampleBytes viosoBitmap(int bits, bool topFirst, std::uint64_t code) {
    const std::size_t pixel = static_cast<std::size_t>(bits) / 8;
    const std::size_t colour = bits > 64 ? 4 : bits > 32 ? 2 : 1;
    const std::size_t row = (2 * pixel + 3) / 4 * 4;
    SampleWriter out;
    out.text("BM").number(54 + 2 * row, 4).number(0, 4).number(54, 4).number(40, 4).number(2, 4);
    out.number(topFirst ? 0xfffffffeU : 2U, 4).number(1, 2).number(static_cast<unsigned>(bits), 2);
    out.zeros(24);
    if (topFirst) out.zeros(row);
    for (int c = 0; c < 3; ++c) out.number(code, static_cast<int>(colour));
    out.zeros(row - 3 * colour);
    if (!topFirst) out.zeros(row);
    return out.bytes;
}

inline SampleBytes vioso(const SampleVioso& sample, const std::vector<SampleBytes>& more = {}) {
    SampleWriter out;
    out.text("vwf1").number(sample.blocks, 4).number(16, 4).number(0, 4);
    std::vector<SampleBytes> blocks = more;
    blocks.insert(blocks.begin(), viosoWarp(sample));
    for (const SampleBytes& block : blocks)
        out.bytes.insert(out.bytes.end(), block.begin(), block.end());
    return out.bytes;
}

inline constexpr std::string_view kScalable = R"(OPENMESH Version 1.1
VERTICES 4
FACES 2
MAPPING NORMALIZED
SAMPLING LINEAR
PROJECTION PERSPECTIVE
ORTHO_LEFT 0.000000
ORTHO_RIGHT 1.000000
ORTHO_TOP 1.000000
ORTHO_BOTTOM 0.000000
PERSPECTIVE_XOFFSET 1
PERSPECTIVE_YOFFSET 2
PERSPECTIVE_ZOFFSET 3
PERSPECTIVE_ROLL 0
PERSPECTIVE_PITCH 10
PERSPECTIVE_YAW 0
PERSPECTIVE_LEFT -40
PERSPECTIVE_RIGHT 40
PERSPECTIVE_TOP 30
PERSPECTIVE_BOTTOM -30
NATIVEXRES 8
NATIVEYRES 4
SUBVERSION 5
GAMMA 2.0
LABEL left
0 0 255 0.25 0.25
8 0 255 0.75 0.25
0 4 0 0.25 0.75
8 4 0 0.75 0.75
[ 0 1 3 ]
[ 0 3 2 ]
)";

inline constexpr std::string_view kDomeprojection =
    "x;y;u;v;column;row\n0;0;0.1;0.2;0;0\n0.5;0;0.5;0.2;1;0\n1;0;0.9;0.2;2;0\n"
    "0;1;0.1;0.8;0;1\n0.5;1;0.5;0.8;1;1\n1;1;0.9;0.8;2;1\n";

inline constexpr std::string_view kFrustum =
    "x;y;z;heading;pitch;bank;left;right;bottom;top;tanLeft;tanRight;tanBottom;tanTop;width;"
    "height\n"
    "1;2;3;-45;10;5;50;40;-7;70;1;1;1;1;0;0\n";

// Nine nodes; the middle one is a quarter of the picture to the right and an eighth down.
inline constexpr std::string_view kSimcad = R"(<?xml version="1.0" encoding="UTF-8"?>
<GeometryFile>
    <GeometryDefinition>
        <X-FlatParameters range="16">0 0 0 0 4 0 0 0 0</X-FlatParameters>
        <Y-FlatParameters range="8">0 0 0 0 1 0 0 0 0 </Y-FlatParameters>
    </GeometryDefinition>
</GeometryFile>
)";

// Bottom row first, as wide as it is high twice.
inline constexpr std::string_view kPaulBourke =
    "2\n3 2\n-2 -1 0.1 0.2 1\n0 -1 0.5 0.2 0.5\n2 -1 0.9 0.2 1\n"
    "-2 1 0.1 0.8 1\n0 1 0.5 0.8 0.5\n2 1 0.9 0.8 1\n";

inline constexpr std::string_view kObj =
    "# a screen\no screen\nv -2 0 -3\nv 2 0 -3\nv 2 1 -3\nv -2 1 -3\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";

}  // namespace aquarama::formats
