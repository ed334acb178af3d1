// SPDX-License-Identifier: Apache-2.0
// libpng reports errors by longjmp, which runs no destructors: so the functions that it may jump
// out of (readRows, writeRows) own nothing, and what they fill belongs to their callers.
#include "common/wall/png_file.h"

#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string_view>

#include <png.h>

#include "common/units/log.h"

namespace aquarama::wall {

namespace {

// Limits of what is read, in pixels each way and in all.
constexpr png_uint_32 kLargest = 16384;
// A small file could otherwise make the program allocate all memory of the machine.
constexpr png_uint_32 kMostPixels = 1U << 26;
// A snapshot takes a second to compress at this level, and five at the best.
constexpr int kCompression = 3;

// Closes a file that an error leaves open; a written file is closed by hand, to see whether that
// succeeds.
struct Closer {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

// The state of a read or write. Owned by readPng() or writePng(), which longjmp() does not leave.
struct Job {
    png_structp png = nullptr;
    png_infop info = nullptr;
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

std::size_t rowBytes(const Picture& picture) {
    return static_cast<std::size_t>(picture.sizePixels.x) * 3 *
           static_cast<std::size_t>(picture.bits / 8);
}

// Memory for the packed picture, and pointers to its rows, as libpng wants them.
void makeRows(Job& job, const Picture& picture) {
    const auto height = static_cast<std::size_t>(picture.sizePixels.y);
    job.bytes.resize(rowBytes(picture) * height);
    for (std::size_t y = 0; y < height; ++y)
        job.rows.push_back(job.bytes.data() + y * rowBytes(picture));
}

// Size and depth into `picture`, and what libpng shall convert. False after an error.
bool readHeader(Job& job, std::FILE* file, Picture& picture) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_init_io(job.png, file);
    png_set_user_limits(job.png, kLargest, kLargest);
    png_read_info(job.png, job.info);
    if (png_get_image_width(job.png, job.info) * png_get_image_height(job.png, job.info) >
        kMostPixels)
        png_error(job.png, "too many pixels");
    png_set_expand(job.png);
    png_set_gray_to_rgb(job.png);
    png_set_strip_alpha(job.png);
    (void)png_set_interlace_handling(job.png);
    png_read_update_info(job.png, job.info);
    picture.sizePixels = {static_cast<int>(png_get_image_width(job.png, job.info)),
                          static_cast<int>(png_get_image_height(job.png, job.info))};
    picture.bits = png_get_bit_depth(job.png, job.info);
    return true;
}

// The two below may be jumped out of. False after an error.
bool readRows(Job& job) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_read_image(job.png, job.rows.data());
    png_read_end(job.png, nullptr);
    return true;
}

bool writeRows(Job& job, std::FILE* file, const Picture& picture) {
    if (setjmp(png_jmpbuf(job.png)) != 0) return false;
    png_init_io(job.png, file);
    png_set_compression_level(job.png, kCompression);
    png_set_IHDR(job.png,
                 job.info,
                 static_cast<png_uint_32>(picture.sizePixels.x),
                 static_cast<png_uint_32>(picture.sizePixels.y),
                 picture.bits,
                 PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(job.png, job.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(job.png, job.info);
    png_write_image(job.png, job.rows.data());
    png_write_end(job.png, nullptr);
    return true;
}

// From packed bytes to codes and back; 16-bit PNG is big-endian.
void unpack(const std::vector<png_byte>& bytes, Picture& picture) {
    const bool deep = picture.bits == 16;
    picture.rgb.resize(deep ? bytes.size() / 2 : bytes.size());
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        picture.rgb[i] =
            deep ? static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]) : bytes[i];
}

void pack(const Picture& picture, std::vector<png_byte>& bytes) {
    const bool deep = picture.bits == 16;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        if (deep) bytes[2 * i] = static_cast<png_byte>(picture.rgb[i] >> 8);
        bytes[deep ? 2 * i + 1 : i] = static_cast<png_byte>(picture.rgb[i] & 0xff);
    }
}

}  // namespace

Picture readPng(const std::string& path) {
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) throw Error(path + ": cannot be opened; check the path");
    Job job;
    job.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, remember, ignore);
    job.info = png_create_info_struct(job.png);
    Picture picture;
    bool whole = readHeader(job, file.get(), picture);
    if (whole) {
        makeRows(job, picture);
        whole = readRows(job);
    }
    png_destroy_read_struct(&job.png, &job.info, nullptr);
    if (!whole)
        throw Error(path + ": is no whole PNG picture (" + job.complaint + "); write it anew");
    unpack(job.bytes, picture);
    return picture;
}

void writePng(const std::string& path, const Picture& picture) {
    assert(picture.bits == 8 || picture.bits == 16);
    assert(picture.rgb.size() * static_cast<std::size_t>(picture.bits / 8) ==
           rowBytes(picture) * static_cast<std::size_t>(picture.sizePixels.y));
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) throw Error(path + ": cannot be written; check the folder and its permissions");
    Job job;
    job.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, remember, ignore);
    job.info = png_create_info_struct(job.png);
    makeRows(job, picture);
    pack(picture, job.bytes);
    const bool whole = writeRows(job, file.get(), picture);
    png_destroy_write_struct(&job.png, &job.info);
    if (!whole || std::fclose(file.release()) != 0)  // a full disk shows itself when closing
        throw Error(path + ": writing failed; is the disk full?");
}

}  // namespace aquarama::wall
