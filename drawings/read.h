// SPDX-License-Identifier: Apache-2.0
// A photograph of a coloured sheet becomes the skin of a fish.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/base/picture.h"
#include "drawings/flatten.h"
#include "drawings/photo.h"
#include "drawings/sheet.h"

namespace aquarama::drawings {

// A drawing that was read.
struct Drawing {
    std::string species;
    // As side_view.h says; white paper is white. Transparent outside of the outline, where the
    // colours of its border go on.
    PngPicture skin;
    Flattening flat;
};

// The sheet of a number (TagCode::species), which must live on; null: there is none.
using SheetOf = std::function<const Sheet*(int number)>;

// Throws Refusal, with all its reasons but those of decodePhoto(). Takes a few tenths of a second.
[[nodiscard]] Drawing readDrawing(const Photo& photo, const SheetOf& sheetOf);

}  // namespace aquarama::drawings
