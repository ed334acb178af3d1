// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::compose {

namespace {

constexpr glm::ivec2 kLamps(24, 6);

// The mean of the panorama under each cell of a coarse grid.
Light coarsened(const Light& fine, glm::ivec2 cells) {
    Light coarse = darkness(cells);
    Light counts = darkness(cells);  // of pixels in each
    for (int y = 0; y < fine.sizePixels.y; ++y)
        for (int x = 0; x < fine.sizePixels.x; ++x) {
            const glm::ivec2 cell = glm::ivec2(x, y) * cells / fine.sizePixels;
            coarse.at(cell.x, cell.y) += fine.at(x, y);
            counts.at(cell.x, cell.y).x += 1;
        }
    for (std::size_t i = 0; i < coarse.rgb.size(); ++i)
        coarse.rgb[i] /= std::max(1.0F, counts.rgb[i].x);
    return coarse;
}

constexpr double kFloorBelowScreen = 0.3;    // metres
constexpr double kCeilingAboveScreen = 1.1;  // over the projectors
constexpr double kSeatsBeforeEye = 3.0;
constexpr double kLeastHallMetres = 2.2;    // round a smaller screen nobody sits
constexpr double kSeatedHeadMetres = 1.02;  // middle of the head above the floor
constexpr float kFloorAlbedo = 0.3F;
constexpr float kWallAlbedo = 0.1F;
constexpr float kPersonAlbedo = 0.25F;
constexpr float kFloorGloss = 0.12F;  // of what a mirror would show,
constexpr double kGlossFade = 0.35;   // its edges dissolved over this share of the screen's height
constexpr float kBounce = 0.006F;     // of the screen's mean light, everywhere in the hall

// Distance along a ray to a capsule; negative or infinite where it passes.
double distanceTo(const Capsule& capsule, const wall::Ray& ray) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const glm::dvec3 axis = capsule.to - capsule.from;
    const glm::dvec3 start = ray.origin - capsule.from;
    const double axisAxis = glm::dot(axis, axis);
    const double axisRay = glm::dot(axis, ray.direction);
    const double axisStart = glm::dot(axis, start);
    const double a = axisAxis - axisRay * axisRay;
    const double b = axisAxis * glm::dot(ray.direction, start) - axisStart * axisRay;
    const double c = axisAxis * glm::dot(start, start) - axisStart * axisStart -
                     capsule.radius * capsule.radius * axisAxis;
    const double root = b * b - a * c;
    if (root < 0) return kNever;
    const double side = (-b - std::sqrt(root)) / a;
    const double height = axisStart + side * axisRay;
    if (height > 0 && height < axisAxis) return side;
    const glm::dvec3 end = height <= 0 ? start : ray.origin - capsule.to;
    const double along = glm::dot(ray.direction, end);
    const double endRoot = along * along - glm::dot(end, end) + capsule.radius * capsule.radius;
    return endRoot < 0 ? kNever : -along - std::sqrt(endRoot);
}

glm::dvec3 normalOf(const Capsule& capsule, glm::dvec3 point) {
    const glm::dvec3 axis = capsule.to - capsule.from;
    const double along =
        glm::clamp(glm::dot(point - capsule.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
    return glm::normalize(point - capsule.from - along * axis);
}

// Sizes of an adult; the head's middle is the origin.
Person seatedPerson(glm::dvec3 head, double size) {
    const auto part = [&](glm::dvec3 from, glm::dvec3 to, double radius) {
        return Capsule{head + size * from, head + size * to, size * radius};
    };
    return {{part({0, -0.015, 0}, {0, 0.02, 0.01}, 0.095),  // skull
             part({0, -0.06, -0.02}, {0, -0.03, -0.02}, 0.075),
             part({0, -0.3, 0.02}, {0, -0.1, 0}, 0.062),  // neck
             part({-0.05, -0.185, 0.02}, {-0.165, -0.25, 0.02}, 0.06),
             part({0.05, -0.185, 0.02}, {0.165, -0.25, 0.02}, 0.06),
             part({-0.07, -0.33, 0.02}, {-0.06, -0.8, 0.02}, 0.13),  // back
             part({0.07, -0.33, 0.02}, {0.06, -0.8, 0.02}, 0.13),
             part({-0.185, -0.26, 0.02}, {-0.24, -0.6, -0.03}, 0.05),  // arms
             part({0.185, -0.26, 0.02}, {0.24, -0.6, -0.03}, 0.05)},
            head + size * glm::dvec3(0, -0.4, 0),
            size * 0.65};
}

// Some people between the eye and the screen, a child among them; their heads stay under the
// projectors' light.
std::vector<Person> seatedRow(double floor, double middleZ) {
    struct Seat {
        double x, z, size;
    };
    std::vector<Person> row;
    for (const Seat& seat : {Seat{-1.66, 0.05, 1.0},
                             Seat{-0.98, -0.04, 1.05},
                             Seat{-0.38, 0.02, 0.76},
                             Seat{1.05, 0.0, 0.97},
                             Seat{1.72, 0.06, 1.03}}) {
        const double head = floor + kSeatedHeadMetres * (0.4 + 0.6 * seat.size);
        row.push_back(seatedPerson({seat.x, head, middleZ + seat.z}, seat.size));
    }
    return row;
}

}  // namespace

ScreenReach reachOf(const wall::ScreenSurface& screen) {
    ScreenReach reach{.radius = 0, .bottom = 1e9, .top = -1e9};
    for (const glm::dvec3& point : pointsOn(screen)) {
        reach.radius = std::max(reach.radius, std::hypot(point.x, point.z));
        reach.bottom = std::min(reach.bottom, point.y);
        reach.top = std::max(reach.top, point.y);
    }
    return reach;
}

std::vector<glm::dvec3> pointsOn(const wall::ScreenSurface& screen) {
    constexpr int kPlaces = 64;  // each way
    std::vector<glm::dvec3> points = screen.border(0);
    for (int y = 0; y <= kPlaces; ++y)
        for (int x = 0; x <= kPlaces; ++x)
            if (const auto point = screen.at(glm::dvec2(x, y) / double{kPlaces}))
                points.push_back(*point);
    return points;
}

namespace {

// Of the part of the screen under a small rectangle of the panorama about a place, per share of the
// whole panorama.
double squareMetresAt(const wall::ScreenSurface& screen, glm::dvec2 place) {
    constexpr double kStep = 1e-3;
    const auto here = screen.at(place);
    const auto right = screen.at(place + glm::dvec2(kStep, 0));
    const auto down = screen.at(place + glm::dvec2(0, kStep));
    if (!here || !right || !down) return 0;
    return glm::length(glm::cross(*right - *here, *down - *here)) / (kStep * kStep);
}

}  // namespace

ScreenGlow::ScreenGlow(const wall::ScreenSurface& screen, const Light& panorama)
    : coarse_(coarsened(panorama, kLamps)) {
    for (int y = 0; y < kLamps.y; ++y)
        for (int x = 0; x < kLamps.x; ++x) {
            const glm::dvec2 place = glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(kLamps);
            const auto centre = screen.at(place);
            if (!centre) continue;
            const double squareMetres = squareMetresAt(screen, place) / (kLamps.x * kLamps.y);
            const glm::dvec3 facing = glm::normalize(screen.normalAt(*centre));
            lamps_.push_back({*centre, facing, squareMetres, coarse_.at(x, y)});
            mean_ += coarse_.at(x, y) / float{kLamps.x * kLamps.y};
        }
}

// Lambert's two cosines over pi r^2; the lamp's own area under the fraction keeps it finite nearby.
glm::vec3 ScreenGlow::on(glm::dvec3 point, glm::dvec3 normal) const {
    glm::vec3 sum(0);
    for (const Lamp& lamp : lamps_) {
        const glm::dvec3 way = lamp.centre - point;
        const double cosines = -glm::dot(lamp.facing, way) * glm::dot(normal, way);
        if (cosines <= 0 || glm::dot(normal, way) <= 0) continue;
        const double square = glm::dot(way, way);
        const double share = cosines * lamp.squareMetres /
                             (square * (std::numbers::pi * square + lamp.squareMetres));
        sum += static_cast<float>(share) * lamp.light;
    }
    return sum;
}

glm::vec3 ScreenGlow::blurred(glm::dvec2 position) const {
    return bilinear(coarse_, position * glm::dvec2(kLamps));
}

Room::Room(const wall::ScreenSurface& screen,
           const Light& panorama,
           ScreenLight light,
           glm::dvec3 eye)
    : screen_(screen), light_(std::move(light)), glow_(screen, panorama) {
    const auto [radius, bottom, top] = reachOf(screen);
    low_ = {-1.5 * radius, bottom - kFloorBelowScreen, -1.25 * radius};
    high_ = {1.5 * radius, top + kCeilingAboveScreen, 2.5 * radius};
    if (radius > kLeastHallMetres) audience_ = seatedRow(low_.y, eye.z - kSeatsBeforeEye);
}

glm::vec3 Room::seen(std::span<const wall::Ray> rays) const {
    glm::vec3 sum(0);
    std::optional<glm::vec3> wall;
    for (const wall::Ray& ray : rays) {
        if (const auto body = person(ray)) {
            sum += *body;
        } else if (const auto point = screen_.hit(ray, 0)) {
            sum += light_(*point);
        } else {
            if (!wall) wall = walls(ray);
            sum += *wall;
        }
    }
    return sum / static_cast<float>(rays.size());
}

std::optional<glm::vec3> Room::person(const wall::Ray& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    const Capsule* hit = nullptr;
    for (const Person& person : audience_) {
        const glm::dvec3 way = person.centre - ray.origin;
        const double along = glm::dot(way, ray.direction);
        if (glm::dot(way, way) - along * along > person.reach * person.reach) continue;
        for (const Capsule& part : person.body) {
            const double distance = distanceTo(part, ray);
            if (distance <= 0 || distance >= nearest) continue;
            nearest = distance;
            hit = &part;
        }
    }
    if (hit == nullptr) return std::nullopt;
    const glm::dvec3 point = ray.origin + nearest * ray.direction;
    return kPersonAlbedo * (glow_.on(point, normalOf(*hit, point)) + kBounce * glow_.mean());
}

glm::vec3 Room::walls(const wall::Ray& ray) const {
    const glm::dvec3 to = glm::mix(low_, high_, glm::step(glm::dvec3(0), ray.direction));
    const glm::dvec3 steps = (to - ray.origin) / ray.direction;
    const double distance = std::min({steps.x, steps.y, steps.z});
    const glm::dvec3 point = ray.origin + distance * ray.direction;
    glm::dvec3 normal(0);
    const int axis = distance == steps.y ? 1 : (distance == steps.x ? 0 : 2);
    normal[axis] = ray.direction[axis] < 0 ? 1 : -1;
    if (normal.y < 1) return kWallAlbedo * (glow_.on(point, normal) + kBounce * glow_.mean());

    glm::vec3 light = kFloorAlbedo * (glow_.on(point, normal) + kBounce * glow_.mean());
    const wall::Ray mirrored{point, ray.direction * glm::dvec3(1, -1, 1)};
    if (const auto image = screen_.hit(mirrored, 0)) {
        const glm::dvec2 at = screen_.unrolled(*image);
        const double fromEdge = std::min({at.x, 1 - at.x, at.y, 1 - at.y});
        const auto share = static_cast<float>(glm::smoothstep(0.0, kGlossFade, fromEdge));
        light += kFloorGloss * share * glow_.blurred(at);
    }
    return light;
}

}  // namespace aquarama::compose
