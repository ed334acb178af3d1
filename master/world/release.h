// SPDX-License-Identifier: Apache-2.0
// A hunter that a cue releases: which one comes, and when it has come.
#pragma once

#include "master/world/events.h"
#include "master/world/fish_columns.h"
#include "master/world/visits.h"

namespace aquarama::world {

// The nearest of the species that patrols and is not on its way yet comes before the wall. Nothing
// happens where there is none.
void release(const WaterAtTick& water, const ReleaseHunter& cue, FishColumns& columns);
// Once a tick: who is on its way hunts nobody; who has come is hungry, and hunts whom it sees.
void leadReleased(const WaterAtTick& water, FishColumns& columns);

}  // namespace aquarama::world
