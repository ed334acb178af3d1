// SPDX-License-Identifier: Apache-2.0
// Draws halls with the errors that touring crews make; the same hall for the same seed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/config/hall.h"
#include "common/config/rig.h"

namespace aquarama::hall {

// A rig as a crew plans it: three to six projectors light all of a cylinder, a flat wall or a part
// of a dome, and a little past its edges. `scale` multiplies all numbers of pixels; 1 is full size.
[[nodiscard]] config::Rig randomRig(std::uint32_t seed, double scale = 1);

// A hall of the rig: projectors hang crooked and are roughly aimed, but light all of the planned
// screen. The screen has bumps and dents, lenses distort, responses are not exact, and one camera
// with noise sees the whole screen. `scale`: of the camera's pixels; 1 is 4K or 8 megapixels.
[[nodiscard]] config::Hall randomHall(const config::Rig& rig, std::uint32_t seed, double scale = 1);

// A hall without errors: projectors and screen are as the rig says, and the camera has no noise and
// no distortion. It stands where the camera of randomHall() stands.
[[nodiscard]] config::Hall plainHall(const config::Rig& rig, std::uint32_t seed, double scale = 1);

// The hall that an option of a command names: a file, or random:SEED with a camera about as fine as
// the panorama. Throws Error, which names the option.
[[nodiscard]] config::Hall hallFrom(const std::string& option,
                                    const std::string& text,
                                    const config::Rig& rig);
// The scale of a camera that is about as fine as the rig's panorama.
[[nodiscard]] double cameraScaleFor(const config::Rig& rig);

// A fault of a hall or of a scan in it.
enum class HallFault : std::uint8_t {
    BlockedCamera,
    MovedProjector,  // during the scan
    SwappedOutputs,
    AmbientLamp,
    OverExposure,
    UnderExposure,
    LatePicture,
    AutoExposure,
    Keystone,
    WrongResolution,
    NoOverlap,
    FlatScreen,  // instead of a curved one; no change for a flat rig
    LensShift    // by 120 % of the picture's height; the projector hangs higher by as much
};
// In the order of HallFault.
inline constexpr std::array<std::string_view, 13> kHallFaultNames{"blocked_camera",
                                                                  "moved_projector",
                                                                  "swapped_outputs",
                                                                  "ambient_lamp",
                                                                  "over_exposure",
                                                                  "under_exposure",
                                                                  "late_picture",
                                                                  "auto_exposure",
                                                                  "keystone",
                                                                  "wrong_resolution",
                                                                  "no_overlap",
                                                                  "flat_screen",
                                                                  "lens_shift"};
// The hall with a fault. Its strength, its place and its picture (below `pictures`) are random.
[[nodiscard]] config::Hall withFault(const config::Rig& rig,
                                     config::Hall hall,
                                     HallFault fault,
                                     std::uint32_t seed,
                                     std::size_t pictures = 40);

}  // namespace aquarama::hall
