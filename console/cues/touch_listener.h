// SPDX-License-Identifier: Apache-2.0
// A tracker that speaks TUIO: the hands or people that it sees become places of the screen.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include <glm/vec2.hpp>

#include "common/base/wall_hands.h"
#include "common/config/rig.h"
#include "console/cues/tracked_place.h"
#include "console/cues/tracker_port.h"

namespace aquarama::console {

// Of the server's thread.
class TouchListener {
  public:
    // Listens, for a rig whose touch is set. Throws Error where it cannot.
    explicit TouchListener(const config::Rig& rig);

    // Ten times a second, at a time in seconds that never goes back: all hands that there are; once
    // more after the last has left. Nothing where there is nothing to say.
    [[nodiscard]] std::optional<WallHands> tick(double now);

  private:
    [[nodiscard]] glm::dvec2 steadied(std::uint32_t id, glm::dvec2 place) const;

    TrackedPlaces places_;
    TrackerPort port_;
    std::map<std::uint32_t, glm::dvec2> known_;  // where each was in the last tick, by its id
    bool hadHands_ = false;
};

}  // namespace aquarama::console
