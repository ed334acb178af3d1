// SPDX-License-Identifier: Apache-2.0
// The border of what a projector lights on the screen, as a closely spaced set of points.
#pragma once

#include <vector>

#include "common/wall/pinhole.h"

namespace aquarama::wall {

// Points where the picture's border falls on the screen and where the screen's border falls into
// the picture: together they enclose all that is lit. Empty when the projector misses the screen.
[[nodiscard]] std::vector<glm::dvec3> litOutline(const config::Screen& screen,
                                                 const Pinhole& projector,
                                                 double spillMetres);

}  // namespace aquarama::wall
