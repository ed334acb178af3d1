// SPDX-License-Identifier: Apache-2.0
// A segment as glTF 2.0 (ISO/IEC 12113): the skin of the fish, swimming.
#pragma once

#include <cstddef>
#include <vector>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama {

enum class GltfContainer { Binary, Text };  // .glb; .gltf with its buffer inside

// One animation, named like the segment: the body frame moves a node, and the mesh below it goes
// through the poses of the cycle as morph targets. Metres, Y up, the fish heads along +x (where
// glTF's own custom is +z).
[[nodiscard]] std::vector<std::byte> gltfOf(const Repertoire& repertoire,
                                            const FishBody& body,
                                            Action action,
                                            int cycles,
                                            GltfContainer container);

}  // namespace aquarama
