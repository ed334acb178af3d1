// SPDX-License-Identifier: Apache-2.0
// How different two pictures look to a person who flips between them: the LDR metric of Andersson,
// Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", HPG 2020. Plain, for small pictures.
#pragma once

#include <vector>

#include "common/base/picture.h"

namespace aquarama::test {

// The authors' viewing condition: 0.7 m before a monitor of 0.7 m and 3840 pixels.
inline constexpr double kPixelsPerDegree = 67.0;

// Of each pixel, 0 (the same) to 1. The pictures are of one size, sRGB, 8 bits.
[[nodiscard]] std::vector<double> flip(const Picture& reference,
                                       const Picture& other,
                                       double pixelsPerDegree = kPixelsPerDegree);
[[nodiscard]] double meanFlip(const Picture& reference, const Picture& other);

}  // namespace aquarama::test
