// SPDX-License-Identifier: Apache-2.0
#include "master/fish/minds.h"

#include "common/units/folded_hash.h"

namespace aquarama::fish {

// Member by member: what lies between them has no meaning.
std::uint64_t Minds::hash() const {
    std::uint64_t hash = 1;
    const auto fold = [&](auto member) { hash = folded(hash, minds_, member); };
    fold(&Mind::intention);
    fold(&Mind::target);
    fold(&Mind::pursued);
    fold(&Mind::remembered);
    fold(&Mind::rememberedTarget);
    fold(&Mind::sinceRemembered);
    fold(&Mind::sinceMeal);
    fold(&Mind::sinceSpawning);
    fold(&Mind::sinceChase);
    fold(&Mind::alarm);
    fold(&Mind::eaten);
    fold(&Mind::likes);
    fold(&Mind::stage);
    fold(&Mind::sinceStage);
    return hash;
}

std::size_t Minds::bytes() const {
    return bytesIn(minds_);
}

}  // namespace aquarama::fish
