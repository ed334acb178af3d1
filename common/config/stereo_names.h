// SPDX-License-Identifier: Apache-2.0
// The modes of stereo as rig files name them.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "common/config/rig.h"

namespace aquarama::config {

// In the order of the schema's values, from 1.
inline constexpr std::array<std::pair<std::string_view, StereoMode>, 6> kStereoModes{
    {{"MONO", StereoMode::Mono},
     {"QUAD_BUFFER", StereoMode::QuadBuffer},
     {"SIDE_BY_SIDE", StereoMode::SideBySide},
     {"TOP_BOTTOM", StereoMode::TopBottom},
     {"INTERLACED", StereoMode::Interlaced},
     {"ANAGLYPH", StereoMode::Anaglyph}}};

[[nodiscard]] constexpr std::string_view nameOf(StereoMode mode) {
    return kStereoModes[static_cast<std::size_t>(mode)].first;
}

}  // namespace aquarama::config
