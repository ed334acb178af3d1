// SPDX-License-Identifier: Apache-2.0

#include "common/wall/pinhole.h"

#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

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
      size_(channel.sizePixels) {}

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
    const glm::dvec3& o = ray.origin;
    const glm::dvec3& d = ray.direction;
    const double a = d.x * d.x + d.z * d.z;
    const double b = o.x * d.x + o.z * d.z;
    const double c = o.x * o.x + o.z * o.z - screen.radiusMetres * screen.radiusMetres;
    const double root = b * b - a * c;
    if (a <= 0 || root < 0) return std::nullopt;
    // The far crossing is where light leaves the cylinder: the screen's inside.
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

constexpr int kStepsPerSide = 2048;  // finer than a pixel

// Round the unit square, corners included.
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
