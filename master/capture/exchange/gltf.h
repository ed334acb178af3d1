// SPDX-License-Identifier: Apache-2.0
// A segment as glTF 2.0 (ISO/IEC 12113): the skin of the fish, swimming.
#pragma once

#include <cstddef>
#include <vector>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama::exchange {

enum class GltfContainer { Binary, Text };  // .glb; .gltf with its buffer inside

// Shapes of the skin, and keys of the animation, in a cycle: half of its phases for a beat, which
// straight lines between them leave by less than 0.002 body lengths; all for a turn that plays to
// its end, for it begins abruptly.
[[nodiscard]] int gltfShapes(const motion::ActionSegment& segment);

// One animation, named like the segment: the body frame moves a node, and the mesh below it goes
// through the poses of the cycle as morph targets. Metres, Y up, the fish heads along +x (where
// glTF's own custom is +z).
[[nodiscard]] std::vector<std::byte> gltfOf(const motion::Repertoire& repertoire,
                                            const body::FishBody& body,
                                            motion::Action action,
                                            int cycles,
                                            GltfContainer container);

}  // namespace aquarama::exchange
