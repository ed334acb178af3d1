// SPDX-License-Identifier: Apache-2.0
// Where a fish's mouth is.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/fish/fish_view.h"

namespace aquarama::fish {

// Of the mouth before the origin of the body frame: nodal point 0 of every species' rest shape.
inline constexpr float kMouthBodyLengths = 0.385F;

[[nodiscard]] inline glm::vec3 mouthOf(const FishView& view, std::uint32_t fish) {
    return view.position(fish) + view.heading(fish) * (kMouthBodyLengths * view.fish[fish].length);
}

}  // namespace aquarama::fish
