// SPDX-License-Identifier: Apache-2.0
// Halls as touring crews leave them, drawn from a seed: the same for the same seed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/config/hall.h"
#include "common/config/rig.h"

namespace aquarama::hall {

// A wall as a crew means it: three to six projectors on a cylinder, a flat wall or a part of a
// dome, wholly lit, with some light past its edges. `scale` multiplies all numbers of pixels; 1 is
// full size.
[[nodiscard]] config::Rig randomRig(std::uint32_t seed, double scale = 1);

// What becomes of a rig in a hall: it hangs crooked and is roughly aimed, but lights all of the
// screen that it is meant to; the screen has bumps and dents, lenses distort, responses bend, and
// one camera with noise sees the whole screen. `scale`: of the camera's pixels, which are those of
// 4K or of 8 megapixels at 1.
[[nodiscard]] config::Hall randomHall(const config::Rig& rig, std::uint32_t seed, double scale = 1);

// Nothing is wrong: projectors and screen are as the rig says, and the camera has no noise and no
// distortion. It stands where the random one would.
[[nodiscard]] config::Hall plainHall(const config::Rig& rig, std::uint32_t seed, double scale = 1);

// What the option of a command says is true of the hall: a file's name, or random:SEED, with a
// camera that is about as fine as the panorama. Throws Error, which names the option.
[[nodiscard]] config::Hall hallFrom(const std::string& option,
                                    const std::string& text,
                                    const config::Rig& rig);
// The scale of a camera that is about as fine as the rig's panorama.
[[nodiscard]] double cameraScaleFor(const config::Rig& rig);

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
    FlatScreen,  // where the rig has a curved one; of a flat rig nothing changes
    LensShift    // of 120 % of the picture's height; it hangs as much higher
};
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
// The hall with a fault of some strength, at some place and at one of so many pictures.
[[nodiscard]] config::Hall withFault(const config::Rig& rig,
                                     config::Hall hall,
                                     HallFault fault,
                                     std::uint32_t seed,
                                     std::size_t pictures = 40);

}  // namespace aquarama::hall
