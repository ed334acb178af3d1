// SPDX-License-Identifier: Apache-2.0
// Reads the pictures of cameras: files, and frames that FFmpeg's libraries decoded.
#pragma once

#include <string>

#include "common/base/picture.h"

struct AVFrame;

namespace aquarama::scan {

// Reads a PNG, JPEG or TIFF file, by its content: 8 bits, or 16 where the file has more than 8;
// grey becomes red green blue. The rotation that the file asks for (EXIF) is ignored. Throws Error
// with the path for another format, for a damaged file, and for more than 16384 pixels each way or
// 64 million in all.
[[nodiscard]] Picture readPicture(const std::string& path);

// As above, of a decoded frame; `source` names it in errors.
[[nodiscard]] Picture pictureOf(const AVFrame& frame, const std::string& source);

}  // namespace aquarama::scan
