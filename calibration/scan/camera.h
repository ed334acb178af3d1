// SPDX-License-Identifier: Apache-2.0
// Cameras that take the pictures of a scan.
#pragma once

#include <memory>
#include <string>

#include "common/base/picture.h"

namespace aquarama::scan {

// Exposures that can be asked for, seconds. Both the same where the camera keeps its own: then they
// mean nothing but "the same".
struct ExposureRange {
    double shortest = 1;
    double longest = 1;
    [[nodiscard]] bool isFixed() const { return shortest == longest; }
};

// For one thread. Its lens, focus, gain and white balance stay as they are.
class Camera {
  public:
    virtual ~Camera() = default;
    [[nodiscard]] virtual ExposureRange exposures() const = 0;
    // A picture whose exposure began after this call did: what the camera or its driver still held
    // is thrown away. Throws Error where no such picture comes in ten seconds.
    [[nodiscard]] virtual Picture take(double exposureSeconds) = 0;
};

// By what `device` is:
//   /dev/video0          V4L2, with all that the camera chooses by itself switched to manual; after
//                        a question mark options of FFmpeg: /dev/video0?video_size=1920x1080
//   gphoto2:             the camera that the program gphoto2 finds; gphoto2:PORT: the one there
//   lavfi:GRAPH          a filter graph of FFmpeg
//   rtsp://..., a file   whatever else FFmpeg reads; its exposure is its own
// Throws Error where it cannot be opened, or a V4L2 camera has no manual exposure.
[[nodiscard]] std::unique_ptr<Camera> openCamera(const std::string& device);

}  // namespace aquarama::scan
