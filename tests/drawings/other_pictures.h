// SPDX-License-Identifier: Apache-2.0
// Pictures that are no drawing, or not quite.
#pragma once

#include <cstdint>

#include "drawings/catalogue.h"
#include "drawings/photo.h"
#include "tests/drawings/painted_sheet.h"

namespace aquarama::test {

// What is wrong with a sheet whose tags are drawn anew.
enum class TagFault : std::uint8_t {
    OtherFamily,     // 25h9
    RandomModules,   // black borders about noise
    TwoOnly,         // the others are bare paper
    SeveralSpecies,  // each corner another's
    Exchanged,       // corners are not where their tags say
    OtherVersion,
    UnknownSpecies,
    Checkers
};
inline constexpr int kTagFaults = 8;
[[nodiscard]] PaintedSheet withFault(const drawings::Sheet& sheet,
                                     PaintedSheet paper,
                                     TagFault fault,
                                     std::uint32_t seed);

// The picture of this number: sheets with faults, noise, pages of text, bare paper, golden pictures
// of the sea.
[[nodiscard]] drawings::Photo otherPicture(drawings::Catalogue& catalogue, std::uint32_t number);

}  // namespace aquarama::test
