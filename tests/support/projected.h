// SPDX-License-Identifier: Apache-2.0
// What render nodes would project of a test pattern, and what the wall ought to show: the truth
// that real nodes are measured against, without GL.
#pragma once

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/wall/pattern.h"

namespace aquarama::test {

// A channel's share of the pattern: warped and blended. pictureOf (common/base/picture.h) encodes
// it as the channel's picture.
[[nodiscard]] Light projectedLight(const config::Rig& rig,
                                   std::size_t channel,
                                   wall::TestPattern pattern);

// The pattern on the unrolled screen, straight from its formula: no projector in between.
[[nodiscard]] Light directPanorama(const config::Rig& rig, wall::TestPattern pattern);

}  // namespace aquarama::test
