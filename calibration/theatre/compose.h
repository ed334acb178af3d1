// SPDX-License-Identifier: Apache-2.0
// The simulated hall: adds up, in linear light, what the projectors throw on the screen.
#pragma once

#include <span>

#include "common/config/rig.h"
#include "common/wall/picture.h"

namespace aquarama {

// The unrolled screen. One picture for each channel of the rig, of its size, as light.
[[nodiscard]] Light composePanorama(const Rig& rig, std::span<const Light> channels);

// What somebody at the back of a dark hall sees of it, over the heads of the audience.
[[nodiscard]] Light composeHall(const Rig& rig, const Light& panorama, glm::ivec2 sizePixels);

}  // namespace aquarama
