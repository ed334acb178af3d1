// SPDX-License-Identifier: Apache-2.0
// Reads and writes MPCDI 1 and 2, profiles 2d, 3d, a3 and sl: an archive of a manifest, warps and
// masks, or the manifest alone, which has the poses. docs/decisions/0046 says how open points of
// the standard are read.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "common/formats/wall_file.h"

namespace aquarama::formats {

// Whether bytes are a zip archive, or XML whose root is MPCDI.
[[nodiscard]] bool isMpcdi(std::span<const std::byte> bytes);

// `source` names it in errors. Throws Error.
[[nodiscard]] WallFile readMpcdi(std::span<const std::byte> bytes,
                                 const std::string& source,
                                 const ReadOptions& options = {});

// version: 1 or 2. Reading the file again gives the same WallFile, as exactly as pfmOf() stores its
// samples. Other tools take any grid for texel centres: use resampled() at the projector's size for
// them. Throws Error where a channel lacks data of its profile, or the file cannot be written.
[[nodiscard]] std::vector<std::byte> encodeMpcdi(const WallFile& wall, int version);
void writeMpcdi(const std::string& path, const WallFile& wall, int version);

// The words of the format, for both directions.

inline constexpr std::array<std::string_view, 4> kProfileNames{"2d", "3d", "a3", "sl"};
inline constexpr std::array<std::string_view, 4> kOriginNames{
    "unknown", "centerOfMass", "idealEyePoint", "floorCenter"};

// An angle of a frustum, and its name in the file.
struct AngleName {
    const char* name;
    double Frustum::*angle;
};
inline constexpr std::array kAngleNames{AngleName{"yaw", &Frustum::yaw},
                                        AngleName{"pitch", &Frustum::pitch},
                                        AngleName{"roll", &Frustum::roll},
                                        AngleName{"rightAngle", &Frustum::right},
                                        AngleName{"leftAngle", &Frustum::left},
                                        AngleName{"upAngle", &Frustum::up},
                                        AngleName{"downAngle", &Frustum::down}};

// Each is followed by x, y or z.
struct AxisName {
    const char* name;
    glm::dvec3 CoordinateFrame::*axis;
};
inline constexpr std::array kAxisNames{AxisName{"pos", &CoordinateFrame::position},
                                       AxisName{"yaw", &CoordinateFrame::yaw},
                                       AxisName{"pitch", &CoordinateFrame::pitch},
                                       AxisName{"roll", &CoordinateFrame::roll}};

// The data of the profile that a channel's pose lacks; null: none.
[[nodiscard]] const char* missingOf(const FileChannel& channel, Profile profile);

// The decimal number in a text; nothing where it is none or not finite. The functions below convert
// it; the writer chooses decimals that give the same value again.
[[nodiscard]] std::optional<long double> decimalIn(std::string_view text);
[[nodiscard]] double radiansOf(long double degrees);  // over -pi, up to pi
// The top of a region from the top of the buffer, as a share of its height. y: of the lower border.
[[nodiscard]] double topOf(long double y, double height);

// Our own extension says how a warp is stored, where its values alone suggest another way:
// <extension Name="Aquarama"><warp region="left" file="geometryWarpFile" sampling="nodes"
// values="places"/></extension>
// It also has the colour of a channel; the mix has a row for each of the projector's colours, and a
// response has its light from code 0 to 1:
// <colour region="left"><mix>1 0 0 0 1 0 0 0 1</mix><red>0 0.25 1</red><green>0 0.25 1</green>
// <blue>0 0.25 1</blue></colour>
inline constexpr const char* kOwnExtension = "Aquarama";
inline constexpr std::size_t kMixNumbers = 9;
inline constexpr std::array<std::string_view, 2> kSamplingNames{"centres", "nodes"};
inline constexpr std::array<std::string_view, 3> kStoredNames{"places", "wholeBuffer", "offsets"};

}  // namespace aquarama::formats
