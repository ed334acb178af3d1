// SPDX-License-Identifier: Apache-2.0
// Where the files of the tree are: rigs, scenes, species, golden pictures.
#pragma once

#include <cstdlib>
#include <string>

namespace aquarama::test {

// The tree that this was built from, or the one that AQUARAMA_SOURCE names, for programs that run
// on another machine than that which built them.
inline std::string sourceFolder() {
    const char* other = std::getenv("AQUARAMA_SOURCE");
    return other != nullptr ? other : AQUARAMA_SOURCE_DIR;
}

}  // namespace aquarama::test
