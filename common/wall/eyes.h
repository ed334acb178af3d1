// SPDX-License-Identifier: Apache-2.0
// The viewer's eyes before the wall, and how a channel shows a picture to each.
#pragma once

#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::wall {

// Between the eyes, where a mono picture is seen from; or one of them.
enum class EyeSide : std::uint8_t { Between, Left, Right };

// Wall frame, metres. The viewer faces the screen's middle whatever the channel: neighbours, each
// with the same two eyes, then agree in their overlap.
[[nodiscard]] glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side);

// The rig's, unless the channel's display has its own.
[[nodiscard]] config::Stereo stereoOf(const config::Rig& rig, std::size_t channel);

}  // namespace aquarama::wall
