// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/clip.h"

#include "common/units/log.h"

namespace aquarama::theatre {

std::unique_ptr<Clip> makeClip(const ClipFormat& format) {
    if (format.path.ends_with(".mp4")) return makeVideo(format, videoEncoders());
    if (format.path.ends_with(".webp")) return makeAnimation(format);
    throw Error(format.path + ": a clip is FILE.mp4 or FILE.webp; choose one of these endings");
}

}  // namespace aquarama::theatre
