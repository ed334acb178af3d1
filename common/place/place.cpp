// SPDX-License-Identifier: Apache-2.0
#include "common/place/place.h"

#include <array>

#include "common/place/noise.h"

namespace aquarama {

namespace {

// Streams of one seed, so that adding a rock never moves the sand.
enum Stream : std::uint32_t { kDunes = 1, kHummocks, kRocks, kKelp, kMeadow };

// The composition: what stands where is planned for the wall's 120 degrees (left third, middle,
// right third); a seed only moves it a little.
struct RockGroup {
    glm::vec2 xz;
    float radiusMetres;
    int satellites;
};
constexpr std::array kRockGroups{
    RockGroup{{-6.6F, -5.4F}, 1.75F, 3},
    RockGroup{{-10.5F, -9.5F}, 2.3F, 2},
    RockGroup{{1.6F, -11.2F}, 1.35F, 3},
    RockGroup{{6.3F, -6.9F}, 1.35F, 2},
    RockGroup{{-4.0F, -17.0F}, 2.6F, 2},
    RockGroup{{12.0F, -15.0F}, 2.8F, 2},
    RockGroup{{-17.0F, -20.0F}, 3.6F, 1},
    RockGroup{{4.5F, -25.0F}, 3.2F, 2},
    RockGroup{{-2.1F, -6.6F}, 0.42F, 2},
};

struct Stand {
    glm::vec2 xz;
    float radiusMetres;
    int plants;
    float heightMetres;
};
constexpr std::array kKelpStands{
    Stand{{10.2F, -6.6F}, 2.6F, 22, 7.0F},
    Stand{{14.5F, -10.5F}, 3.2F, 20, 7.4F},
    Stand{{-12.8F, -7.8F}, 2.6F, 14, 6.6F},
    Stand{{-7.5F, -21.0F}, 3.5F, 16, 7.0F},
    Stand{{9.0F, -23.0F}, 3.0F, 12, 7.0F},
};
constexpr std::array kMeadows{
    Stand{{-3.2F, -7.6F}, 1.9F, 70, 0.42F},
    Stand{{3.4F, -6.4F}, 1.5F, 46, 0.36F},
    Stand{{8.2F, -4.6F}, 1.7F, 50, 0.44F},
    Stand{{-9.0F, -3.6F}, 1.8F, 50, 0.44F},
    Stand{{-1.5F, -13.0F}, 3.0F, 90, 0.50F},
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

Rock rockAt(std::uint32_t seed, glm::vec2 xz, float radiusMetres, std::uint32_t rockSeed) {
    constexpr float kSunk = 0.12F;  // of the radius: a boulder lies in the sand, not on it
    return {{xz.x, floorHeight(seed, xz) + kSunk * radiusMetres, xz.y}, radiusMetres, rockSeed};
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
         std::uint32_t placeSeed,
         const Stand& stand,
         const Sowing& sowing) {
    for (int i = 0; i < stand.plants; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const glm::vec2 offset = inDisc(sowing.seed, index);
        const glm::vec2 xz{stand.xz.x + offset.x * stand.radiusMetres,
                           stand.xz.y + offset.y * stand.radiusMetres};
        const glm::vec3 root{xz.x, floorHeight(placeSeed, xz), xz.y};
        if (standsInRock(rocks, root)) continue;
        const std::uint32_t plantSeed = hashOf(sowing.seed ^ 0xa5a5a5a5U, index);
        const float share =
            sowing.leastHeight + (1.0F - sowing.leastHeight) * unitOf(hashOf(plantSeed));
        plants.push_back({sowing.kind, root, stand.heightMetres * share, plantSeed});
    }
}

}  // namespace

float floorHeight(std::uint32_t seed, glm::vec2 xz) {
    // Two scales: long dunes of 14 m and hummocks of 3 m.
    const glm::vec2 dunes{xz.x * 0.07F, xz.y * 0.07F};
    const glm::vec2 hummocks{xz.x * 0.33F, xz.y * 0.33F};
    return -kMeanFloorDepthMetres + 0.22F * fractalNoise(hashOf(seed, kDunes), dunes, 2) +
           0.07F * fractalNoise(hashOf(seed, kHummocks), hummocks, 2);
}

std::vector<Rock> rocksOf(std::uint32_t seed) {
    std::vector<Rock> rocks;
    std::uint32_t next = hashOf(seed, kRocks);
    for (const RockGroup& group : kRockGroups) {
        next = hashOf(next);
        const glm::vec2 shift = inDisc(next, 0);
        const glm::vec2 main{group.xz.x + 0.4F * shift.x, group.xz.y + 0.4F * shift.y};
        const float radius = group.radiusMetres * (0.92F + 0.16F * unitOf(hashOf(next, 1)));
        rocks.push_back(rockAt(seed, main, radius, next));
        for (int i = 0; i < group.satellites; ++i) {
            next = hashOf(next);
            const glm::vec2 away = inDisc(next, 0);
            const glm::vec2 xz{main.x + away.x * radius * 1.6F, main.y + away.y * radius * 1.6F};
            const float share = 0.28F + 0.3F * unitOf(hashOf(next, 1));
            rocks.push_back(rockAt(seed, xz, radius * share, next));
        }
    }
    return rocks;
}

std::vector<Plant> plantsOf(std::uint32_t seed) {
    const std::vector<Rock> rocks = rocksOf(seed);
    std::vector<Plant> plants;
    std::uint32_t stand = 0;
    for (const Stand& kelp : kKelpStands)
        sow(plants,
            rocks,
            seed,
            kelp,
            {PlantKind::Kelp, hashOf(hashOf(seed, kKelp), stand++), 0.55F});
    for (const Stand& meadow : kMeadows)
        sow(plants,
            rocks,
            seed,
            meadow,
            {PlantKind::Seagrass, hashOf(hashOf(seed, kMeadow), stand++), 0.45F});
    return plants;
}

Region schoolRegion() {
    return {glm::vec3{0.0F, -5.8F, -5.5F}, glm::vec3{5.0F, 1.8F, 3.5F}};
}

}  // namespace aquarama
