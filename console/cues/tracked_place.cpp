// SPDX-License-Identifier: Apache-2.0
#include "console/cues/tracked_place.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace aquarama::console {

namespace {

// Above the floor: where fish look for a person. On a screen that is higher or lower the nearest
// height that it has, so far off at most.
constexpr double kChestMetres = 1.2;
constexpr double kMostAsideMetres = 1.5;
constexpr double kStepMetres = 0.1;
// Who stands at the screen may be seen so far behind it.
constexpr double kBehindMetres = 0.3;

// In plan.
double lengthOnFloor(glm::dvec3 way) {
    return std::hypot(way.x, way.z);
}

}  // namespace

glm::dvec3 pointAt(const config::TouchedSurface& surface, glm::dvec2 place) {
    const glm::dvec3 across = surface.topRight - surface.topLeft;
    const glm::dvec3 down = surface.bottomLeft - surface.topLeft;
    return surface.topLeft + across * place.x + down * place.y;
}

TrackedPlaces::TrackedPlaces(const config::Rig& rig)
    : surface_{*rig.touch}, sweetSpot_{rig.sweetSpotMetres} {
    if (surface_.peopleReachMetres) screen_ = wall::makeSurface(rig);
}

std::optional<glm::vec3> TrackedPlaces::pointOf(glm::dvec2 place) const {
    const glm::dvec3 seen = pointAt(surface_, place);
    if (!arePeople()) return glm::vec3(seen - sweetSpot_);
    const auto front = inFrontOf(seen);
    if (!front) return std::nullopt;
    const glm::dvec3 tolerance = kBehindMetres * glm::normalize(screen_->normalAt(*front));
    const glm::dvec3 chest{seen.x, front->y, seen.z};
    if (!wall::isBefore(*screen_, chest + tolerance, *front)) return std::nullopt;
    const double off = lengthOnFloor(seen - *front);
    const glm::dvec3 toFront = *front - sweetSpot_;
    const double way = lengthOnFloor(toFront);
    if (off > *surface_.peopleReachMetres || off >= way) return std::nullopt;
    return glm::vec3(toFront * (1 - off / way));
}

// The place of the screen at somebody's chest, as the screen is unrolled.
std::optional<glm::dvec3> TrackedPlaces::inFrontOf(glm::dvec3 floor) const {
    for (double aside = 0; aside <= kMostAsideMetres; aside += kStepMetres)
        for (const double height : {kChestMetres + aside, kChestMetres - aside})
            if (const auto point = screen_->at(screen_->unrolled(floor + glm::dvec3(0, height, 0))))
                return point;
    return std::nullopt;
}

}  // namespace aquarama::console
