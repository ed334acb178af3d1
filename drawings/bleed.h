// SPDX-License-Identifier: Apache-2.0
// Colours beyond the outline of a skin, for whoever filters it or draws it without its alpha.
#pragma once

#include "common/base/picture.h"

namespace aquarama::drawings {

// Gives each texel outside of the outline, and each within that is nearer to it than `rim` texels,
// a smooth mean of the colours about it (push-pull; Gortler et al. 1996); the others stay. So what
// is printed along the outline is no colour of the drawing. `skin`: codes of 8 bits, red, green,
// blue, alpha.
void bleed(PngPicture& skin, double rim);

}  // namespace aquarama::drawings
