// SPDX-License-Identifier: Apache-2.0
// Pictures of cameras: files of theirs, and frames as FFmpeg's libraries have decoded them.
#pragma once

#include <string>

#include "common/base/picture.h"

struct AVFrame;

namespace aquarama::scan {

// A PNG, JPEG or TIFF file, by its content. 8 bits, or 16 where the file has more than 8; grey as
// red green blue. As the sensor lay: a turn that the file asks for (EXIF) is not made. Throws Error
// with the path where it is none of these, is not whole, or has more than 16384 pixels each way or
// 64 million in all.
[[nodiscard]] Picture readPicture(const std::string& path);

// As above, of a decoded frame; `source` names it in errors.
[[nodiscard]] Picture pictureOf(const AVFrame& frame, const std::string& source);

}  // namespace aquarama::scan
