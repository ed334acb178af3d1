// SPDX-License-Identifier: Apache-2.0
// A tracker that speaks TUIO: the hands that it sees become places of the screen.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/wall_hands.h"
#include "common/config/rig.h"
#include "common/tuio/hand_set.h"
#include "console/cues/udp_port.h"

namespace aquarama::console {

// The point of a touched surface at a place of it (shares from its top left corner), from the sweet
// spot in the axes of the wall frame, metres.
[[nodiscard]] glm::vec3 pointAt(const config::TouchedSurface& surface,
                                const glm::dvec3& sweetSpot,
                                glm::vec2 place);

// Of the server's thread.
class TouchListener {
  public:
    // Listens. Throws Error where it cannot.
    TouchListener(config::TouchedSurface surface, const glm::dvec3& sweetSpot);

    // Ten times a second, at a time in seconds that never goes back: all hands that there are; once
    // more after the last has left. Nothing where there is nothing to say.
    [[nodiscard]] std::optional<WallHands> tick(double now);

  private:
    void hear(double now);

    config::TouchedSurface surface_;
    glm::dvec3 sweetSpot_;
    UdpPort port_;
    tuio::HandSet seen_;
    bool hadHands_ = false;
};

}  // namespace aquarama::console
