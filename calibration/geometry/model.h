// SPDX-License-Identifier: Apache-2.0
// The solver's model of a hall: lenses, poses and a screen that is displaced along its normals.
// Templates on the number type T: double, or Ceres' dual numbers. Wall frame, metres.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <ceres/rotation.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/brown_lens.h"
#include "common/config/rig.h"
#include "common/wall/surface.h"

namespace aquarama::geometry {

// A lens of a camera or a projector: a pinhole with the distortion of BrownLens. Pixels from the
// top left corner of the picture; x right, y down, z along the axis.
namespace lens {
enum : std::size_t { Focal, Aspect, CentreX, CentreY, K1, K2, K3, P1, P2, Count };
}
using LensParameters = std::array<double, lens::Count>;

// The transform from the wall's frame to that of a camera or projector (x right, y down, z ahead):
// a rotation as an axis times its angle, then a shift in metres.
using PoseParameters = std::array<double, 6>;

// Two and three numbers, for doubles and for the solver's derivatives.
template <class T>
using Two = std::array<T, 2>;
template <class T>
using Three = std::array<T, 3>;

// The scalar product.
template <class T>
T dot(const Three<T>& a, const Three<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The pixel of a tangent from the axis of a lens (LensParameters).
template <class T>
Two<T> imaged(const T* lens, const Two<T>& tangent) {
    const BrownLens<T> distortion{
        lens[lens::K1], lens[lens::K2], lens[lens::K3], lens[lens::P1], lens[lens::P2]};
    const auto [across, down] = distortion.imageOf(tangent[0], tangent[1]);
    return {lens[lens::CentreX] + lens[lens::Focal] * across,
            lens[lens::CentreY] + lens[lens::Focal] * lens[lens::Aspect] * down};
}

// Transforms a point from the wall's frame to that of a camera or projector.
template <class T>
Three<T> inFrame(const T* pose, const Three<T>& point) {
    Three<T> turned;
    ceres::AngleAxisRotatePoint(pose, point.data(), turned.data());
    return {turned[0] + pose[3], turned[1] + pose[4], turned[2] + pose[5]};
}

// The pixel in which a lens at a pose images a point of the wall's frame.
template <class T>
Two<T> pixelOf(const T* lens, const T* pose, const Three<T>& point) {
    const Three<T> seen = inFrame(pose, point);
    return imaged(lens, Two<T>{seen[0] / seen[2], seen[1] / seen[2]});
}

// A tangent of a lens, and its derivative by the pixel that images it.
struct Tangent {
    glm::dvec2 tangent{};
    glm::dmat2 byPlace{1};
};
// The tangent whose image is this pixel.
[[nodiscard]] Tangent tangentOf(const LensParameters& lens, glm::dvec2 place);

// The ray through a pixel. `from` is the tangent of the pixel in double; one step of Newton's
// method gives it its derivatives.
template <class T>
struct RayOf {
    Three<T> origin, direction;
};
template <class T>
RayOf<T> rayOf(const T* lens, const T* pose, glm::dvec2 place, const Tangent& from) {
    const Two<T> fixed{T(from.tangent.x), T(from.tangent.y)};
    const Two<T> at = imaged(lens, fixed);
    const T across = place.x - at[0], down = place.y - at[1];
    const Three<T> seen{fixed[0] + from.byPlace[0][0] * across + from.byPlace[1][0] * down,
                        fixed[1] + from.byPlace[0][1] * across + from.byPlace[1][1] * down,
                        T(1.0)};
    const Three<T> back{-pose[0], -pose[1], -pose[2]};
    const Three<T> shift{-pose[3], -pose[4], -pose[5]};
    RayOf<T> ray;
    ceres::AngleAxisRotatePoint(back.data(), shift.data(), ray.origin.data());
    ceres::AngleAxisRotatePoint(back.data(), seen.data(), ray.direction.data());
    return ray;
}

// The four cubic B-splines that are not 0 in a cell, at t from its beginning (0) to its end (1).
template <class T>
std::array<T, 4> splineWeights(const T& t) {
    const T s = 1.0 - t;
    const T t2 = t * t;
    return {s * s * s / 6.0,
            (3.0 * t2 * t - 6.0 * t2 + 4.0) / 6.0,
            (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
            t2 * t / 6.0};
}

// A smooth function of a place (0 to 1 both ways), as a bicubic B-spline.
class SmoothField {
  public:
    // `cells` across and down.
    explicit SmoothField(glm::ivec2 cells)
        : cells_{cells}, controls_(static_cast<std::size_t>((cells.x + 3) * (cells.y + 3)), 0.0) {}

    // A cell of the grid, and the place in it.
    struct Cell {
        glm::ivec2 index{};
        glm::dvec2 within{};  // 0 to 1
    };
    // For a place outside, the nearest cell.
    [[nodiscard]] Cell cellAt(glm::dvec2 place) const;
    [[nodiscard]] double at(glm::dvec2 place) const;
    [[nodiscard]] glm::ivec2 cells() const { return cells_; }
    // The index of the control in this column and row, from 0.
    [[nodiscard]] std::size_t control(int column, int row) const {
        return static_cast<std::size_t>(row * (cells_.x + 3) + column);
    }
    [[nodiscard]] std::vector<double>& controls() { return controls_; }
    [[nodiscard]] const std::vector<double>& controls() const { return controls_; }

  private:
    glm::ivec2 cells_;
    std::vector<double> controls_;
};

// The screen of a rig, displaced along its normals (positive towards the audience) by a smooth
// field over the unrolled screen; a plane continues it beyond its edges. Refers to the screen.
class BumpyScreen {
  public:
    BumpyScreen(const wall::ScreenSurface& screen, glm::ivec2 cells)
        : screen_{screen}, displacement_{cells} {}

    // A point of the screen, and where it lies on the unrolled one.
    struct Place {
        glm::dvec3 point{};       // on the displaced screen
        glm::dvec3 normal{};      // of the displaced screen, length one
        glm::dvec3 baseNormal{};  // of the rig's
        glm::dvec2 unrolled{};    // of the rig's screen, 0 to 1 where the ray meets it
    };
    // The place where a ray meets it, to a micrometre; nothing where the ray misses it.
    [[nodiscard]] std::optional<Place> hit(const wall::Ray& ray) const {
        return hit(ray, displacement_);
    }
    // The place on the normal at a place of the unrolled screen, which is clamped to the screen.
    [[nodiscard]] Place at(glm::dvec2 unrolled) const { return at(unrolled, displacement_); }
    // The same with another displacement, a class with at(place).
    template <class Displacement>
    [[nodiscard]] std::optional<Place> hit(const wall::Ray& ray,
                                           const Displacement& displacement) const;
    template <class Displacement>
    [[nodiscard]] Place at(glm::dvec2 unrolled, const Displacement& displacement) const;

    // The screen as the rig has it, and its displacement along the normals.
    [[nodiscard]] const wall::ScreenSurface& screen() const { return screen_; }
    [[nodiscard]] SmoothField& displacement() { return displacement_; }
    [[nodiscard]] const SmoothField& displacement() const { return displacement_; }

  private:
    // The point of the rig's screen at a place, which is clamped to the screen: from the corners of
    // a dome's panorama, which have no screen, the place is moved towards the middle.
    [[nodiscard]] glm::dvec3 baseAt(glm::dvec2& place) const;

    const wall::ScreenSurface& screen_;
    SmoothField displacement_;
};

// The point of the bumpy screen over a place of the unrolled one.
template <class Displacement>
BumpyScreen::Place BumpyScreen::at(glm::dvec2 unrolled, const Displacement& displacement) const {
    Place place{.unrolled = unrolled};
    const auto displaced = [&](glm::dvec2& at, glm::dvec3& normal) {
        const glm::dvec3 base = baseAt(at);
        normal = glm::normalize(screen_.normalAt(base));
        return base + displacement.at(at) * normal;
    };
    place.point = displaced(place.unrolled, place.baseNormal);
    constexpr double kStep = 1e-4;  // the normal by differences
    const auto aside = [&](glm::dvec2 step) {
        const bool back = place.unrolled.x + step.x > 1 || place.unrolled.y + step.y > 1;
        glm::dvec2 at = place.unrolled + (back ? -step : step);
        glm::dvec3 ignored;
        return (displaced(at, ignored) - place.point) * (back ? -1.0 : 1.0);
    };
    const glm::dvec3 normal = glm::cross(aside({kStep, 0}), aside({0, kStep}));
    place.normal = glm::length(normal) > 0 ? glm::normalize(normal) : place.baseNormal;
    if (glm::dot(place.normal, place.baseNormal) < 0) place.normal = -place.normal;
    return place;
}

// Where a ray meets the bumpy screen; nothing where it does not.
template <class Displacement>
std::optional<BumpyScreen::Place> BumpyScreen::hit(const wall::Ray& ray,
                                                   const Displacement& displacement) const {
    constexpr double kBeyondMetres = 1.0;  // light beyond the edges meets the plane there
    const auto base = screen_.hit(ray, kBeyondMetres);
    if (!base) return std::nullopt;
    glm::dvec3 point = *base;
    Place place;
    for (int i = 0; i < 12; ++i) {
        place = at(screen_.unrolled(point), displacement);
        const double slope = glm::dot(ray.direction, place.normal);
        if (slope == 0) return std::nullopt;
        const glm::dvec3 next =
            ray.origin + ray.direction * (glm::dot(place.point - ray.origin, place.normal) / slope);
        const double moved = glm::length(next - point);
        point = next;
        if (moved < 1e-7) break;
    }
    place.unrolled = screen_.unrolled(point);
    place.point = point;
    return place;
}

// The parameters of a projector of the rig.
[[nodiscard]] LensParameters lensOf(const config::Projector& projector);
[[nodiscard]] PoseParameters poseOf(const config::Projector& projector);
// The pose of a device at a position, which looks along -z of its own frame with y up.
[[nodiscard]] PoseParameters poseOf(glm::dvec3 position, const glm::dmat3& wallFromOwn);
[[nodiscard]] glm::dvec3 positionOf(const PoseParameters& pose);
[[nodiscard]] wall::Ray rayOf(const LensParameters& lens,
                              const PoseParameters& pose,
                              glm::dvec2 place);

}  // namespace aquarama::geometry
