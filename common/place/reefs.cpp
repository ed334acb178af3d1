// SPDX-License-Identifier: Apache-2.0
#include "common/place/reefs.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/hash.h"

namespace aquarama::place {

namespace {

// The settled water of the first reef: of all, the leftmost and the foremost part.
Region firstWater(const PlaceKey& place) {
    const glm::vec3 all = place.settled.halfExtent;
    const glm::vec3 one{all.x / static_cast<float>(place.reefs.x),
                        all.y,
                        all.z / static_cast<float>(place.reefs.y)};
    return {place.settled.centre + glm::vec3{one.x - all.x, 0, all.z - one.z}, one};
}

// The seed of a rock in another reef than the first; it names the rock.
std::uint32_t seedIn(std::size_t reef, std::uint32_t rockSeed) {
    return reef == 0 ? rockSeed : hashOf(rockSeed, static_cast<std::uint32_t>(reef));
}

}  // namespace

std::size_t reefsOf(const PlaceKey& place) {
    return std::size_t{place.reefs.x} * place.reefs.y;
}

glm::vec3 reefOffset(const PlaceKey& place, std::size_t reef) {
    assert(reef < reefsOf(place));
    const glm::vec3 one = firstWater(place).halfExtent;
    return {2 * one.x * static_cast<float>(reef % place.reefs.x),
            0,
            -2 * one.z * static_cast<float>(reef / place.reefs.x)};
}

PlaceKey firstReefOf(const PlaceKey& place) {
    PlaceKey first = place;
    first.settled = firstWater(place);
    first.reefs = {1, 1};
    return first;
}

glm::vec2 inFirstReef(const PlaceKey& place, glm::vec2 xz) {
    if (reefsOf(place) == 1) return xz;
    const Region first = firstWater(place);
    const auto beyond = [](float from, float half, std::uint32_t reefs) {
        const auto last = static_cast<float>(reefs - 1);
        return 2 * half * std::clamp(std::floor((from + half) / (2 * half)), 0.0F, last);
    };
    return {xz.x - beyond(xz.x - first.centre.x, first.halfExtent.x, place.reefs.x),
            xz.y + beyond(first.centre.z - xz.y, first.halfExtent.z, place.reefs.y)};
}

bool reachesInto(const Region& region, const Rock& rock) {
    const glm::vec3 from = rock.centre - region.centre;
    const glm::vec3 reach = region.halfExtent + glm::vec3{0.5F * rock.radiusMetres};
    return std::abs(from.x) < reach.x && std::abs(from.z) < reach.z;
}

std::vector<Rock> inAllReefs(const PlaceKey& place, const std::vector<Rock>& rocks) {
    if (reefsOf(place) == 1) return rocks;
    const Region first = firstWater(place);
    std::vector<Rock> all;
    for (std::size_t reef = 0; reef < reefsOf(place); ++reef)
        for (const Rock& rock : rocks)
            if (reachesInto(first, rock))
                all.push_back({rock.centre + reefOffset(place, reef),
                               rock.radiusMetres,
                               seedIn(reef, rock.seed)});
    return all;
}

std::vector<Site> inAllReefs(const PlaceKey& place, const std::vector<Site>& sites) {
    std::vector<Site> all;
    for (const Site& site : sites)
        for (std::size_t reef = 0; reef < reefsOf(place); ++reef) {
            all.push_back(site);
            all.back().place += reefOffset(place, reef);
            all.back().seed = seedIn(reef, site.seed);
            all.back().rockSeed = seedIn(reef, site.rockSeed);
        }
    return all;
}

}  // namespace aquarama::place
