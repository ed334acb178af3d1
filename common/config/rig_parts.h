// SPDX-License-Identifier: Apache-2.0
// What the readers of a rig's parts share.
#pragma once

#include <string_view>

#include <glm/vec3.hpp>

#include "common/config/rig.pb.h"

namespace aquarama::config {

// Whether a text has these characters only, and at least one.
[[nodiscard]] inline bool isAll(std::string_view text, std::string_view allowed) {
    return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

// Wall frame, metres.
[[nodiscard]] inline glm::dvec3 positionOf(const v1::Position& in) {
    return {in.x_m(), in.y_m(), in.z_m()};
}

}  // namespace aquarama::config
