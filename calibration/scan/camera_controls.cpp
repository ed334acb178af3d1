// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/camera_controls.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::scan {

namespace {

constexpr double kExposureUnit = 1e-4;  // seconds, of V4L2_CID_EXPOSURE_ABSOLUTE

// A switch of what a camera does by itself, and the value that leaves it to us.
struct Manual {
    std::uint32_t control;
    std::int32_t value;
};
constexpr std::array kManual{Manual{V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0},
                             Manual{V4L2_CID_AUTOGAIN, 0},
                             Manual{V4L2_CID_AUTO_WHITE_BALANCE, 0},
                             Manual{V4L2_CID_FOCUS_AUTO, 0},
                             Manual{V4L2_CID_HUE_AUTO, 0},
                             Manual{V4L2_CID_BACKLIGHT_COMPENSATION, 0},
                             Manual{V4L2_CID_WIDE_DYNAMIC_RANGE, 0},
                             Manual{V4L2_CID_IMAGE_STABILIZATION, 0}};

// False where the driver refuses it; errno says why.
bool request(int descriptor, unsigned long what, void* argument) {
    return ioctl(descriptor, what, argument) == 0;
}

std::optional<std::int32_t> valueOf(int descriptor, std::uint32_t control) {
    v4l2_control asked{.id = control, .value = 0};
    if (!request(descriptor, VIDIOC_G_CTRL, &asked)) return std::nullopt;
    return asked.value;
}

// Nothing where the device lacks it.
std::optional<ExposureRange> exposuresOf(int descriptor) {
    v4l2_queryctrl asked{};
    asked.id = V4L2_CID_EXPOSURE_ABSOLUTE;
    if (!request(descriptor, VIDIOC_QUERYCTRL, &asked) ||
        (asked.flags & V4L2_CTRL_FLAG_DISABLED) != 0)
        return std::nullopt;
    return ExposureRange{std::max(asked.minimum, 1) * kExposureUnit, asked.maximum * kExposureUnit};
}

// An error of the system, and the rest of a sentence about what it came of: what to do.
struct KnownProblem {
    int error;
    const char* problem;
};
constexpr const char* kGone = "has no camera any more; plug it in again, and scan again";
constexpr const char* kNoCamera =
    "gives no pictures, as the second device of a camera, or is none; choose another of v4l2-ctl "
    "--list-devices, and options that the camera has";
constexpr const char* kForbidden =
    "may not be opened by this user; add the user to the group \"video\" and log in again";
// Of a device of V4L2.
constexpr std::array kOfVideo{
    KnownProblem{ENOENT,
                 "is not there; plug the camera in, and look for its name by ls /dev/video*"},
    KnownProblem{EACCES, kForbidden},
    KnownProblem{EPERM, kForbidden},
    KnownProblem{EBUSY, "is in use; end the program that fuser -v names for it"},
    KnownProblem{ENODEV, kGone},
    KnownProblem{ENXIO, kGone},
    KnownProblem{EIO, kGone},
    KnownProblem{ENOTTY, kNoCamera},
    KnownProblem{EINVAL, kNoCamera},
    KnownProblem{ENOSYS, kNoCamera}};
constexpr const char* kSilent =
    "does not answer; check its address and port, and that the camera is on this network";
// Of a film or an address.
constexpr std::array kOfStream{
    KnownProblem{ENOENT, "is not there; check its name"},
    KnownProblem{EACCES, "may not be read by this user; check its permissions"},
    KnownProblem{ECONNREFUSED, kSilent},
    KnownProblem{EHOSTUNREACH, kSilent},
    KnownProblem{ENETUNREACH, kSilent},
    KnownProblem{ETIMEDOUT, kSilent}};

// Null where the error is not known.
const char* knownProblem(std::span<const KnownProblem> known, int error) {
    const auto found = std::ranges::find(known, error, &KnownProblem::error);
    return found == known.end() ? nullptr : found->problem;
}

}  // namespace

std::string deviceProblem(const std::string& device, int error) {
    const bool isVideo = device.starts_with("/dev/");
    const char* problem = isVideo ? knownProblem(kOfVideo, error) : knownProblem(kOfStream, error);
    if (problem != nullptr) return device + ": " + problem;
    return device + ": is no camera or film that can be read" +
           (error > 0 ? " (" + std::generic_category().message(error) + ")" : "") +
           "; check its name, and end other programs that use it";
}

CameraControls::CameraControls(const std::string& device)
    : device_{device}, descriptor_{open(device.c_str(), O_RDWR | O_CLOEXEC)} {
    if (descriptor_ < 0) throw Error(deviceProblem(device, errno));
    const auto range = exposuresOf(descriptor_);
    if (!range || !set(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL)) {
        close(descriptor_);
        throw Error(device +
                    (range ? ": does not let its automatic exposure be switched off"
                           : ": has no control of its exposure (exposure_absolute)") +
                    "; a scan needs a camera that keeps one: end other programs that use it, or "
                    "take another, as by gphoto2:");
    }
    range_ = *range;
    for (const Manual& manual : kManual) set(manual.control, manual.value);
}

// The automatic exposure last: while it is on, others may be refused.
CameraControls::~CameraControls() {
    const std::map<std::uint32_t, std::int32_t> before = before_;
    for (const auto& [control, value] : before)
        if (control != V4L2_CID_EXPOSURE_AUTO) set(control, value);
    set(V4L2_CID_EXPOSURE_AUTO, before.at(V4L2_CID_EXPOSURE_AUTO));
    close(descriptor_);
}

bool CameraControls::set(std::uint32_t control, std::int32_t value) {
    const auto now = valueOf(descriptor_, control);
    v4l2_control wanted{.id = control, .value = value};
    if (!now || !request(descriptor_, VIDIOC_S_CTRL, &wanted)) return false;
    before_.try_emplace(control, *now);
    return valueOf(descriptor_, control) == value;
}

void CameraControls::expose(double seconds) {
    const double within = std::clamp(seconds, range_.shortest, range_.longest);
    const auto units = static_cast<std::int32_t>(std::lround(within / kExposureUnit));
    v4l2_control wanted{.id = V4L2_CID_EXPOSURE_ABSOLUTE, .value = units};
    const auto before = valueOf(descriptor_, V4L2_CID_EXPOSURE_ABSOLUTE);
    if (!before || !request(descriptor_, VIDIOC_S_CTRL, &wanted))
        throw Error(errno == ENODEV
                        ? deviceProblem(device_, ENODEV)
                        : device_ + ": refuses an exposure of " + std::to_string(within) +
                              " s; end other programs that use the camera, and scan again");
    before_.try_emplace(V4L2_CID_EXPOSURE_ABSOLUTE, *before);
}

}  // namespace aquarama::scan
