// SPDX-License-Identifier: Apache-2.0
// All that a fish may look at while it thinks. Nothing in it changes meanwhile, so that fish may
// think in any order and on any thread.
#pragma once

#include <cstdint>
#include <span>

#include "common/units/ids.h"
#include "master/behaviour/perceive/grids.h"
#include "master/fish/adaptation.h"
#include "master/fish/fish_view.h"
#include "master/fish/species_parameters.h"
#include "master/surroundings/journey.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

struct Environment {
    const fish::FishView* view = nullptr;
    const Grids* grids = nullptr;
    const surroundings::Surroundings* surroundings = nullptr;
    std::span<const fish::SpeciesParameters> speciesParameters;  // by FishView::kind
    config::Gathering gathering = config::Gathering::None;
    surroundings::Goal goal;  // of the school, where the scene has it gather
    float schoolRadiusMetres = 0;
    std::uint32_t seed = 0;
    Tick tick;
    fish::Adaptation adaptation;
};

}  // namespace aquarama::behaviour
