// SPDX-License-Identifier: Apache-2.0
// An action as the simulation swam it: nodal points in the world at each phase.
#pragma once

#include <functional>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama {

struct Recording {
    double periodSeconds = 0;
    bool playsToEnd = false;
    std::vector<NodeVectors>
        poses;  // at phases 0 .. kPhases, in body lengths: one more than kPhases
};

// Told the share that is done, from 0 to 1.
using Progress = std::function<void(double share)>;

// Simulates from rest until the gait repeats itself, then records one cycle; or the whole of a
// sharp turn, until the fish is straight again. Right turns are not simulated: they are mirrored.
[[nodiscard]] Recording record(const Species& species, Action action, const Progress& progress);

}  // namespace aquarama
