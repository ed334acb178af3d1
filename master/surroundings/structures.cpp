// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/structures.h"

#include <algorithm>
#include <cmath>

#include "common/base/random_streams.h"

namespace aquarama::surroundings {

namespace {

// Boulders nearer than this in plan belong to one structure; smaller ones are none.
constexpr float kTogetherMetres = 2.2F;
constexpr float kLeastRadiusMetres = 0.45F;
constexpr float kLeastLiking = 0.3F;

float topOf(const place::Rock& rock) {
    return rock.centre.y + rock.radiusMetres;
}

}  // namespace

std::vector<Structure> structuresOf(const place::Obstacles& obstacles) {
    std::vector<place::Rock> rocks;
    const place::Region& water = obstacles.water;
    for (const place::Rock& rock : obstacles.rocks)
        if (rock.radiusMetres >= kLeastRadiusMetres &&
            std::abs(rock.centre.x - water.centre.x) < water.halfExtent.x &&
            std::abs(rock.centre.z - water.centre.z) < water.halfExtent.z)
            rocks.push_back(rock);
    std::ranges::stable_sort(
        rocks, [](const place::Rock& a, const place::Rock& b) { return topOf(a) > topOf(b); });
    std::vector<Structure> structures;
    for (const place::Rock& rock : rocks) {
        if (structures.size() == kMostStructures) break;
        const glm::vec3 crown{rock.centre.x, topOf(rock), rock.centre.z};
        const bool belongs = std::ranges::any_of(structures, [&](const Structure& other) {
            const glm::vec3 from = crown - other.crown;
            return from.x * from.x + from.z * from.z < kTogetherMetres * kTogetherMetres;
        });
        if (belongs) continue;
        const float share = unitOf(hashOf(rock.seed, Stream::Liking, obstacles.place.seed));
        structures.push_back({crown, rock.radiusMetres, kLeastLiking + (1 - kLeastLiking) * share});
    }
    return structures;
}

}  // namespace aquarama::surroundings
