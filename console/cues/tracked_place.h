// SPDX-License-Identifier: Apache-2.0
// Where on the screen a hand or a person is whom a tracker tells of.
#pragma once

#include <memory>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/wall/surface.h"

namespace aquarama::console {

// The point of a touched surface at a place of it (shares from its top left corner), wall frame,
// metres.
[[nodiscard]] glm::dvec3 pointAt(const config::TouchedSurface& surface, glm::dvec2 place);

// Immutable; for any thread.
class TrackedPlaces {
  public:
    // Of a rig whose touch is set. Throws Error where its screen cannot be used.
    explicit TrackedPlaces(const config::Rig& rig);

    // Of a hand the point that it touches; of a person one on the line from the viewer to the place
    // of the screen in front of them, as far before the screen as they stand: so it moves no faster
    // than they walk. From the sweet spot in the axes of the wall frame, metres. Nothing where a
    // person is too far off, beside the screen, behind it or behind the viewer.
    [[nodiscard]] std::optional<glm::vec3> pointOf(glm::dvec2 place) const;

    // Whether it tells people.
    [[nodiscard]] bool arePeople() const { return screen_ != nullptr; }

  private:
    [[nodiscard]] std::optional<glm::dvec3> inFrontOf(glm::dvec3 floor) const;

    config::TouchedSurface surface_;
    glm::dvec3 sweetSpot_;
    std::unique_ptr<const wall::ScreenSurface> screen_;  // null: of hands, which touch it
};

}  // namespace aquarama::console
