// SPDX-License-Identifier: Apache-2.0
#include "common/wall/pinhole.h"

#include <cassert>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

// Yaw about y, then pitch about the turned x, then roll about the turned z axis; radians.
glm::dmat3 turned(glm::dvec3 yawPitchRoll) {
    const glm::dquat yaw = glm::angleAxis(yawPitchRoll.x, glm::dvec3(0, 1, 0));
    const glm::dquat pitch = glm::angleAxis(yawPitchRoll.y, glm::dvec3(1, 0, 0));
    const glm::dquat roll = glm::angleAxis(yawPitchRoll.z, glm::dvec3(0, 0, 1));
    return glm::mat3_cast(yaw * pitch * roll);
}

}  // namespace

Pinhole::Pinhole(const config::Channel& channel)
    : wallFromProjector_(turned(channel.projector.yawPitchRollRadians)),
      position_(channel.projector.positionMetres),
      focal_(channel.projector.focalPixels),
      principal_(channel.projector.principalPixels),
      size_(channel.sizePixels) {
    assert(focal_.x > 0);
    assert(focal_.y > 0);
}

Ray Pinhole::ray(glm::dvec2 pixel) const {
    const glm::dvec2 tangent = (pixel - principal_) / focal_;  // rows run down, y runs up
    return {position_, wallFromProjector_ * glm::dvec3(tangent.x, -tangent.y, -1)};
}

std::optional<glm::dvec2> Pinhole::pixelOf(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - position_) * wallFromProjector_;  // the transpose, applied
    if (seen.z >= 0) return std::nullopt;
    const glm::dvec2 pixel = principal_ + focal_ * glm::dvec2(seen.x, -seen.y) / -seen.z;
    const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x <= size_.x && pixel.y <= size_.y;
    return inside ? std::optional(pixel) : std::nullopt;
}

std::optional<glm::dvec3> screenHit(const config::Screen& screen,
                                    const Ray& ray,
                                    double spillMetres) {
    // Where the ray o + t d crosses the cylinder x^2 + z^2 = r^2: a t^2 + 2 b t + c = 0.
    const glm::dvec3& o = ray.origin;
    const glm::dvec3& d = ray.direction;
    const double a = d.x * d.x + d.z * d.z;
    const double b = o.x * d.x + o.z * d.z;
    const double c = o.x * o.x + o.z * o.z - screen.radiusMetres * screen.radiusMetres;
    const double root = b * b - a * c;
    if (a <= 0 || root < 0) return std::nullopt;
    // Of the two crossings the far one is on the inside of the screen, where the light leaves the
    // cylinder.
    const double along = (std::sqrt(root) - b) / a;
    if (along <= 0) return std::nullopt;
    const glm::dvec3 point = o + along * d;
    const double halfArc = screen.arcRadians / 2 + spillMetres / screen.radiusMetres;
    const double halfHeight = screen.heightMetres / 2 + spillMetres;
    if (std::abs(azimuthOf(point)) > halfArc || std::abs(point.y) > halfHeight) return std::nullopt;
    return point;
}

bool lightsInside(const Pinhole& projector, glm::dvec3 screenPointMetres) {
    const glm::dvec3 inwards(-screenPointMetres.x, 0, -screenPointMetres.z);
    return glm::dot(projector.position() - screenPointMetres, inwards) > 0;
}

double azimuthOf(glm::dvec3 point) {
    return std::atan2(point.x, -point.z);
}

namespace {

// One point for each pixel or two of a projector.
constexpr int kStepsPerSide = 2048;

// Calls visit for points along the border of the unit square, corners included.
template <class Visit>
void walkUnitSquare(Visit visit) {
    for (int i = 0; i <= kStepsPerSide; ++i) {
        const double t = static_cast<double>(i) / kStepsPerSide;
        visit(glm::dvec2(t, 0));
        visit(glm::dvec2(t, 1));
        visit(glm::dvec2(0, t));
        visit(glm::dvec2(1, t));
    }
}

}  // namespace

std::vector<glm::dvec3> litOutline(const config::Screen& screen,
                                   const Pinhole& projector,
                                   double spillMetres) {
    // The screen enlarged by its spill.
    config::Screen spilled = screen;
    spilled.arcRadians += 2 * spillMetres / screen.radiusMetres;
    spilled.heightMetres += 2 * spillMetres;
    std::vector<glm::dvec3> outline;
    walkUnitSquare([&](glm::dvec2 t) {
        if (const auto point = screenHit(spilled, projector.ray(t * projector.size()), 0))
            outline.push_back(*point);
        const glm::dvec3 edge = screenPointAt(spilled, t);
        if (projector.pixelOf(edge) && lightsInside(projector, edge)) outline.push_back(edge);
    });
    return outline;
}

}  // namespace aquarama::wall
