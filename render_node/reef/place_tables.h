// SPDX-License-Identifier: Apache-2.0
// The key of tables that follow from the place alone, in the cache of derived data.
#pragma once

#include <string>

#include "common/base/derived_cache.h"
#include "common/place/place.h"

namespace aquarama::scene {

// kind: what the tables are, such as "reef".
[[nodiscard]] DerivedKey derivedKey(std::string kind, const place::PlaceKey& place);

}  // namespace aquarama::scene
