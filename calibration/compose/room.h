// SPDX-License-Identifier: Apache-2.0
// The dark hall around the wall: floor, ceiling, walls and a row of people, lit by the screen
// alone.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/picture.h"
#include "common/wall/surface.h"

namespace aquarama::compose {

// The greatest distance of the screen from the wall's y axis, and its heights; metres.
struct ScreenReach {
    double radius = 0, bottom = 0, top = 0;
};
[[nodiscard]] ScreenReach reachOf(const wall::ScreenSurface& screen);
// Points all over the screen, edges included.
[[nodiscard]] std::vector<glm::dvec3> pointsOn(const wall::ScreenSurface& screen);

// The screen as a coarse grid of lamps that light the room.
class ScreenGlow {
  public:
    ScreenGlow(const wall::ScreenSurface& screen, const Light& panorama);
    // The light that a white matt surface at this point of the wall's frame would reflect; the
    // normal has length one.
    [[nodiscard]] glm::vec3 on(glm::dvec3 point, glm::dvec3 normal) const;
    [[nodiscard]] const glm::vec3& mean() const { return mean_; }
    // The screen out of focus, as in the reflection of a dull floor; unrolled coordinates.
    [[nodiscard]] glm::vec3 blurred(glm::dvec2 unrolledPosition) const;

  private:
    struct Lamp {
        glm::dvec3 centre, facing;
        double squareMetres;
        glm::vec3 light;
    };
    std::vector<Lamp> lamps_;
    Light coarse_;
    glm::vec3 mean_{};
};

// A part of a body.
struct Capsule {
    glm::dvec3 from, to;  // a segment
    double radius;        // and all that is this near to it, metres
};

// One of the audience, a dark shape before the screen.
struct Person {
    std::vector<Capsule> body;
    glm::dvec3 centre;  // of a ball that holds the body
    double reach;
};

// The light that the screen reflects at one of its points.
using ScreenLight = std::function<glm::vec3(glm::dvec3 point)>;

// The hall as an eye sees it; keeps a reference to the screen.
class Room {
  public:
    Room(const wall::ScreenSurface& screen,
         const Light& panorama,
         ScreenLight light,
         glm::dvec3 eye);
    // The mean light along the rays (with directions of length one) of one pixel. The light on
    // floor, ceiling and walls changes slowly, so it is computed once for each pixel.
    [[nodiscard]] glm::vec3 seen(std::span<const wall::Ray> rays) const;

  private:
    [[nodiscard]] std::optional<glm::vec3> person(const wall::Ray& ray) const;
    [[nodiscard]] glm::vec3 walls(const wall::Ray& ray) const;

    const wall::ScreenSurface& screen_;
    ScreenLight light_;
    ScreenGlow glow_;
    std::vector<Person> audience_;
    glm::dvec3 low_, high_;  // corners
};

}  // namespace aquarama::compose
