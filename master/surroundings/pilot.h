// SPDX-License-Identifier: Apache-2.0
// Who steers the submarine: the autopilot, which follows a smooth closed path, or a visitor. World
// frame, metres. Every function here is pure and exact: equal inputs give equal bits on every
// machine.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/scene.h"
#include "common/place/place.h"
#include "master/surroundings/vessel.h"

namespace aquarama::surroundings {

// A closed path through stops in order; the last leads to the first. With one stop the submarine
// stays there.
struct Tour {
    // A stop on the path.
    struct Stop {
        glm::vec3 at{};
        // Point to look at; without one the submarine looks at the school.
        std::optional<glm::vec3> lookAt;
    };
    std::vector<Stop> stops;
    // Speed along the path.
    float metresPerSecond = 0;
};

// The tour of a scene. A tour without stops is a circle around the middle of the water through the
// eye. A scene without a tour gives one stop: its eye, looking along -z.
[[nodiscard]] Tour tourOf(const config::Scene& scene);

// The path at a parameter: its whole part is a stop, its fraction the share of the way to the next.
struct TourPoint {
    glm::vec3 at{};
    // Derivative of the position by the parameter.
    glm::vec3 perStop{};
    // Point that the submarine looks at there.
    glm::vec3 lookAt{};
};
// `along` is 0 or more; `school` stands in for stops that name no point to look at.
[[nodiscard]] TourPoint pointOf(const Tour& tour, float along, glm::vec3 school);
// Parameter of the sampled point of the path that is nearest to a place.
[[nodiscard]] float nearestAlong(const Tour& tour, glm::vec3 place);

// Rate at which the autopilot changes its pushes, a second: so slowly that nobody feels it begin.
inline constexpr float kAutopilotSlew = 0.25F;

// A speed that limits nothing.
inline constexpr float kNoLimit = std::numeric_limits<float>::infinity();

// The pushes that the autopilot wants now; advances `along`, the parameter of the point that it
// makes for. It turns by at most 8 degrees a second and wants at most 0.6 m/s along its path, no
// more than `most`, with which its turn slows.
[[nodiscard]] Push followTour(
    const Tour& tour, const Vessel& vessel, glm::vec3 school, float& along, float most = kNoLimit);

// The last visitor who steered keeps the helm for a while; without steering the autopilot takes
// over. One step a tick.

// The constant part: where the submarine may go and what its tour is. Read by any thread.
struct Voyage {
    Waters waters;
    Tour tour;
    // The scene has no tour: it stays at the eye until somebody steers.
    bool stays = true;
    // Ticks without steering until the autopilot takes over.
    std::uint64_t idleTicks = 0;
};
// `fishWater` is the water of the fish; the submarine may go somewhat farther.
[[nodiscard]] Voyage voyageOf(const config::Scene& scene,
                              std::uint32_t seed,
                              const place::Region& fishWater);

// The state of the submarine and its steering. Owned by the world; part of its hash.
struct Pilot {
    Vessel vessel;
    // The steering of the last visitor, and the tick until which it holds.
    Steering steering;
    Tick heldUntil;
    // Tick from which the autopilot steers if no visitor does before.
    Tick autopilotFrom;
    // Parameter of the point of the tour that the autopilot makes for.
    float along = 0;
    // Whether the autopilot steers now.
    bool touring = false;
    // Whether a visitor ever steered.
    bool everSteered = false;
};
// At rest at the eye.
[[nodiscard]] Pilot pilotOf(const Voyage& voyage, glm::vec3 eye);

// Takes a visitor's steering, between two ticks. A steering of zeros releases the helm.
void steer(Pilot& pilot, const Voyage& voyage, const Steering& steering, Tick now);
// Advances the submarine by one tick. `school` is where the autopilot looks if its tour names no
// other point. It goes no faster than `most` metres a second: somebody tries to keep up with it.
void advancePilot(
    Pilot& pilot, const Voyage& voyage, glm::vec3 school, Tick now, float most = kNoLimit);

// The hash with all of the state folded in.
[[nodiscard]] std::uint64_t foldedPilot(std::uint64_t hash, const Pilot& pilot);

}  // namespace aquarama::surroundings
