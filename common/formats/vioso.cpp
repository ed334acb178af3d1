// SPDX-License-Identifier: Apache-2.0
// Reads VIOSO vwf: blocks, each a warp with its header, or a Windows bitmap that belongs to the
// warp before it: blend, black level, white. Rows and v are from the top, as in the vendor's own
// shaders.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/base/log.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

constexpr std::size_t kRecordBytes = 16;
constexpr std::size_t kNameAt = 124, kNameBytes = 256, kBlackScaleAt = 96, kContentAt = 4512;
constexpr std::size_t kLeastHeader = 28, kMostHeader = std::size_t{1} << 20;
constexpr std::uint32_t kZipped = 0x1, kBorder = 0x8, kBlackLevel = 0x20, kPoints = 0x40,
                        kEncrypted = 0x400;
// Records that the vendor's shaders do not show.
constexpr float kUnlitBelow = 0.1F;
constexpr double kBitmapMost8 = 255, kBitmapMost16 = 65535;
constexpr double kMostScale = 1e4;  // of a black level

struct ViosoHeader {
    std::uint32_t flags = 0, dataBytes = 0, width = 0, height = 0;
    double blackScale = 0;
    std::array<double, 4> content{};  // left, top, right, bottom of the content's part
    std::string name;
};

struct ViosoChannel {
    FileChannel channel;
    ViosoHeader header;
    int bitmaps = 0;
    std::vector<std::string> remarks = {};
};

bool isWarpMagic(std::string_view magic) {
    return magic == "vwf0" || magic == "vwf2" || magic == "vwf3";
}

std::string magicAt(VendorBytes& in) {
    in.need(1, 4, "blocks");
    const std::size_t begin = in.at();
    std::string magic;
    for (int i = 0; i < 4; ++i) magic += static_cast<char>(in.u8());
    in.go(begin);
    return magic;
}

// A text of a fixed number of bytes, up to its first zero, without control characters.
std::string textAt(VendorBytes& in, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < most; ++i) {
        const std::uint8_t letter = in.u8();
        if (letter == 0) break;
        if (letter >= ' ' && letter != 0x7f) text += static_cast<char>(letter);
    }
    return text;
}

void refuseUnreadable(const VendorBytes& in, const ViosoHeader& header) {
    if ((header.flags & kEncrypted) != 0)
        in.fail("the warp is encrypted for one maker's programs; export it without a key");
    if ((header.flags & kZipped) != 0) in.fail("the warp is compressed; export it plain");
    if (!pictureSize(header.width, header.height))
        in.fail("no picture has " + std::to_string(header.width) + " by " +
                std::to_string(header.height) + " pixels; export it anew");
    const std::uint64_t bytes = std::uint64_t{header.width} * header.height * kRecordBytes;
    if (header.dataBytes != 0 && header.dataBytes != bytes)
        in.fail("the warp of " + std::to_string(header.width) + " by " +
                std::to_string(header.height) + " pixels takes " +
                std::to_string(header.dataBytes) + " bytes; export it anew");
}

// Headers of later versions are longer; missing values are zero.
void readLaterFields(VendorBytes& in, std::size_t begin, std::size_t bytes, ViosoHeader& header) {
    const auto has = [&](std::size_t at, std::size_t size) {
        if (at + size > bytes) return false;
        in.go(begin + at);
        return true;
    };
    if (has(kBlackScaleAt, 4)) header.blackScale = static_cast<double>(in.f32());
    if (has(kNameAt, kNameBytes)) header.name = textAt(in, kNameBytes);
    if (!has(kContentAt, 16)) return;
    for (double& edge : header.content) edge = static_cast<double>(in.f32());
}

ViosoHeader readViosoHeader(VendorBytes& in) {
    const std::size_t begin = in.at();
    in.go(begin + 4);
    const std::uint32_t bytes = in.u32();
    if (bytes < kLeastHeader || bytes > kMostHeader)
        in.fail("no header has " + std::to_string(bytes) + " bytes; copy it anew");
    in.go(begin);
    in.need(1, bytes, "bytes of header");
    ViosoHeader header;
    in.go(begin + 8);
    header.flags = in.u32();
    in.go(begin + 16);
    header.dataBytes = in.u32();
    header.width = in.u32();
    header.height = in.u32();
    readLaterFields(in, begin, bytes, header);
    refuseUnreadable(in, header);
    in.go(begin + bytes);
    return header;
}

// Nothing is shown, or with the border flag the content without its hundredth at each side.
glm::vec3 contentRecord(VendorBytes& in, bool border) {
    glm::vec3 sample(0);
    sample.x = in.f32();
    sample.y = in.f32();
    const float valid = in.f32();
    in.go(in.at() + 4);
    if (!(valid > kUnlitBelow) || !std::isfinite(sample.x + sample.y)) return glm::vec3(kUnlit);
    if (border) sample = {sample.x * 1.02F - 0.01F, sample.y * 1.02F - 0.01F, 0};
    return sample;
}

// A point in metres; three NaN where nothing is lit.
glm::vec3 pointRecord(VendorBytes& in) {
    glm::vec3 sample;
    for (int i = 0; i < 3; ++i) sample[i] = in.f32();
    const float valid = in.f32();
    const bool lit = valid > kUnlitBelow && std::isfinite(sample.x + sample.y + sample.z);
    return lit ? sample : glm::vec3(kUnlit);
}

Warp readRecords(VendorBytes& in, const ViosoHeader& header, bool upsideDown) {
    in.need(std::uint64_t{header.width} * header.height, kRecordBytes, "records of the warp");
    Warp warp{{header.width, header.height}, Sampling::Centres, {}};
    warp.samples.resize(std::size_t{header.width} * header.height);
    const bool points = (header.flags & kPoints) != 0, border = (header.flags & kBorder) != 0;
    for (std::size_t row = 0; row < header.height; ++row) {
        const std::size_t shown = upsideDown ? header.height - 1 - row : row;
        glm::vec3* samples = warp.samples.data() + shown * header.width;
        for (std::size_t i = 0; i < header.width; ++i)
            samples[i] = points ? pointRecord(in) : contentRecord(in, border);
    }
    return warp;
}

// The part of the content that the channel shows, if the header has it. True where its values
// cannot be a part.
bool placeInContent(FileChannel& channel, const std::array<double, 4>& content) {
    const auto [left, top, right, bottom] = content;
    const auto isPart = [](double low, double high) { return low >= 0 && low < high && high <= 1; };
    if (!isPart(left, right) || !isPart(top, bottom))
        return content != std::array<double, 4>{};  // four zeros: no value
    channel.corner = {left, top};
    channel.extent = {right - left, bottom - top};
    return false;
}

// A warp without data has a header alone: its channel has no warp.
ViosoChannel readWarp(VendorBytes& in, std::size_t number, bool upsideDown) {
    ViosoChannel read;
    read.header = readViosoHeader(in);
    FileChannel& channel = read.channel;
    channel.name =
        read.header.name.empty() ? "channel " + std::to_string(number) : read.header.name;
    channel.sizePixels = {read.header.width, read.header.height};
    if (placeInContent(channel, read.header.content))
        remark(read.remarks,
               "its part of the content is none, so it shows the whole: compare the picture with "
               "the producer's");
    if (read.header.dataBytes != 0) channel.warp = readRecords(in, read.header, upsideDown);
    return read;
}

// A Windows bitmap: rows padded to 4 bytes, bottom row first unless the height is negative.
struct Bitmap {
    std::size_t begin = 0, end = 0, pixels = 0;  // bytes of the file
    int width = 0, height = 0, bits = 0;
    bool topFirst = false;
    [[nodiscard]] std::size_t rowBytes() const {
        return (static_cast<std::size_t>(width) * static_cast<std::size_t>(bits) + 31) / 32 * 4;
    }
};

Bitmap readBitmapHeader(VendorBytes& in) {
    Bitmap bitmap;
    bitmap.begin = in.at();
    in.need(1, 54, "bytes of a bitmap's header");
    in.go(bitmap.begin + 2);
    const std::uint32_t bytes = in.u32();
    in.go(bitmap.begin + 10);
    bitmap.pixels = bitmap.begin + in.u32();
    in.go(bitmap.begin + 18);
    const std::uint32_t width = in.u32();
    const std::uint32_t height = in.u32();
    bitmap.topFirst = height > 0x7fffffffU;
    const std::uint32_t rows = bitmap.topFirst ? 0U - height : height;
    in.go(bitmap.begin + 28);
    bitmap.bits = in.u16();
    const std::uint32_t compression = in.u32();
    bitmap.end = std::max(bitmap.pixels, bitmap.begin + bytes);
    if (width == 0 || rows == 0) return bitmap;  // a placeholder for a missing map
    if (!pictureSize(width, rows)) in.fail("no bitmap is so large; export it anew");
    if (compression != 0) in.fail("the bitmap is compressed; export it plain");
    bitmap.width = static_cast<int>(width);
    bitmap.height = static_cast<int>(rows);
    return bitmap;
}

// One colour of a pixel as a share of white.
double readCode(VendorBytes& in, int bytesEach) {
    if (bytesEach == 1) return in.u8() / kBitmapMost8;
    if (bytesEach == 2) return in.u16() / kBitmapMost16;
    const auto value = static_cast<double>(in.f32());
    return value >= 0 ? std::min(value, 1.0) : 0;
}

// The layout of the pixels of a bitmap, by their number of bits.
struct PixelLayout {
    int bits = 0;
    int bytesEach = 1;      // of a colour
    int colours = 3;        // with an unused fourth one
    bool redFirst = false;  // else blue
};
constexpr std::array kLayouts{PixelLayout{24, 1, 3, false},
                              PixelLayout{32, 1, 4, false},
                              PixelLayout{48, 2, 3, false},
                              PixelLayout{64, 2, 4, true},
                              PixelLayout{96, 4, 3, false},
                              PixelLayout{128, 4, 4, true}};

PixelLayout layoutOf(const VendorBytes& in, int bits) {
    const auto* found = std::ranges::find(kLayouts, bits, &PixelLayout::bits);
    if (found == kLayouts.end())
        in.fail("a bitmap of " + std::to_string(bits) + " bits is not known; export 24");
    return *found;
}

// Three equal components become one.
void mergeGrey(Mask& mask) {
    const auto& codes = mask.codes;
    for (std::size_t i = 0; i < codes.size(); i += 3)
        if (codes[i] != codes[i + 1] || codes[i] != codes[i + 2]) return;
    for (std::size_t i = 0; i < codes.size(); i += 3) mask.codes[i / 3] = codes[i];
    mask.codes.resize(codes.size() / 3);
    mask.components = 1;
}

// The next pixel's colours as shares of white, red first.
std::array<double, 3> readPixel(VendorBytes& in, const PixelLayout& layout) {
    std::array<double, 3> colours{};
    for (double& colour : colours) colour = readCode(in, layout.bytesEach);
    if (layout.colours == 4) in.go(in.at() + static_cast<std::size_t>(layout.bytesEach));
    if (!layout.redFirst) std::swap(colours[0], colours[2]);
    return colours;
}

// The mask of a bitmap. scale: of a black level, in the file. Codes of 8 bits that are not scaled
// stay so.
Mask readBitmap(VendorBytes& in, const Bitmap& bitmap, double scale) {
    const PixelLayout layout = layoutOf(in, bitmap.bits);
    in.go(bitmap.pixels);
    in.need(static_cast<std::uint64_t>(bitmap.height), bitmap.rowBytes(), "rows of a bitmap");
    const bool shallow = layout.bytesEach == 1 && scale == 1;
    const double most = shallow ? kBitmapMost8 : kBitmapMost16;
    Mask mask{{bitmap.width, bitmap.height}, 3, shallow ? 8 : 16, kCommonGamma, {}};
    const std::size_t row = 3 * static_cast<std::size_t>(bitmap.width);
    const auto rows = static_cast<std::size_t>(bitmap.height);
    mask.codes.resize(row * rows);
    for (std::size_t y = 0; y < rows; ++y) {
        in.go(bitmap.pixels + y * bitmap.rowBytes());
        std::uint16_t* codes = mask.codes.data() + row * (bitmap.topFirst ? y : rows - 1 - y);
        for (std::size_t i = 0; i < row; i += 3)
            for (const double part : readPixel(in, layout))
                *codes++ =
                    static_cast<std::uint16_t>(std::lround(most * std::min(1.0, scale * part)));
    }
    mergeGrey(mask);
    return mask;
}

std::string unusedBitmap(int which) {
    return "bitmap " + std::to_string(which + 1) +
           " (white, or of later versions) is not used: measure the projectors by aquarama "
           "calibrate where their whites differ";
}

// Sets the blend, then the black level; the vendor uses no further bitmaps either.
void addBitmap(VendorBytes& in, ViosoChannel& to) {
    const Bitmap bitmap = readBitmapHeader(in);
    const int which = to.bitmaps++;
    const double scale = (to.header.flags & kBlackLevel) != 0 ? to.header.blackScale : 0;
    if (bitmap.width > 0) {
        if (which == 0) to.channel.blend = readBitmap(in, bitmap, 1);
        if (which == 1 && scale > 0)
            to.channel.black = readBitmap(in, bitmap, std::min(scale, kMostScale));
        if (which > 1) remark(to.remarks, unusedBitmap(which));
    }
    const std::size_t rows = static_cast<std::size_t>(bitmap.height) * bitmap.rowBytes();
    in.go(std::max(bitmap.end, bitmap.pixels + rows));
}

void readBlock(VendorBytes& in, std::vector<ViosoChannel>& channels, bool upsideDown) {
    const std::string magic = magicAt(in);
    if (isWarpMagic(magic))
        channels.push_back(readWarp(in, channels.size() + 1, upsideDown));
    else if (magic.starts_with("BM") && !channels.empty())
        addBitmap(in, channels.back());
    else
        in.fail("neither a warp nor a bitmap of a warp begins here; copy the file anew");
}

std::vector<ViosoChannel> readBlocks(VendorBytes& in, bool upsideDown) {
    // A file of one warp may have no header of a set, and then ends with its last block.
    std::optional<std::uint32_t> blocks;
    if (magicAt(in) == "vwf1") {
        in.go(4);
        blocks = in.u32();
        in.go(in.u32());
    }
    std::vector<ViosoChannel> channels;
    for (std::uint32_t i = 0; blocks ? i < *blocks : in.left() > 0; ++i)
        readBlock(in, channels, upsideDown);
    if (channels.empty()) in.fail("it has no channel; export it anew");
    return channels;
}

}  // namespace

bool isVioso(std::span<const std::byte> bytes) {
    const std::string_view magic = beginning(bytes, 4);
    return magic == "vwf1" || isWarpMagic(magic);
}

WallFile readVioso(std::span<const std::byte> bytes,
                   const std::string& source,
                   const ReadOptions& options) {
    VendorBytes in(bytes, source);
    const std::vector<ViosoChannel> read = readBlocks(in, options.upsideDown);
    const auto points = [](const ViosoChannel& one) { return (one.header.flags & kPoints) != 0; };
    WallFile file;
    file.profile = points(read.front()) ? Profile::Screen : Profile::Content;
    for (const ViosoChannel& one : read) {
        const std::string where = source + ": channel \"" + one.channel.name + "\": ";
        for (const std::string& said : one.remarks)
            remark(file.remarks, std::string(where).append(said));
        if (points(one) != points(read.front()))
            throw Error(source + ": channel \"" + one.channel.name +
                        "\": has points where others have content, or the other way; export it "
                        "anew");
        file.channels.push_back(one.channel);
    }
    return file;
}

}  // namespace aquarama::formats
