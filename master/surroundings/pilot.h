// SPDX-License-Identifier: Apache-2.0
// Where the submarine goes by itself: a smooth closed path, and what it looks at on the way. World
// frame, metres.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/place/place.h"
#include "common/units/units.h"
#include "master/surroundings/vessel.h"

namespace aquarama::surroundings {

// Stops in order, the last leads to the first; a single one is a place to stay at.
struct Tour {
    struct Stop {
        glm::vec3 at{};
        std::optional<glm::vec3> lookAt;  // without: at the school
    };
    std::vector<Stop> stops;
    float metresPerSecond = 0;
};

// The scene's tour; without stops of its own, round the middle of the water through the eye. A
// scene without a tour: to its eye, looking along -z.
[[nodiscard]] Tour tourOf(const config::Scene& scene);

// Of the path, at a number of stops from the first.
struct TourPoint {
    glm::vec3 at{};
    glm::vec3 perStop{};  // derivative of the place
    glm::vec3 lookAt{};
};
[[nodiscard]] TourPoint pointOf(const Tour& tour, float along, glm::vec3 school);
// Where the path passes nearest to a place.
[[nodiscard]] float nearestAlong(const Tour& tour, glm::vec3 place);

inline constexpr float kAutopilotSlew = 0.25F;  // of its pushes, a second: nobody feels them begin

// What the autopilot asks for now; moves `along`, the place that it makes for. Gentle: no turn
// faster than 8 degrees a second, never faster than 0.6 m/s.
[[nodiscard]] Push followTour(const Tour& tour,
                              const Vessel& vessel,
                              glm::vec3 school,
                              float& along);

// Who steers the submarine: the hand that spoke last, or after a while without any the autopilot.
// One pure step a tick; same inputs, same bits on every machine.

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

}  // namespace aquarama::surroundings
