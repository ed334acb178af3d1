// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/place/place.h"

namespace aquarama::test {

// The water of the reef that the wall of the desk has in view.
[[nodiscard]] inline place::Region schoolRegion() {
    return {glm::vec3{0.0F, -5.8F, -5.5F}, glm::vec3{5.0F, 1.8F, 3.5F}};
}

}  // namespace aquarama::test
