// SPDX-License-Identifier: Apache-2.0
#include "common/formats/pfm.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "common/base/log.h"
#include "common/formats/archive.h"

namespace aquarama::formats {

namespace {

constexpr std::uint32_t kMostSide = 16384;
constexpr std::size_t kTexelBytes = sizeof(glm::vec3);
static_assert(kTexelBytes == 12);
constexpr float kZero = 1e-5F;   // other tools take this for zero
constexpr float kNudge = 1e-4F;  // and this not

bool isSpace(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

// The header of a map, part after part.
struct Header {
    std::string_view rest;

    // The next part, at most 64 characters; behind it the one white space that ends it.
    std::string_view part() {
        while (!rest.empty() && isSpace(rest.front())) rest.remove_prefix(1);
        const std::string_view head = rest.substr(0, 64);
        const auto end = std::ranges::find_if(head, isSpace);
        const auto length = static_cast<std::size_t>(end - head.begin());
        rest.remove_prefix(std::min(rest.size(), length + 1));
        return head.substr(0, length);
    }
};

template <typename Number>
std::optional<Number> parsedNumber(std::string_view text) {
    Number number{};
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

struct Layout {
    glm::ivec2 size{};
    bool isBigEndian = false;
    std::string_view texels;
    double scale = 1;
};

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
    throw Error(source + ": " + why + "; export it anew");
}

// A number of texels one way.
int sideOf(std::string_view text, const std::string& source) {
    const auto side = parsedNumber<std::uint32_t>(text);
    if (!side || *side < 1 || *side > kMostSide)
        refuse(source,
               fmt::format("has \"{}\" texels one way, not 1 to {}", printable(text), kMostSide));
    return static_cast<int>(*side);
}

// Negative: little-endian. How much more it says is of no use to a warp.
double scaleOf(std::string_view text, const std::string& source) {
    const auto scale = parsedNumber<double>(text);
    if (!scale || !std::isfinite(*scale) || *scale == 0)
        refuse(source, fmt::format("has a scale of \"{}\"", printable(text)));
    return *scale;
}

Layout layoutOf(std::string_view file, const std::string& source) {
    Header header{file};
    const std::string_view kind = header.part();
    if (kind == "Pf")
        refuse(source, "is a grey float map, Pf, where one of colours, PF, is needed");
    if (kind != "PF") refuse(source, "is no float map: it does not begin with PF");
    const int width = sideOf(header.part(), source);
    const int height = sideOf(header.part(), source);
    const double scale = scaleOf(header.part(), source);
    const std::size_t bytes =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * kTexelBytes;
    // A header with the ends of lines of Windows leaves one of their two characters.
    if (header.rest.size() == bytes + 1 && header.rest.front() == '\n')
        header.rest.remove_prefix(1);
    if (header.rest.size() != bytes)
        refuse(source,
               fmt::format("has {} bytes of texels where {} x {} need {}",
                           header.rest.size(),
                           width,
                           height,
                           bytes));
    return {{width, height}, scale > 0, header.rest, std::abs(scale)};
}

void swapBytes(std::span<glm::vec3> texels) {
    for (glm::vec3& texel : texels)
        for (int i = 0; i < 3; ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(texel[i]);
            texel[i] = std::bit_cast<float>(__builtin_bswap32(bits));
        }
}

// sample = at + by * texel, for each of the three.
struct Affine {
    glm::dvec3 at{}, by{};
};

// Where an even grid has a sample.
double evenly(int index, int count, Sampling sampling) {
    if (sampling == Sampling::Centres || count == 1) return (index + 0.5) / count;
    return static_cast<double>(index) / (count - 1);
}

// At column and row of the picture, top row first. The third number is used for the Screen alone.
Affine affineAt(const TexelMeaning& meaning, glm::ivec2 size, int column, int row) {
    if (meaning.profile == Profile::Screen) return {{}, glm::dvec3(meaning.unitMetres)};
    if (meaning.stored == Stored::Offsets)
        return {
            {evenly(column, size.x, meaning.sampling), evenly(row, size.y, meaning.sampling), 0},
            {1, -1, 0}};
    if (meaning.profile != Profile::Content || meaning.stored == Stored::WholeBuffer)
        return {{0, 1, 0}, {1, -1, 0}};
    const glm::dvec2 bottomLeft(meaning.corner.x, meaning.corner.y + meaning.extent.y);
    return {{bottomLeft, 0}, {meaning.extent.x, -meaning.extent.y, 0}};
}

bool isZero(glm::vec3 texel) {
    return std::abs(texel.x) < kZero && std::abs(texel.y) < kZero && std::abs(texel.z) < kZero;
}

bool isLit(glm::vec3 texel, const TexelMeaning& meaning) {
    if (!std::isfinite(texel.x) || !std::isfinite(texel.y)) return false;
    if (meaning.profile == Profile::Screen && !std::isfinite(texel.z)) return false;
    return meaning.stored == Stored::Offsets || !isZero(texel);
}

float sampleOf(float texel, double at, double by) {
    return by == 0 ? 0 : static_cast<float>(at + by * static_cast<double>(texel));
}

glm::vec3 sampleOf(glm::vec3 texel, const Affine& affine, const TexelMeaning& meaning) {
    if (!isLit(texel, meaning)) return glm::vec3(kUnlit);
    glm::vec3 sample{};
    for (int i = 0; i < 3; ++i) sample[i] = sampleOf(texel[i], affine.at[i], affine.by[i]);
    return sample;
}

bool isSame(glm::vec3 a, glm::vec3 b) {
    return a == b || (std::isnan(a.x) && std::isnan(b.x));
}

// The texel that gives the sample: the nearest float, or a neighbour where rounding needs it.
float texelOf(float sample, double at, double by) {
    if (by == 0) return 0;
    constexpr double kMost = std::numeric_limits<float>::max();
    const double exact = (static_cast<double>(sample) - at) / by;
    const auto nearest = static_cast<float>(std::clamp(exact, -kMost, kMost));
    for (const float texel : {nearest,
                              std::nextafter(nearest, -std::numeric_limits<float>::max()),
                              std::nextafter(nearest, std::numeric_limits<float>::max())})
        if (sampleOf(texel, at, by) == sample) return texel;
    return nearest;
}

glm::vec3 litTexel(glm::vec3 sample, const Affine& affine, Stored stored) {
    glm::vec3 texel{};
    for (int i = 0; i < 3; ++i) texel[i] = texelOf(sample[i], affine.at[i], affine.by[i]);
    // Three zeros would be read as unlit; NaN as the third number prevents that.
    if (stored == Stored::Offsets)
        texel.z = kUnlit;
    else if (isZero(texel))
        texel.x = kNudge;
    return texel;
}

// The least, the most and the mean of what is finite of one number of all texels.
struct Spread {
    double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;
    std::size_t count = 0;

    void add(float value) {
        if (!std::isfinite(value)) return;
        least = std::min(least, static_cast<double>(value));
        most = std::max(most, static_cast<double>(value));
        sum += static_cast<double>(value);
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

std::array<Spread, 2> spreadOf(const Pfm& pfm, bool zerosCount) {
    std::array<Spread, 2> spread;
    for (const glm::vec3& texel : pfm.texels) {
        if (!zerosCount && isZero(texel)) continue;
        spread[0].add(texel.x);
        spread[1].add(texel.y);
    }
    return spread;
}

// Whether values cover this part of the buffer, to one hundredth; false for the whole buffer.
bool covers(const Spread& spread, double from, double extent) {
    constexpr double kNear = 0.01;
    return extent >= 1 || (std::abs(spread.least - from) <= kNear &&
                           std::abs(spread.most - (from + extent)) <= kNear);
}

bool isOfWholeBuffer(const TexelMeaning& meaning, const Pfm& pfm) {
    if (meaning.extent.x >= 1 && meaning.extent.y >= 1) return false;
    const auto [u, v] = spreadOf(pfm, false);
    return covers(u, meaning.corner.x, meaning.extent.x) &&
           covers(v, 1 - meaning.corner.y - meaning.extent.y, meaning.extent.y);
}

// Places lie around the middle of the picture, offsets on both sides of zero. A map of zeros alone
// moves nothing.
bool isOfOffsets(const Pfm& pfm) {
    constexpr double kNear = 0.15;
    const auto [u, v] = spreadOf(pfm, true);
    if (u.count == 0 || v.count == 0) return false;
    const double least = std::min(u.least, v.least);
    const double most = std::max(u.most, v.most);
    return least * most <= 0 && (least < 0) == (most > 0) &&
           std::max(std::abs(u.mean()), std::abs(v.mean())) < kNear;
}

template <typename Change>
void forEach(std::vector<glm::vec3>& texels, glm::ivec2 size, const Change& change) {
    std::size_t index = 0;
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column) change(texels[index++], column, row);
}

}  // namespace

Pfm decodePfm(std::span<const std::byte> bytes, const std::string& source) {
    const Layout layout =
        layoutOf({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, source);
    Pfm pfm;
    pfm.size = layout.size;
    pfm.scale = layout.scale;
    pfm.texels.resize(layout.texels.size() / kTexelBytes);
    std::memcpy(pfm.texels.data(), layout.texels.data(), layout.texels.size());
    if (layout.isBigEndian == (std::endian::native == std::endian::little)) swapBytes(pfm.texels);
    return pfm;
}

std::vector<std::byte> encodePfm(const Pfm& pfm) {
    const std::string header = fmt::format("PF\n{} {}\n-1.000000\n", pfm.size.x, pfm.size.y);
    std::vector<std::byte> bytes(header.size() + pfm.texels.size() * kTexelBytes);
    std::memcpy(bytes.data(), header.data(), header.size());
    std::memcpy(bytes.data() + header.size(), pfm.texels.data(), pfm.texels.size() * kTexelBytes);
    static_assert(std::endian::native == std::endian::little, "texels are written as they lie");
    return bytes;
}

void turnOver(Pfm& pfm) {
    const auto columns = static_cast<std::ptrdiff_t>(pfm.size.x);
    for (int low = 0, high = pfm.size.y - 1; low < high; ++low, --high)
        std::swap_ranges(pfm.texels.begin() + low * columns,
                         pfm.texels.begin() + (low + 1) * columns,
                         pfm.texels.begin() + high * columns);
}

void guessMeaning(TexelMeaning& meaning, const Pfm& pfm) {
    meaning.stored = Stored::Places;
    meaning.sampling = Sampling::Centres;
    if (meaning.profile == Profile::Screen) return;
    if (meaning.profile == Profile::Content) {
        if (isOfWholeBuffer(meaning, pfm)) meaning.stored = Stored::WholeBuffer;
    } else if (isOfOffsets(pfm)) {
        meaning.stored = Stored::Offsets;
        meaning.sampling = Sampling::Nodes;
    }
}

std::string scaleRemark(const Pfm& pfm) {
    if (pfm.scale == 1) return "";
    return fmt::format("its scale of {} is not applied: export it with a scale of 1 or -1",
                       pfm.scale);
}

Warp warpOf(Pfm pfm, const TexelMeaning& meaning) {
    turnOver(pfm);
    Warp warp{.size = pfm.size,
              .sampling = meaning.sampling,
              .samples = pfm.texels,
              .stored = meaning.stored,
              .texels = {}};
    forEach(warp.samples, warp.size, [&](glm::vec3& sample, int column, int row) {
        sample = sampleOf(sample, affineAt(meaning, warp.size, column, row), meaning);
    });
    warp.texels = std::move(pfm.texels);
    return warp;
}

Pfm pfmOf(const Warp& warp, const TexelMeaning& meaning) {
    Pfm pfm{.size = warp.size, .texels = warp.samples};
    const bool hasOld = warp.texels.size() == warp.samples.size();
    std::size_t index = 0;
    forEach(pfm.texels, pfm.size, [&](glm::vec3& texel, int column, int row) {
        const Affine affine = affineAt(meaning, pfm.size, column, row);
        const glm::vec3 old = hasOld ? warp.texels[index] : glm::vec3();
        ++index;
        if (hasOld && isSame(sampleOf(old, affine, meaning), texel))
            texel = old;
        else
            texel =
                std::isnan(texel.x) ? glm::vec3(kUnlit) : litTexel(texel, affine, meaning.stored);
    });
    turnOver(pfm);
    return pfm;
}

bool isPfm(std::span<const std::byte> bytes) {
    return beginning(bytes, 2) == "PF";
}

namespace {

// Whether the texels are points of a screen: three finite numbers each, some beyond a picture.
bool areInSpace(const Pfm& pfm) {
    constexpr float kBeyondPicture = 2;
    bool isBeyond = false;
    for (const glm::vec3& texel : pfm.texels) {
        if (!std::isfinite(texel.x) || texel == glm::vec3(0)) continue;
        if (!std::isfinite(texel.z)) return false;
        isBeyond = isBeyond || std::abs(texel.x) > kBeyondPicture ||
                   std::abs(texel.y) > kBeyondPicture || std::abs(texel.z) > kBeyondPicture;
    }
    return isBeyond;
}

}  // namespace

WallFile readPfm(std::span<const std::byte> bytes,
                 const std::string& source,
                 const ReadOptions& options,
                 const FrustumFile& frustum) {
    Pfm pfm = decodePfm(bytes, source);
    if (options.upsideDown) turnOver(pfm);
    FileChannel channel;
    channel.name = stemOf(source);
    channel.sizePixels = options.sizePixels.value_or(pfm.size);
    TexelMeaning meaning;
    const bool isView = addFrustum(channel, frustum);
    meaning.profile = areInSpace(pfm) ? Profile::Screen : isView ? Profile::View : Profile::Content;
    guessMeaning(meaning, pfm);
    meaning.sampling = options.sampling.value_or(meaning.sampling);
    const std::string said = scaleRemark(pfm);
    channel.warp = warpOf(std::move(pfm), meaning);
    WallFile wall = oneChannel(meaning.profile, std::move(channel));
    if (!said.empty()) remark(wall.remarks, source + ": " + said);
    return wall;
}

}  // namespace aquarama::formats
