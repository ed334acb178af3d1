// SPDX-License-Identifier: Apache-2.0
// Sets exposure and switches off automatic settings, by the controls of V4L2 and by gPhoto2.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "calibration/scan/camera.h"

namespace aquarama::scan {

// The controls of a V4L2 device. The destructor restores their former values.
class CameraControls {
  public:
    // Switches all to manual. Throws Error for another device, or without a manual exposure.
    explicit CameraControls(const std::string& device);
    ~CameraControls();
    CameraControls(const CameraControls&) = delete;
    CameraControls& operator=(const CameraControls&) = delete;

    // The exposures that the camera can take.
    [[nodiscard]] ExposureRange exposures() const { return range_; }
    // Sets the nearest exposure that the device has. Throws Error where it refuses.
    void expose(double seconds);

  private:
    // False where the device does not have it or refuses the value.
    bool set(std::uint32_t control, std::int32_t value);

    std::string device_;
    int descriptor_;
    ExposureRange range_;
    std::map<std::uint32_t, std::int32_t> before_;
};

// The reason why a device, a film or an address cannot be read, and what to do. `error`: the
// system's (EBUSY, ...), or 0.
[[nodiscard]] std::string deviceProblem(const std::string& device, int error);

// The cause in the output of gphoto2, as one line: its last line "*** Error (-53: ...) ***", else
// the text after "*** Error ***", else the last line that is no advice for debugging.
[[nodiscard]] std::string gphotoCause(const std::string& text);

// The camera of the program gphoto2, at a port ("usb:001,004") or the only one (empty). Throws
// Error where the program is not installed, or no camera answers.
[[nodiscard]] std::unique_ptr<Camera> openGphoto(const std::string& port);

}  // namespace aquarama::scan
