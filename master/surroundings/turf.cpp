// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/turf.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/random_streams.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// Spots lie within this distance of the middle of their patch, and so far apart.
constexpr float kPatchSpreadMetres = 0.5F;
constexpr float kApartMetres = 0.14F;
// A spot is at least this far from the sand, and from other boulders in their radii.
constexpr float kOverSandMetres = 0.15F;
constexpr float kClearRadii = 1.02F;
// Lowest height of the normal at a spot: fish bite from above.
constexpr float kLeastUp = 0.15F;
constexpr std::uint32_t kTries = 12;
bool isClear(const place::Obstacles& obstacles, const place::Rock& own, glm::vec3 spot) {
    if (spot.y < place::floorHeight(obstacles.place, {spot.x, spot.z}) + kOverSandMetres)
        return false;
    const auto isIn = [&](const place::Rock& other) {
        return other.seed != own.seed &&
               place::lengthOf(other.centre - spot) < kClearRadii * other.radiusMetres;
    };
    constexpr float kAnyHeight = -1.0e6F;
    return !place::anyRockNear(obstacles, {spot.x, spot.z}, kAnyHeight, isIn);
}

// A spot drawn about a patch that is clear and apart from those before it, else the middle.
glm::vec3 spotOf(const place::Obstacles& obstacles,
                 const place::Rock& rock,
                 const TurfPatch& patch,
                 std::size_t spots,
                 std::uint32_t hash) {
    for (std::uint32_t i = 0; i < kTries; ++i) {
        const std::uint32_t own = hashOf(hash, i);
        const glm::vec3 aside{signedUnitOf(hashOf(own, 1)),
                              signedUnitOf(hashOf(own, 2)),
                              signedUnitOf(hashOf(own, 3))};
        const glm::vec3 direction = place::directionOf(
            patch.place + aside * kPatchSpreadMetres - rock.centre, patch.normal);
        const glm::vec3 spot = rock.centre + direction * (place::kDrawnRadii * rock.radiusMetres);
        const bool isApart =
            std::none_of(patch.spots.begin(), patch.spots.begin() + spots, [&](glm::vec3 other) {
                return place::lengthOf(other - spot) < kApartMetres;
            });
        if (direction.y > kLeastUp && isApart && isClear(obstacles, rock, spot)) return spot;
    }
    return patch.place;
}

}  // namespace

Turf makeTurf(std::uint32_t seed,
              const std::vector<place::Site>& sites,
              const place::Obstacles& obstacles) {
    Turf turf;
    for (const place::Site& site : sites) {
        if (site.kind != config::SiteKind::Turf || !place::isGrazed(obstacles.water, site.place))
            continue;
        const auto rock = std::ranges::find(obstacles.rocks, site.rockSeed, &place::Rock::seed);
        if (rock == obstacles.rocks.end()) continue;
        TurfPatch patch{
            .place = rock->centre + site.normal * (place::kDrawnRadii * rock->radiusMetres),
            .normal = site.normal,
            .boulder = rock->centre,
            .surfaceMetres = place::kDrawnRadii * rock->radiusMetres};
        const std::uint32_t own = hashOf(seed, Stream::Spots, site.seed);
        for (std::uint32_t i = 0; i < kSpots; ++i)
            patch.spots[i] = spotOf(obstacles, *rock, patch, i, hashOf(own, i));
        turf.patches.push_back(patch);
        turf.fill.push_back(
            static_cast<std::uint16_t>(Turf::kFull / 2 + hashOf(own, kSpots) % (Turf::kFull / 2)));
    }
    return turf;
}

void growTurf(Turf& turf) {
    for (std::uint16_t& fill : turf.fill)
        if (fill < Turf::kFull) ++fill;
}

bool biteTurf(Turf& turf, std::uint32_t patch) {
    assert(patch < turf.fill.size());
    if (turf.fill[patch] < Turf::kOfABite) return false;
    turf.fill[patch] = static_cast<std::uint16_t>(turf.fill[patch] - Turf::kOfABite);
    return true;
}

}  // namespace aquarama::surroundings
