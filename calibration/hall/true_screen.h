// SPDX-License-Identifier: Apache-2.0
// The true screen of a simulated hall. Wall frame, metres.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/hall.h"
#include "common/config/rig.h"
#include "common/wall/mark.h"
#include "common/wall/surface.h"

namespace aquarama::hall {

// The rig's shape with other measures, bumps and dents. Immutable.
class TrueScreen {
  public:
    // A drape continues the screen this far past its edges.
    static constexpr double kDrapeMetres = 1.5;

    // Throws Error for panels: nothing is projected on them.
    TrueScreen(const config::Rig& rig, const config::Hall& hall);

    // Where a ray meets the screen or the drape.
    struct Meeting {
        glm::dvec3 point{}, foot{};  // the foot is on the smooth shape under the bumps
        bool isScreen = false;
        bool isMarked = false;  // covered by the crew's tape
    };
    // Exact to 1e-6 metres along the ray; nothing where the ray misses both.
    [[nodiscard]] std::optional<Meeting> meet(const wall::Ray& ray) const;
    [[nodiscard]] std::optional<glm::dvec3> hit(const wall::Ray& ray) const;
    // The normal towards the audience, with the slopes of bumps and dents; length one.
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const;
    // The point at a place of the unrolled smooth shape; nothing where there is no screen.
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 place) const;
    // Points along the true edges.
    [[nodiscard]] std::vector<glm::dvec3> border() const;
    // The height of bumps and dents, towards the audience.
    [[nodiscard]] double heightAt(glm::dvec3 foot) const;
    // The screen without bumps and dents.
    [[nodiscard]] const wall::ScreenSurface& shape() const { return *shape_; }

  private:
    struct Wave {
        glm::dvec3 number;  // radians per metre
        double phase, metres;
    };
    struct Dent {
        glm::dvec3 middle;
        double radius, depth;
    };
    void addBumps(const config::HallScreen& screen);
    [[nodiscard]] double highestBump() const;
    void addDents(const config::HallScreen& screen);
    void addMarks(const config::HallScreen& screen, config::ScreenShape shape);
    [[nodiscard]] std::optional<glm::dvec3> footOf(glm::dvec3 point) const;
    // The distance of a point before the bumpy screen; nothing far beside the screen.
    [[nodiscard]] std::optional<double> gap(glm::dvec3 point, glm::dvec3& foot) const;
    // False where the ray leaves the drape.
    [[nodiscard]] bool approach(const wall::Ray& ray, glm::dvec3 smooth, Meeting& meeting) const;
    [[nodiscard]] glm::dvec3 raised(glm::dvec3 foot) const;
    [[nodiscard]] glm::dvec3 slopeAt(glm::dvec3 foot) const;

    std::unique_ptr<const wall::ScreenSurface> shape_;
    std::vector<Wave> waves_;
    std::vector<Dent> dents_;
    std::vector<wall::MarkPlace> marks_;
    std::vector<double> marksOff_;  // metres along the edge
};

}  // namespace aquarama::hall
