// SPDX-License-Identifier: Apache-2.0
#include "drawings/refusal.h"

#include <array>

namespace aquarama::drawings {

std::string lineOf(RefusalReason reason) {
    switch (reason) {
        case RefusalReason::TooLarge:
            return "the picture is too large; send one of at most 16 MB and 50 megapixels";
        case RefusalReason::NotAPicture:
            return "this is no picture that can be read; send a photograph as JPEG, PNG or WebP";
        case RefusalReason::NoSheet:
            return "no sheet is in the picture; photograph the whole sheet with its four corners";
        case RefusalReason::SeveralSheets:
            return "more than one sheet is in the picture; photograph one at a time";
        case RefusalReason::TooFewCorners:
            return "too few corners of the sheet are seen; photograph it with all four black "
                   "squares";
        case RefusalReason::OtherVersion:
            return "the sheet is of another version; print a new one";
        case RefusalReason::UnknownSpecies:
            return "this sheet's fish does not live here; take a sheet that was printed here";
        case RefusalReason::NotFlat:
            return "the sheet is bent; lay it flat and photograph it again";
        case RefusalReason::CutOff:
            return "a part of the fish is cut off; photograph the whole sheet";
        case RefusalReason::TooSmall:
            return "the sheet is too small in the picture; go nearer";
        case RefusalReason::TooDark:
            return "the picture is too dark; photograph the sheet where there is more light";
    }
    return {};
}

std::string wordOf(RefusalReason reason) {
    constexpr std::array<const char*, 11> kWords{"too_large",
                                                 "not_a_picture",
                                                 "no_sheet",
                                                 "several_sheets",
                                                 "too_few_corners",
                                                 "other_version",
                                                 "unknown_species",
                                                 "not_flat",
                                                 "cut_off",
                                                 "too_small",
                                                 "too_dark"};
    return kWords.at(static_cast<std::size_t>(reason));
}

}  // namespace aquarama::drawings
