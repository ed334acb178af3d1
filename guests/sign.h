// SPDX-License-Identifier: Apache-2.0
// The dots that the wall draws for visitors: a code to be scanned, and three digits.
#pragma once

#include <string>

#include "common/wire/state_codec.h"

namespace aquarama::guests {

// A QR code of the address, on lit ground with its quiet zone, and the characters below it. Without
// an address of capitals, digits and $%*+-./: the code has more modules. Throws Error where it
// would be larger than a sign may be. `isInverted`: the characters are lit, on dark ground.
[[nodiscard]] wire::Sign signOf(const std::string& address,
                                const std::string& characters,
                                bool isInverted);

}  // namespace aquarama::guests
