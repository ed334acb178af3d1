// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/vision.h"

#include <algorithm>
#include <array>

#include "common/place/angle.h"
#include "common/place/place.h"

namespace aquarama::behaviour {

namespace {

constexpr float kSolidRock = 0.75F;          // of the radius that holds all that grows on it
constexpr float kHighestSandMetres = -8.0F;  // no dune is higher
constexpr int kSandSamples = 6;
constexpr float kBetweenCornersMetres = 0.05F;  // more than sand rises between a chart's corners

// A large body hides what is behind these balls along its middle line, in its lengths.
constexpr std::array kTrunk{0.2F, -0.05F, -0.3F};
constexpr float kTrunkRadius = 0.1F;

bool rocksHide(const surroundings::Obstacles& obstacles, const SightLine& ray) {
    for (const place::Rock& rock : obstacles.rocks)
        if (ray.passes(rock.centre, rock.radiusMetres * kSolidRock)) return true;
    return false;
}

bool sandHides(const surroundings::Obstacles& obstacles, const SightLine& ray) {
    const float highest =
        std::min(kHighestSandMetres, obstacles.chart.highestSand() + kBetweenCornersMetres);
    if (std::min(ray.from.y, ray.from.y + ray.offset.y) > highest) return false;
    for (int i = 1; i <= kSandSamples; ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(kSandSamples + 1);
        const glm::vec3 at = ray.from + ray.offset * along;
        if (at.y < kHighestSandMetres && at.y < place::floorHeight(obstacles.place, {at.x, at.z}))
            return true;
    }
    return false;
}

bool bodiesHide(const Environment& environment,
                std::uint32_t fish,
                std::uint32_t object,
                const SightLine& ray) {
    const fish::FishView& view = *environment.view;
    // Every body that the ray meets has its middle near the ray's.
    const float reach = 0.5F * place::lengthOf(ray.offset) + kLargeBodyMetres;
    const float reachSquared = reach * reach;
    bool hidden = false;
    environment.grids->large.visitAround(
        ray.from + ray.offset * 0.5F, reachSquared, [&](const auto& row) {
            for (const std::uint32_t body : row.index)
                hidden = hidden || (body != fish && body != object && bodyHides(view, body, ray));
        });
    return hidden;
}

}  // namespace

float conspicuousness(float lengthMetres) {
    return std::clamp(lengthMetres / kLargeBodyMetres, 1.0F, kMostConspicuous);
}

float sightMetres(const fish::SpeciesParameters& parameters,
                  float lengthMetres,
                  float conspicuous,
                  float clarityMetres) {
    return std::min(parameters.habits.visionBodyLengths * lengthMetres * conspicuous,
                    clarityMetres);
}

bool SightLine::passes(glm::vec3 centre, float radius) const {
    const glm::vec3 to = centre - from;
    const float squared = std::max(place::dot(offset, offset), 1.0e-6F);
    const float along = std::clamp(place::dot(to, offset) / squared, 0.0F, 1.0F);
    const glm::vec3 miss = to - offset * along;
    return place::dot(miss, miss) < radius * radius;
}

bool terrainHides(const surroundings::Obstacles& obstacles, const SightLine& ray) {
    return rocksHide(obstacles, ray) || sandHides(obstacles, ray);
}

bool bodyHides(const fish::FishView& view, std::uint32_t body, const SightLine& ray) {
    const glm::vec3 middle = view.position(body);
    const float length = view.fish[body].length;
    if (!ray.passes(middle, length)) return false;
    for (const float place : kTrunk)
        if (ray.passes(middle + view.heading(body) * (place * length), kTrunkRadius * length))
            return true;
    return false;
}

bool isHidden(const Environment& environment,
              std::uint32_t fish,
              std::uint32_t object,
              const SightLine& ray) {
    return terrainHides(environment.surroundings->obstacles, ray) ||
           bodiesHide(environment, fish, object, ray);
}

}  // namespace aquarama::behaviour
