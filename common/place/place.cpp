// SPDX-License-Identifier: Apache-2.0
#include "common/place/place.h"

#include <array>

#include "common/place/noise.h"

namespace aquarama {

namespace {

// Streams of one seed, so that adding a rock never moves the sand.
enum Stream : std::uint32_t { Dunes = 1, Hummocks, Rocks, Kelp, Meadow };

// The composition: what stands where is planned for the wall's 120 degrees (left third, middle,
// right third); a seed only moves it a little.
struct RockGroup {
    glm::vec2 xz;
    float radiusMetres;
    int satellites;
};
constexpr std::array kRockGroups{
    // Left: a reef that rises from the corner of the wall.
    RockGroup{{-4.6F, -3.5F}, 1.05F, 4},
    RockGroup{{-7.3F, -6.2F}, 2.35F, 5},
    RockGroup{{-11.6F, -10.2F}, 2.9F, 3},
    // Middle: low heads on open sand, a ridge far behind.
    RockGroup{{-1.4F, -6.5F}, 0.60F, 4},
    RockGroup{{1.9F, -11.4F}, 1.45F, 4},
    RockGroup{{-4.6F, -15.5F}, 2.7F, 3},
    RockGroup{{3.6F, -22.0F}, 3.4F, 3},
    // Right: a head before the kelp, a wall behind it.
    RockGroup{{4.7F, -4.1F}, 0.95F, 4},
    RockGroup{{7.2F, -7.6F}, 1.75F, 4},
    RockGroup{{12.6F, -14.4F}, 3.1F, 3},
    // What is but a shape in the blue.
    RockGroup{{-16.0F, -21.0F}, 4.4F, 2},
    RockGroup{{-7.0F, -31.0F}, 4.8F, 2},
    RockGroup{{14.0F, -29.0F}, 5.0F, 2},
};

struct Stand {
    glm::vec2 xz;
    float radiusMetres;
    int plants;
    float heightMetres;
};
constexpr std::array kKelpStands{
    Stand{{8.6F, -6.6F}, 1.9F, 24, 7.0F},
    Stand{{12.5F, -9.8F}, 3.0F, 26, 7.4F},
    Stand{{-11.2F, -8.2F}, 1.9F, 16, 6.8F},
    Stand{{-8.5F, -21.5F}, 3.2F, 16, 7.0F},
    Stand{{9.5F, -22.0F}, 3.0F, 14, 7.0F},
};
constexpr std::array kMeadows{
    Stand{{-3.4F, -8.4F}, 1.8F, 70, 0.46F},
    Stand{{3.6F, -7.0F}, 1.5F, 50, 0.40F},
    Stand{{2.3F, -5.2F}, 0.9F, 24, 0.34F},
    Stand{{-6.2F, -3.2F}, 1.2F, 34, 0.44F},
    Stand{{-1.5F, -13.5F}, 3.0F, 90, 0.52F},
    Stand{{6.5F, -13.0F}, 2.6F, 60, 0.50F},
};

// A point of the disc by rejection: no square root, no angle, evenly spread.
glm::vec2 inDisc(std::uint32_t seed, std::uint32_t index) {
    constexpr std::uint32_t kTries = 16;
    for (std::uint32_t attempt = 0; attempt < kTries; ++attempt) {
        const std::uint32_t hash = hashOf(seed, index * kTries + attempt);
        const glm::vec2 point{signedUnitOf(hash), signedUnitOf(hashOf(hash))};
        if (point.x * point.x + point.y * point.y <= 1.0F) return point;
    }
    return glm::vec2{0.0F};  // once in 10^11
}

Rock rockAt(const PlaceKey& place, glm::vec2 xz, float radiusMetres, std::uint32_t rockSeed) {
    constexpr float kSunk = 0.12F;  // of the radius: a boulder lies in the sand, not on it
    return {{xz.x, floorHeight(place, xz) + kSunk * radiusMetres, xz.y}, radiusMetres, rockSeed};
}

bool standsInRock(const std::vector<Rock>& rocks, glm::vec3 root) {
    for (const Rock& rock : rocks) {
        const float dx = root.x - rock.centre.x;
        const float dz = root.z - rock.centre.z;
        const float clear = rock.radiusMetres * 0.95F;
        if (dx * dx + dz * dz < clear * clear) return true;
    }
    return false;
}

struct Sowing {
    PlantKind kind;
    std::uint32_t seed;
    float leastHeight;  // of the stand's
};

void sow(std::vector<Plant>& plants,
         const std::vector<Rock>& rocks,
         const PlaceKey& place,
         const Stand& stand,
         const Sowing& sowing) {
    for (int i = 0; i < stand.plants; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const glm::vec2 offset = inDisc(sowing.seed, index);
        const glm::vec2 xz{stand.xz.x + offset.x * stand.radiusMetres,
                           stand.xz.y + offset.y * stand.radiusMetres};
        const glm::vec3 root{xz.x, floorHeight(place, xz), xz.y};
        if (standsInRock(rocks, root)) continue;
        const std::uint32_t plantSeed = hashOf(sowing.seed ^ 0xa5a5a5a5U, index);
        const float share =
            sowing.leastHeight + (1.0F - sowing.leastHeight) * unitOf(hashOf(plantSeed));
        plants.push_back({sowing.kind, root, stand.heightMetres * share, plantSeed});
    }
}

}  // namespace

float floorHeight(const PlaceKey& place, glm::vec2 xz) {
    if (place.kind == PlaceKind::OpenSea) return -kOpenSeaFloorDepthMetres;
    // Two scales: long dunes of 14 m and hummocks of 3 m.
    const glm::vec2 dunes{xz.x * 0.07F, xz.y * 0.07F};
    const glm::vec2 hummocks{xz.x * 0.33F, xz.y * 0.33F};
    return -kMeanFloorDepthMetres + 0.22F * fractalNoise(hashOf(place.seed, Dunes), dunes, 2) +
           0.07F * fractalNoise(hashOf(place.seed, Hummocks), hummocks, 2);
}

std::vector<Rock> rocksOf(const PlaceKey& place) {
    std::vector<Rock> rocks;
    if (place.kind == PlaceKind::OpenSea) return rocks;
    std::uint32_t next = hashOf(place.seed, Rocks);
    for (const RockGroup& group : kRockGroups) {
        next = hashOf(next);
        const glm::vec2 shift = inDisc(next, 0);
        const glm::vec2 main{group.xz.x + 0.3F * shift.x, group.xz.y + 0.3F * shift.y};
        const float radius = group.radiusMetres * (0.92F + 0.16F * unitOf(hashOf(next, 1)));
        rocks.push_back(rockAt(place, main, radius, next));
        for (int i = 0; i < group.satellites; ++i) {
            next = hashOf(next);
            const glm::vec2 away = inDisc(next, 0);
            const glm::vec2 xz{main.x + away.x * radius * 1.5F, main.y + away.y * radius * 1.5F};
            const float share = 0.25F + 0.4F * unitOf(hashOf(next, 1));
            rocks.push_back(rockAt(place, xz, radius * share, next));
        }
    }
    return rocks;
}

std::vector<Plant> plantsOf(const PlaceKey& place) {
    std::vector<Plant> plants;
    if (place.kind == PlaceKind::OpenSea) return plants;
    const std::vector<Rock> rocks = rocksOf(place);
    std::uint32_t stand = 0;
    for (const Stand& kelp : kKelpStands)
        sow(plants,
            rocks,
            place,
            kelp,
            {PlantKind::Kelp, hashOf(hashOf(place.seed, Kelp), stand++), 0.55F});
    for (const Stand& meadow : kMeadows)
        sow(plants,
            rocks,
            place,
            meadow,
            {PlantKind::Seagrass, hashOf(hashOf(place.seed, Meadow), stand++), 0.45F});
    return plants;
}

Region schoolRegion() {
    return {glm::vec3{0.0F, -5.8F, -5.5F}, glm::vec3{5.0F, 1.8F, 3.5F}};
}

}  // namespace aquarama
