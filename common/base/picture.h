// SPDX-License-Identifier: Apache-2.0
// Pictures as they are stored (sRGB codes) and as light (linear), and the only conversions between
// the two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama {

// Codes of 8 or 16 bits (`bits`), red green blue, top row first: 3 * width * height of them.
struct Picture {
    glm::ivec2 sizePixels{};
    int bits = 8;
    std::vector<std::uint16_t> rgb;
};

// Linear light with the primaries of Rec. 709; 1 is a projector's full white. Top row first.
struct Light {
    glm::ivec2 sizePixels{};
    std::vector<glm::vec3> rgb;

    // Column x and row y, both within the picture.
    [[nodiscard]] const glm::vec3& at(int x, int y) const { return rgb[index(x, y)]; }
    [[nodiscard]] glm::vec3& at(int x, int y) { return rgb[index(x, y)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(sizePixels.x) +
               static_cast<std::size_t>(x);
    }
};
// The luminance of linear light with the primaries of Rec. 709.
[[nodiscard]] inline double luminance(glm::dvec3 rgb) {
    return glm::dot(rgb, {0.2126, 0.7152, 0.0722});
}
// All black.
[[nodiscard]] Light darkness(glm::ivec2 sizePixels);

// The transfer functions of sRGB (IEC 61966-2-1), both ways between 0 and 1.
[[nodiscard]] double srgbFromLinear(double linear);
[[nodiscard]] double linearFromSrgb(double encoded);

// Dither: noise with a triangular distribution from -1 to 1 code, the same for the same place and
// seed.
[[nodiscard]] double ditherCodes(std::uint32_t x, std::uint32_t y, std::uint32_t seed);

// Codes to light. Exact: each code has one value.
[[nodiscard]] Light lightOf(const Picture& picture);
// Light to codes of 8 or 16 `bits`. With 8 bits the codes are dithered, with 16 only rounded. Light
// outside of 0 to 1 is clipped; black stays black. firstRow: of a band of rows, its place in the
// whole picture, which the dither follows.
[[nodiscard]] Picture pictureOf(const Light& light,
                                int bits,
                                std::uint32_t ditherSeed,
                                int firstRow = 0);

// Bilinear interpolation between the centres of pixels, which are at +0.5; outside of them the
// colour of the border continues. The picture must not be empty.
[[nodiscard]] glm::vec3 bilinear(const Light& light, glm::dvec2 pixel);

// Pictures to and from PNG files.

// A picture as PNG has it.
struct PngPicture {
    glm::ivec2 sizePixels{};
    int components = 3;  // 1: grey; 3: red green blue; 4: and straight alpha, only written
    int bits = 8;        // or 16
    std::vector<std::uint16_t> codes;
};
// The meaning of the codes: sRGB, which the file then declares, or a meaning of the caller's.
enum class PngMeaning : std::uint8_t { Srgb, Unsaid };

// Limits of the pictures that are read, in pixels each way and in all.
inline constexpr int kMostPixelsEachWay = 16384;
inline constexpr int kMostPixels = 1 << 26;

// Decodes a PNG. Palettes become red green blue, transparency is dropped, 16 bits stay 16, fewer
// become 8. Throws Error, which names the source, where the bytes are not a readable picture within
// these limits.
[[nodiscard]] PngPicture decodePng(std::span<const std::byte> bytes, const std::string& source);
// Encodes a PNG. Throws Error where memory is short.
[[nodiscard]] std::vector<std::byte> encodePng(const PngPicture& picture, PngMeaning meaning);

// Encodes a picture of sRGB codes band by band, from the top: only the compressed file and one band
// are in memory. Throws Error where memory is short.
class PngBands {
  public:
    // bits: 8 or 16.
    PngBands(glm::ivec2 sizePixels, int bits);
    ~PngBands();
    PngBands(const PngBands&) = delete;
    PngBands& operator=(const PngBands&) = delete;
    // The next rows, of the picture's width and bits.
    void add(const Picture& band);
    // The file, after all rows.
    [[nodiscard]] std::vector<std::byte> finish();

  private:
    struct Job;
    std::unique_ptr<Job> job_;
};

// Reads a file as decodePng() does, with grey as red green blue.
[[nodiscard]] Picture readPng(const std::string& path);
// Writes a file with the 8 or 16 bits of the picture. Throws Error when it cannot be written.
void writePng(const std::string& path, const Picture& picture);

}  // namespace aquarama
