// SPDX-License-Identifier: Apache-2.0
// How the mind makes up for a motor that is weaker than the biomechanical fish (paper, sections 5.1
// and 5.2). All are on in the show; a study takes each away to see what it gives.
#pragma once

namespace aquarama::fish {

struct Adaptation {
    bool recommendations = true;  // another swim pattern when one was pursued for too long
    bool enlargedRegions = true;  // collision threats are felt from farther off
    bool earlierPursuit = true;   // careful steering begins farther from a target
};

}  // namespace aquarama::fish
