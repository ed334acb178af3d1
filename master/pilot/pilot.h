// SPDX-License-Identifier: Apache-2.0
// Who steers the submarine: the hand that spoke last, or after a while without any the autopilot.
// One pure step a tick; same inputs, same bits on every machine.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/units/ids.h"
#include "common/units/steering.h"
#include "master/pilot/hull.h"
#include "master/pilot/tour.h"
#include "master/pilot/vessel.h"

namespace aquarama::pilot {

// What does not change during a show.
struct Voyage {
    Waters waters;
    Tour tour;
    bool stays = true;            // at the eye, until somebody steers
    std::uint64_t idleTicks = 0;  // without a hand, until the autopilot takes over
};
[[nodiscard]] Voyage voyageOf(const config::Scene& scene,
                              std::uint32_t seed,
                              const place::Region& fishWater);

// What a world remembers of its submarine.
struct Pilot {
    Vessel vessel;
    Steering steering;         // of the last hand
    Tick heldUntil;            // by it
    Tick autopilotFrom;        // when nobody steers until then
    float along = 0;           // where on its tour the autopilot makes for, in stops
    bool touring = false;      // the autopilot steers
    bool everSteered = false;  // by hand
};
[[nodiscard]] Pilot pilotOf(const Voyage& voyage, glm::vec3 eye);

// Between two ticks. A hand that holds nothing lets go.
void steer(Pilot& pilot, const Voyage& voyage, const Steering& steering, Tick now);
// One tick; the autopilot looks at the school where its tour names nothing else.
void advancePilot(Pilot& pilot, const Voyage& voyage, glm::vec3 school, Tick now);

[[nodiscard]] std::uint64_t foldedPilot(std::uint64_t hash, const Pilot& pilot);

}  // namespace aquarama::pilot
