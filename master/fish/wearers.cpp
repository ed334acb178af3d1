// SPDX-License-Identifier: Apache-2.0
#include "master/fish/wearers.h"

namespace aquarama::fish {

std::uint64_t foldedWearers(std::uint64_t hash, const Wearers& wearers) {
    for (const Wearer& wearer : wearers.fish) {
        hash = foldedOne(foldedOne(hash, static_cast<std::uint32_t>(wearer.visit)),
                         wearer.since.value);
        hash = foldedOne(foldedOne(hash, static_cast<std::uint32_t>(wearer.aside)), wearer.number);
        hash = foldedOne(hash, shortHash(wearer.picture));
    }
    return hash;
}

}  // namespace aquarama::fish
