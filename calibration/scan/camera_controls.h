// SPDX-License-Identifier: Apache-2.0
// Exposure and all that a camera chooses by itself, through the controls of V4L2 and the settings
// of gPhoto2.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "calibration/scan/camera.h"

namespace aquarama::scan {

// The controls of a V4L2 device; as they were before when this ends.
class CameraControls {
  public:
    // Switches all to manual. Throws Error where it is no such device, or has no manual exposure.
    explicit CameraControls(const std::string& device);
    ~CameraControls();
    CameraControls(const CameraControls&) = delete;
    CameraControls& operator=(const CameraControls&) = delete;

    [[nodiscard]] ExposureRange exposures() const { return range_; }
    // The nearest that it has. Throws Error where the device refuses it.
    void expose(double seconds);

  private:
    // False where the device does not have it or refuses the value.
    bool set(std::uint32_t control, std::int32_t value);

    std::string device_;
    int descriptor_;
    ExposureRange range_;
    std::map<std::uint32_t, std::int32_t> before_;
};

// Why a device, a film or an address cannot be read, and what to do, by the error of the system
// that came of it (EBUSY, ...; 0 where there is none).
[[nodiscard]] std::string deviceProblem(const std::string& device, int error);

// The cause in what gphoto2 has said, on one line: its last line "*** Error (-53: ...) ***";
// without one what follows "*** Error ***"; without both the last line that is no advice for
// debugging.
[[nodiscard]] std::string gphotoCause(const std::string& text);

// The camera of the program gphoto2, at a port ("usb:001,004") or the only one (empty). Throws
// Error where the program is not installed, or no camera answers.
[[nodiscard]] std::unique_ptr<Camera> openGphoto(const std::string& port);

}  // namespace aquarama::scan
