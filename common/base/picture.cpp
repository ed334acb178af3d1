// SPDX-License-Identifier: Apache-2.0
#include "common/base/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>
#include <utility>

#include <glm/common.hpp>
#include <png.h>

#include "common/base/files.h"
#include "common/base/hash.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

// The middle of one of 2^32 equal parts of (0, 1).
double unit(std::uint32_t bits) {
    return (bits + 0.5) / 4294967296.0;
}

// A table, since pow() for each pixel would take seconds.
std::vector<float> lightOfEveryCode(int bits) {
    std::vector<float> table(std::size_t{1} << bits);
    for (std::size_t code = 0; code < table.size(); ++code)
        table[code] = static_cast<float>(
            linearFromSrgb(static_cast<double>(code) / static_cast<double>(table.size() - 1)));
    return table;
}

// most: the largest code. Below one code of light the noise shrinks with the light, so that black
// stays black.
std::uint16_t codeOf(double linear, double most, double noise) {
    const double exact = srgbFromLinear(std::clamp(linear, 0.0, 1.0)) * most;
    const double code = exact + noise * std::min(1.0, exact);
    return static_cast<std::uint16_t>(std::clamp(std::floor(code + 0.5), 0.0, most));
}

// The largest file of such a picture with 16 bits, headers included.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 29;
// The compression level. A snapshot takes one second at this level, and five at the best one.
constexpr int kCompression = 3;

// The state of a read or write. Owned by decodePng(), encodePng() or PngBands, which longjmp() does
// not leave.
struct Job {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const std::byte> file;  // what is still to be read
    std::vector<std::byte> written;
    std::vector<png_byte> bytes;
    std::vector<png_bytep> rows;
    std::string complaint;
};

// libpng's error handler: keeps the message and jumps back.
void remember(png_structp png, png_const_charp what) {
    static_cast<Job*>(png_get_error_ptr(png))->complaint = what;
    std::longjmp(png_jmpbuf(png), 1);
}

void ignore(png_structp /*png*/, png_const_charp /*warning*/) {}

void take(png_structp png, png_bytep into, std::size_t count) {
    auto& file = static_cast<Job*>(png_get_io_ptr(png))->file;
    if (count > file.size()) png_error(png, "it is cut off");
    std::memcpy(into, file.data(), count);
    file = file.subspan(count);
}

// No exception may pass through libpng, and no jump may leave a handler.
bool append(std::vector<std::byte>& bytes, std::span<const png_byte> more) {
    try {
        const auto* first = reinterpret_cast<const std::byte*>(more.data());
        bytes.insert(bytes.end(), first, first + more.size());
        return true;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

void give(png_structp png, png_bytep from, std::size_t count) {
    if (!append(static_cast<Job*>(png_get_io_ptr(png))->written, {from, count}))
        png_error(png, "out of memory");
}

void keepNothing(png_structp /*png*/) {}

std::size_t rowBytes(const PngPicture& picture) {
    return static_cast<std::size_t>(picture.sizePixels.x) *
           static_cast<std::size_t>(picture.components * picture.bits / 8);
}

// Memory for the packed picture, and pointers to its rows, as libpng wants them.
void makeRows(Job& job, const PngPicture& picture) {
    const auto height = static_cast<std::size_t>(picture.sizePixels.y);
    job.rows.clear();
    job.bytes.resize(rowBytes(picture) * height);
    for (std::size_t y = 0; y < height; ++y)
        job.rows.push_back(job.bytes.data() + y * rowBytes(picture));
}

// Reads size and depth into `picture` and sets libpng's conversions. False after an error.
bool readHeader(Job& job, PngPicture& picture) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_set_read_fn(job.png, &job, take);
    png_set_user_limits(job.png, kMostPixelsEachWay, kMostPixelsEachWay);
    png_read_info(job.png, job.info);
    // A small file could otherwise make the program allocate all memory of the machine.
    if (png_get_image_width(job.png, job.info) * png_get_image_height(job.png, job.info) >
        png_uint_32{kMostPixels})
        png_error(job.png, "too many pixels");
    png_set_expand(job.png);
    png_set_strip_alpha(job.png);
    (void)png_set_interlace_handling(job.png);
    png_read_update_info(job.png, job.info);
    picture.sizePixels = {static_cast<int>(png_get_image_width(job.png, job.info)),
                          static_cast<int>(png_get_image_height(job.png, job.info))};
    picture.components = png_get_channels(job.png, job.info);
    picture.bits = png_get_bit_depth(job.png, job.info);
    return true;
}

// Read or write rows, and what is before and behind them. libpng may jump out of all of these.
// False after an error.
bool readRows(Job& job) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_read_image(job.png, job.rows.data());
    png_read_end(job.png, nullptr);
    return true;
}

int colourTypeOf(const PngPicture& picture) {
    if (picture.components == 4) return PNG_COLOR_TYPE_RGB_ALPHA;
    return picture.components == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY;
}

bool writeHeader(Job& job, const PngPicture& picture, PngMeaning meaning) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_set_write_fn(job.png, &job, give, keepNothing);
    png_set_compression_level(job.png, kCompression);
    png_set_IHDR(job.png,
                 job.info,
                 static_cast<png_uint_32>(picture.sizePixels.x),
                 static_cast<png_uint_32>(picture.sizePixels.y),
                 picture.bits,
                 colourTypeOf(picture),
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (meaning == PngMeaning::Srgb) png_set_sRGB(job.png, job.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(job.png, job.info);
    return true;
}

bool writeRows(Job& job) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_write_rows(job.png, job.rows.data(), static_cast<png_uint_32>(job.rows.size()));
    return true;
}

bool writeEnd(Job& job) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_write_end(job.png, nullptr);
    return true;
}

void openForWriting(Job& job) {
    job.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, remember, ignore);
    job.info = png_create_info_struct(job.png);
}

// Throws Error where a write has failed.
void requireWritten(bool whole, const Job& job) {
    if (!whole)
        throw Error("a picture cannot be written as PNG (" + job.complaint + "); make it smaller");
}

// From packed bytes to codes and back; 16-bit PNG is big-endian.
void unpack(const std::vector<png_byte>& bytes, PngPicture& picture) {
    const bool deep = picture.bits == 16;
    picture.codes.resize(deep ? bytes.size() / 2 : bytes.size());
    for (std::size_t i = 0; i < picture.codes.size(); ++i)
        picture.codes[i] =
            deep ? static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]) : bytes[i];
}

void pack(const PngPicture& picture, std::vector<png_byte>& bytes) {
    const bool deep = picture.bits == 16;
    for (std::size_t i = 0; i < picture.codes.size(); ++i) {
        if (deep) bytes[2 * i] = static_cast<png_byte>(picture.codes[i] >> 8);
        bytes[deep ? 2 * i + 1 : i] = static_cast<png_byte>(picture.codes[i] & 0xff);
    }
}

std::vector<std::uint16_t> threeOfEach(const std::vector<std::uint16_t>& grey) {
    std::vector<std::uint16_t> rgb;
    rgb.reserve(3 * grey.size());
    for (const std::uint16_t code : grey) rgb.insert(rgb.end(), 3, code);
    return rgb;
}

}  // namespace

Light darkness(glm::ivec2 sizePixels) {
    assert(sizePixels.x >= 0);
    assert(sizePixels.y >= 0);
    const auto count =
        static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y);
    Light light;
    light.sizePixels = sizePixels;
    light.rgb.assign(count, glm::vec3(0));
    return light;
}

double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double ditherCodes(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    const std::uint32_t pixel = hashOf(x + hashOf(y + hashOf(seed)));
    return unit(pixel) + unit(hashOf(pixel + 1)) - 1;
}

Light lightOf(const Picture& picture) {
    assert(picture.bits == 8 || picture.bits == 16);
    const std::vector<float> table = lightOfEveryCode(picture.bits);
    Light light = darkness(picture.sizePixels);
    assert(picture.rgb.size() == 3 * light.rgb.size());
    for (std::size_t i = 0; i < light.rgb.size(); ++i)
        light.rgb[i] = {table[picture.rgb[3 * i]],
                        table[picture.rgb[3 * i + 1]],
                        table[picture.rgb[3 * i + 2]]};
    return light;
}

Picture pictureOf(const Light& light, int bits, std::uint32_t ditherSeed, int firstRow) {
    assert(bits == 8 || bits == 16);
    const double most = (1 << bits) - 1;
    Picture picture;
    picture.sizePixels = light.sizePixels;
    picture.bits = bits;
    picture.rgb.reserve(3 * light.rgb.size());
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x)
            for (int c = 0; c < 3; ++c) {
                // Each colour has noise of its own.
                const auto column = static_cast<std::uint32_t>(3 * x + c);
                const auto row = static_cast<std::uint32_t>(firstRow + y);
                const double noise = bits == 8 ? ditherCodes(column, row, ditherSeed) : 0;
                const auto linear = static_cast<double>(light.at(x, y)[c]);
                picture.rgb.push_back(codeOf(linear, most, noise));
            }
    return picture;
}

glm::vec3 bilinear(const Light& light, glm::dvec2 pixel) {
    assert(!light.rgb.empty());
    const glm::dvec2 last(light.sizePixels - 1);
    const glm::dvec2 at = glm::clamp(pixel - 0.5, glm::dvec2(0), last);
    const glm::ivec2 low(at);
    const glm::ivec2 high = glm::min(low + 1, light.sizePixels - 1);
    const glm::vec2 t(at - glm::dvec2(low));
    return glm::mix(glm::mix(light.at(low.x, low.y), light.at(high.x, low.y), t.x),
                    glm::mix(light.at(low.x, high.y), light.at(high.x, high.y), t.x),
                    t.y);
}

// libpng reports errors by longjmp, which runs no destructors: so the functions that it may jump
// out of (readHeader to writeEnd) own nothing, and what they fill belongs to their
// callers.

PngPicture decodePng(std::span<const std::byte> bytes, const std::string& source) {
    Job job;
    job.file = bytes;
    job.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, remember, ignore);
    job.info = png_create_info_struct(job.png);
    PngPicture picture;
    bool whole = readHeader(job, picture);
    if (whole) {
        makeRows(job, picture);
        whole = readRows(job);
    }
    png_destroy_read_struct(&job.png, &job.info, nullptr);
    if (!whole)
        throw Error(source + ": is no whole PNG picture (" + job.complaint + "); write it anew");
    unpack(job.bytes, picture);
    return picture;
}

std::vector<std::byte> encodePng(const PngPicture& picture, PngMeaning meaning) {
    assert(picture.bits == 8 || picture.bits == 16);
    assert(picture.components == 1 || picture.components == 3 || picture.components == 4);
    assert(picture.codes.size() * static_cast<std::size_t>(picture.bits / 8) ==
           rowBytes(picture) * static_cast<std::size_t>(picture.sizePixels.y));
    Job job;
    openForWriting(job);
    makeRows(job, picture);
    pack(picture, job.bytes);
    const bool whole = writeHeader(job, picture, meaning) && writeRows(job) && writeEnd(job);
    png_destroy_write_struct(&job.png, &job.info);
    requireWritten(whole, job);
    return std::move(job.written);
}

struct PngBands::Job : aquarama::Job {
    PngPicture picture;  // without codes
};

PngBands::PngBands(glm::ivec2 sizePixels, int bits) : job_{std::make_unique<Job>()} {
    job_->picture = {.sizePixels = sizePixels, .components = 3, .bits = bits, .codes = {}};
    openForWriting(*job_);
    requireWritten(writeHeader(*job_, job_->picture, PngMeaning::Srgb), *job_);
}

PngBands::~PngBands() {
    png_destroy_write_struct(&job_->png, &job_->info);
}

void PngBands::add(const Picture& band) {
    assert(band.sizePixels.x == job_->picture.sizePixels.x);
    assert(band.bits == job_->picture.bits);
    const PngPicture rows{band.sizePixels, 3, band.bits, band.rgb};
    makeRows(*job_, rows);
    pack(rows, job_->bytes);
    requireWritten(writeRows(*job_), *job_);
}

std::vector<std::byte> PngBands::finish() {
    requireWritten(writeEnd(*job_), *job_);
    return std::move(job_->written);
}

Picture readPng(const std::string& path) {
    PngPicture read = decodePng(readWhole(path, kMostBytes), path);
    return {.sizePixels = read.sizePixels,
            .bits = read.bits,
            .rgb = read.components == 1 ? threeOfEach(read.codes) : std::move(read.codes)};
}

void writePng(const std::string& path, const Picture& picture) {
    writeWhole(path,
               encodePng({.sizePixels = picture.sizePixels,
                          .components = 3,
                          .bits = picture.bits,
                          .codes = picture.rgb},
                         PngMeaning::Srgb));
}

}  // namespace aquarama
