// SPDX-License-Identifier: Apache-2.0
// What a fish does, in names that pages have sentences for.
#pragma once

#include <string>

#include "common/wire/messages.h"

namespace aquarama::guests {

// Names are those of species; empty: none.
struct FishDeed {
    std::string does;  // "hide": its intention, in small letters
    std::string whom;  // the fish that this is about
    std::string saw;   // whoever frightens it
    friend bool operator==(const FishDeed&, const FishDeed&) = default;
};

// Of what a master says of a fish. One that is away does nothing.
[[nodiscard]] FishDeed deedOf(const v1::Explanation& told);

}  // namespace aquarama::guests
