// SPDX-License-Identifier: Apache-2.0
// Colours beyond the outline of a skin, for whoever filters it or draws it without its alpha.
#pragma once

#include "common/base/picture.h"

namespace aquarama::drawings {

// Gives each texel with an alpha of 0 a smooth mean of the colours about it (push-pull; Gortler et
// al. 1996); the others stay. `skin`: codes of 8 bits, red, green, blue, alpha.
void bleed(PngPicture& skin);

}  // namespace aquarama::drawings
