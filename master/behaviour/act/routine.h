// SPDX-License-Identifier: Apache-2.0
// What every behaviour routine is given. A routine takes one step towards its goal: it answers with
// a course, may move its own stage in `mind`, and reports events that others must learn of.
#pragma once

#include <cstdint>
#include <vector>

#include "master/behaviour/perceive/environment.h"
#include "master/behaviour/perceive/senses.h"
#include "master/fish/courses.h"
#include "master/fish/drives.h"
#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::behaviour {

struct Situation {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    std::uint32_t fish;
    const Senses& senses;
    const fish::Feelings& feelings;
};

using DeferredEvents =
    std::vector<fish::DeferredEvent>;  // with room for one of each fish of a chunk

}  // namespace aquarama::behaviour
