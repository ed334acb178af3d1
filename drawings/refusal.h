// SPDX-License-Identifier: Apache-2.0
// Why a picture is no drawing: each reason has one line for who took it, which says what to do.
#pragma once

#include <cstdint>
#include <string>

#include "common/base/log.h"

namespace aquarama::drawings {

// In the order in which a picture is tried.
enum class RefusalReason : std::uint8_t {
    TooLarge,        // more bytes or pixels than are read
    NotAPicture,     // no JPEG, PNG or WebP, or a damaged one
    NoSheet,         // no tag of a sheet
    SeveralSheets,   // tags of more than one
    TooFewCorners,   // fewer than three
    OtherVersion,    // printed by another version of Aquarama
    UnknownSpecies,  // of a species that this installation lacks
    NotFlat,         // the tags do not lie in one plane
    CutOff,          // a part of the fish is outside of the picture
    TooSmall,        // too few pixels
    TooDark          // the paper is black, or has no light that can be told from glare
};

// The line of a reason.
[[nodiscard]] std::string lineOf(RefusalReason reason);

// Its name for other programs: "no_sheet".
[[nodiscard]] std::string wordOf(RefusalReason reason);

// A picture that is refused.
class Refusal : public Error {
  public:
    explicit Refusal(RefusalReason reason) : Error(lineOf(reason)), reason_{reason} {}
    // One of those that have a line.
    [[nodiscard]] RefusalReason reason() const { return reason_; }

  private:
    RefusalReason reason_;
};

}  // namespace aquarama::drawings
