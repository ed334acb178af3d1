// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/bounce.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

namespace aquarama::hall {

namespace {

constexpr glm::ivec2 kPatches(24, 12);
constexpr int kFormSamples = 3;   // each way, of a patch, for what it sees of another
constexpr int kLightSamples = 8;  // each way, for the light that falls on it

glm::dvec2 placeIn(glm::ivec2 cell, int x, int y, int samples) {
    return (glm::dvec2(cell) + (glm::dvec2(x, y) + 0.5) / double(samples)) / glm::dvec2(kPatches);
}

// The point of the screen at a place. The corners of a dome's square panorama have no screen: there
// it is the nearest point.
glm::dvec2 pulledIn(const wall::ScreenSurface& shape, glm::dvec2 place) {
    constexpr int kSteps = 50;
    for (int step = kSteps; step > 0; --step) {
        const glm::dvec2 inside = 0.5 + double(step) / kSteps * (place - 0.5);
        if (shape.at(inside)) return inside;
    }
    return glm::dvec2(0.5);
}

// For a share of the whole panorama; nothing where there is no screen.
double squareMetresAt(const wall::ScreenSurface& shape, glm::dvec2 place) {
    constexpr double kStep = 1e-4;
    const auto along = [&](glm::dvec2 way) -> std::optional<glm::dvec3> {
        const auto from = shape.at(place - way), to = shape.at(place + way);
        if (!from || !to) return std::nullopt;
        return (*to - *from) / (2 * kStep);
    };
    const auto right = along({kStep, 0}), down = along({0, kStep});
    return right && down ? glm::length(glm::cross(*right, *down)) : 0;
}

}  // namespace

Bounce::Bounce(const TrueHall& hall) : hall_{hall} {
    if (!hall.hall().screen.bounces) return;
    for (int y = 0; y < kPatches.y; ++y)
        for (int x = 0; x < kPatches.x; ++x) patches_.push_back(patchAt({x, y}));
    shares_.reserve(patches_.size() * patches_.size());
    for (const Patch& to : patches_)
        for (const Patch& from : patches_) shares_.push_back(shareOf(to, from));
}

namespace {

// Places of a patch, so many each way.
std::vector<glm::dvec2> placesOf(glm::ivec2 cell, int samples) {
    std::vector<glm::dvec2> places;
    places.reserve(static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples));
    for (int i = 0; i < samples * samples; ++i)
        places.push_back(placeIn(cell, i % samples, i / samples, samples));
    return places;
}

}  // namespace

Bounce::Patch Bounce::patchAt(glm::ivec2 cell) const {
    const wall::ScreenSurface& shape = hall_.screen().shape();
    Patch patch;
    patch.middle = *shape.at(pulledIn(shape, placeIn(cell, 0, 0, 1)));
    patch.normal = glm::normalize(shape.normalAt(patch.middle));
    constexpr double kCount = double(kFormSamples) * kFormSamples * kPatches.x * kPatches.y;
    for (const glm::dvec2 place : placesOf(cell, kFormSamples))
        if (const auto point = shape.at(place))
            patch.samples.push_back({*point,
                                     glm::normalize(shape.normalAt(*point)),
                                     squareMetresAt(shape, place) / kCount});
    std::vector<glm::dvec3> points;
    for (const glm::dvec2 place : placesOf(cell, kLightSamples))
        if (const auto point = hall_.screen().at(place)) points.push_back(*point);
    for (const glm::dvec3& point : points) light(patch, point, double(points.size()));
    return patch;
}

void Bounce::light(Patch& patch, glm::dvec3 point, double samples) const {
    for (std::size_t channel = 0; channel < hall_.channels(); ++channel) {
        const auto pixel = hall_.pixelOf(channel, point);
        if (!pixel) continue;
        patch.lit.push_back({channel,
                             glm::vec2(hall_.panelFrom(channel, *pixel)),
                             static_cast<float>(hall_.whiteAt(channel, point) / samples)});
    }
}

// The form factor: two cosines over pi times the squared distance. The screen is smooth, so that it
// is never large.
float Bounce::shareOf(const Patch& to, const Patch& from) const {
    double share = 0;
    for (const Patch::Sample& sample : from.samples) {
        const glm::dvec3 way = sample.point - to.middle;
        const double square = glm::dot(way, way);
        if (square < 1e-12) continue;
        const double cosines = glm::dot(to.normal, way) * -glm::dot(sample.normal, way);
        share +=
            std::max(0.0, cosines) * sample.squareMetres / (std::numbers::pi * square * square);
    }
    return static_cast<float>(share);
}

glm::vec3 Bounce::sentBack(const Patch& patch, const std::vector<ThrownPicture>& pictures) const {
    glm::vec4 sum(0);
    for (const Lit& lit : patch.lit) sum += lit.white * pictures[lit.channel].at(lit.panelPixel);
    return glm::vec3(sum);
}

Light Bounce::of(const std::vector<ThrownPicture>& pictures) const {
    std::vector<glm::vec3> sent;
    for (const Patch& patch : patches_) sent.push_back(sentBack(patch, pictures));
    return of(sent);
}

Light Bounce::of(const std::vector<glm::vec3>& patches) const {
    if (shares_.empty()) return darkness({1, 1});
    Light falls = darkness(kPatches);
    for (std::size_t to = 0; to < patches_.size(); ++to)
        for (std::size_t from = 0; from < patches_.size(); ++from)
            falls.rgb[to] += shares_[to * patches_.size() + from] * patches[from];
    return falls;
}

}  // namespace aquarama::hall
