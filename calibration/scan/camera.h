// SPDX-License-Identifier: Apache-2.0
// Cameras that take the pictures of a scan.
#pragma once

#include <memory>
#include <string>

#include "common/base/picture.h"

namespace aquarama::scan {

// The exposures that a camera allows, in seconds. Both are equal where the camera keeps its own;
// their value then has no meaning.
struct ExposureRange {
    double shortest = 1;
    double longest = 1;
    // Whether there is one exposure only.
    [[nodiscard]] bool isFixed() const { return shortest == longest; }
};

// A camera for the pictures of a scan. Lens, focus, gain and white balance stay as they are. For
// one thread.
class Camera {
  public:
    virtual ~Camera() = default;
    // The exposures that it can take.
    [[nodiscard]] virtual ExposureRange exposures() const = 0;
    // Takes a picture whose exposure begins after this call; older pictures in the camera or its
    // driver are dropped. Throws Error where no such picture arrives in ten seconds.
    [[nodiscard]] virtual Picture take(double exposureSeconds) = 0;
};

// Opens a camera. `device` is one of these:
//   /dev/video0          V4L2, with all automatic settings switched to manual; options of FFmpeg
//                        follow a question mark: /dev/video0?video_size=1920x1080
//   gphoto2:             the camera that the program gphoto2 finds; gphoto2:PORT: the one there
//   lavfi:GRAPH          a filter graph of FFmpeg
//   rtsp://..., a file   any other source that FFmpeg reads; it keeps its own exposure
// Throws Error where the camera cannot be opened, or a V4L2 camera has no manual exposure.
[[nodiscard]] std::unique_ptr<Camera> openCamera(const std::string& device);

}  // namespace aquarama::scan
