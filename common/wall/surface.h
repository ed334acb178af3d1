// SPDX-License-Identifier: Apache-2.0
// The surface of a screen of any shape: where rays meet it, and how it is unrolled to a panorama.
// Wall frame, metres.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::wall {

// Light is drawn this far beyond the edges of the screen, a few pixels, where the frame of the
// screen cuts it off. Without it, pixels whose centres lie just past an edge would leave a dark
// line along it.
inline constexpr double kSpillMetres = 0.015;

// A ray of light; the direction may have any length.
struct Ray {
    glm::dvec3 origin{};
    glm::dvec3 direction{};
};

// The surface of a test pattern, for a shader that computes the place of each pixel itself.
struct PatternGround {
    // The form of a screen.
    enum class Kind : std::uint8_t {
        Cylinder,  // about the local y axis; `size` is its radius
        Sphere,    // about the origin; `size` is its radius
        Plane,     // local z = -size
        Far        // the directions from the eye are those of the pattern
    };
    Kind kind = Kind::Cylinder;
    glm::dmat3 localFromWall{1.0};  // a rotation
    double size = 0;
    // Whether it may lie over and under the viewer too.
    [[nodiscard]] bool isAround() const { return kind == Kind::Sphere || kind == Kind::Far; }
};

// One side of a surface: the one that faces the audience. Immutable.
class ScreenSurface {
  public:
    virtual ~ScreenSurface() = default;
    // The point where a ray meets that side; nothing where it passes an edge by more than
    // `spillMetres`.
    [[nodiscard]] virtual std::optional<glm::dvec3> hit(const Ray& ray,
                                                        double spillMetres) const = 0;
    // The normal towards the audience at a point of the screen; of any length.
    [[nodiscard]] virtual glm::dvec3 normalAt(glm::dvec3 point) const = 0;
    // The place in the panorama: u from its left edge (0) to its right (1), v from its top (0) to
    // its bottom (1).
    [[nodiscard]] virtual glm::dvec2 unrolled(glm::dvec3 point) const = 0;
    // The inverse of unrolled(); nothing where the panorama shows no screen.
    [[nodiscard]] virtual std::optional<glm::dvec3> at(glm::dvec2 unrolledPosition) const = 0;
    // Points along the screen's edges, dense, in no order; moved outwards by `spillMetres`.
    [[nodiscard]] virtual std::vector<glm::dvec3> border(double spillMetres) const = 0;
    [[nodiscard]] virtual PatternGround patternGround() const = 0;
};

// Panels are a surface in pieces. Throws Error where the file of a measured screen cannot be used.
[[nodiscard]] std::unique_ptr<const ScreenSurface> makeSurface(const config::Rig& rig);
// A part of makeSurface(): the surface of triangles in the file of rig.screen.
[[nodiscard]] std::unique_ptr<const ScreenSurface> makeMeasuredSurface(const config::Rig& rig);

// Whether `position` is on the audience's side of the screen at this point of it, so that light
// from there falls on the point.
[[nodiscard]] bool isBefore(const ScreenSurface& screen, glm::dvec3 position, glm::dvec3 point);

// Azimuth of a point about the wall's y axis, in radians: 0 straight ahead, positive to the right.
[[nodiscard]] double azimuthOf(glm::dvec3 point);
// Its height over the horizon of the origin, in radians.
[[nodiscard]] double elevationOf(glm::dvec3 point);

// Yaw about y (left positive), then pitch about the turned x, then roll about the turned z axis;
// radians. From the turned frame to the wall's.
[[nodiscard]] glm::dmat3 turned(glm::dvec3 yawPitchRollRadians);

// The panorama of surfaces that cannot be unrolled: the view of an eye by azimuth and elevation,
// within a box.
class ViewBox {
  public:
    explicit ViewBox(glm::dvec3 eye) : eye_{eye} {}
    // Makes the box enclose these points.
    void enclose(std::span<const glm::dvec3> points);
    [[nodiscard]] glm::dvec2 placeOf(glm::dvec3 point) const;
    [[nodiscard]] glm::dvec3 directionAt(glm::dvec2 place) const;
    [[nodiscard]] glm::dvec3 eye() const { return eye_; }

  private:
    glm::dvec3 eye_;
    glm::dvec2 low_{0}, high_{1};  // azimuth and elevation, radians
};

// A panel's picture in space: the rectangle that its pixels show.
struct PanelFrame {
    PanelFrame(const config::Panel& panel, bool hidesBezels);
    glm::dvec3 middle;
    glm::dmat3 wallFromPanel;  // x right, y up, z towards the audience
    glm::dvec2 size;           // metres; with hidden bezels it reaches to their outer edge
    // x right and y up from the middle, z off the panel.
    [[nodiscard]] glm::dvec3 local(glm::dvec3 point) const {
        return (point - middle) * wallFromPanel;  // the transpose, applied
    }
    [[nodiscard]] glm::dvec3 point(glm::dvec2 position) const {
        return middle + wallFromPanel * glm::dvec3(position, 0);
    }
};

}  // namespace aquarama::wall
