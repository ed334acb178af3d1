// SPDX-License-Identifier: Apache-2.0
#include "common/place/place.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "common/base/hash.h"
#include "common/base/log.h"
#include "common/base/random_streams.h"
#include "common/place/reefs.h"

namespace aquarama::place {

namespace {

constexpr float kFarthestCell = 1.0e6F;  // keeps the conversion to integers defined for any input

// Rounds down; a cast alone rounds towards zero.
int cellOf(float x) {
    const int towardsZero = static_cast<int>(x);
    return x < static_cast<float>(towardsZero) ? towardsZero - 1 : towardsZero;
}

// The quintic of Perlin 2002: first and second derivative are 0 at both ends.
float smooth(float t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

// The random value of a lattice point, -1 to 1.
float lattice(std::uint32_t seed, int x, int y) {
    const std::uint32_t column = hashOf(seed, static_cast<std::uint32_t>(x));
    return signedUnitOf(hashOf(column, static_cast<std::uint32_t>(y)));
}

// glm::mix with a fixed order of operations.
float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

// Each kind of thing draws from a random stream of its own, so that adding a rock never moves the
// sand. The composition is planned for the wall's 120 degrees, with low rocks in front, high reefs
// at both sides and a gap between them into the blue; a seed only moves it a little. Positions are
// (x, z) in metres.
struct RockGroup {
    glm::vec2 xz;
    float radiusMetres;
    int satellites;
    // How many boulders are piled on the first.
    int storeys = 0;
};
constexpr std::array kRockGroups{
    // Left: a reef that climbs from the corner of the wall to near the surface.
    RockGroup{{-4.6F, -3.5F}, 1.05F, 4},
    RockGroup{{-7.3F, -6.2F}, 2.35F, 5},
    RockGroup{{-11.6F, -9.6F}, 2.9F, 3, 3},
    // Middle: low heads on open sand, the great head behind the fishes' water, a ridge far behind.
    RockGroup{{-1.4F, -6.5F}, 0.60F, 4},
    RockGroup{{1.9F, -11.4F}, 1.45F, 4, 1},
    RockGroup{{-5.0F, -16.5F}, 1.9F, 3, 1},
    RockGroup{{4.2F, -23.5F}, 3.2F, 3, 2},
    // Right: a head before the kelp, a reef behind it.
    RockGroup{{4.7F, -4.1F}, 0.95F, 4},
    RockGroup{{7.2F, -7.6F}, 1.75F, 4},
    RockGroup{{10.2F, -6.0F}, 1.9F, 4, 2},
    RockGroup{{14.4F, -11.0F}, 2.9F, 4, 3},
    RockGroup{{16.5F, -8.0F}, 2.6F, 3, 2},
    // More rocks of the left and of the middle.
    RockGroup{{-9.6F, -7.7F}, 2.2F, 3, 3},
    RockGroup{{-9.2F, -12.6F}, 1.5F, 4, 1},
    RockGroup{{-14.6F, -7.0F}, 2.6F, 3, 2},
    RockGroup{{0.7F, -12.8F}, 1.05F, 2},
    RockGroup{{0.2F, -28.0F}, 3.4F, 3, 1},
    // Far reefs, of which only the outline shows in the blue.
    RockGroup{{-19.0F, -15.0F}, 3.8F, 3, 3},
    RockGroup{{-14.5F, -23.0F}, 3.4F, 2, 3},
    RockGroup{{13.0F, -25.0F}, 3.8F, 3, 3},
    RockGroup{{20.5F, -17.5F}, 3.9F, 2, 3},
    RockGroup{{-24.0F, -6.0F}, 3.6F, 3, 2},
    RockGroup{{25.0F, -5.0F}, 3.6F, 3, 2},
};

// An arch beyond the great head; each stone with its place and height above the sand.
struct ArchStone {
    glm::vec2 offset;
    float heightMetres;
    float radiusMetres;
};
constexpr glm::vec2 kArch{8.4F, -16.2F};
constexpr std::array kArchStones{
    ArchStone{{-3.6F, 0.5F}, 0.25F, 1.45F},
    ArchStone{{-3.4F, 0.3F}, 1.5F, 1.15F},
    ArchStone{{-2.8F, 0.1F}, 2.6F, 1.05F},
    ArchStone{{-1.7F, 0.0F}, 3.50F, 0.95F},
    ArchStone{{-0.5F, -0.1F}, 3.95F, 0.90F},
    ArchStone{{0.7F, -0.1F}, 4.05F, 0.90F},
    ArchStone{{1.9F, -0.2F}, 3.65F, 1.00F},
    ArchStone{{2.9F, -0.3F}, 2.7F, 1.15F},
    ArchStone{{3.4F, -0.5F}, 1.4F, 1.4F},
    ArchStone{{3.9F, -0.6F}, 0.2F, 1.9F},
    ArchStone{{-4.7F, 0.9F}, 0.1F, 0.9F},
};

// How much deeper the sand is at the end of the slope of dropAt().
constexpr float kDropMetres = 10.0F;

// Beside and behind the eye the seed places the reefs, in a ring with room to pass between them.
constexpr int kRingGroups = 22;
constexpr float kRingInnerMetres = 7.5F;
constexpr float kRingOuterMetres = 30.0F;

// A stand of plants: its disc, how many plants are sown, and the height of the highest.
struct Stand {
    glm::vec2 xz;
    float radiusMetres;
    int plants;
    float heightMetres;
};
constexpr std::array kKelpStands{
    Stand{{8.2F, -11.4F}, 1.7F, 22, 7.0F},
    Stand{{11.6F, -14.2F}, 2.4F, 28, 7.3F},
    Stand{{18.5F, -12.0F}, 3.0F, 20, 7.2F},
    Stand{{-18.5F, -9.5F}, 2.2F, 12, 6.9F},
    Stand{{10.0F, 9.0F}, 3.2F, 26, 7.2F},
    Stand{{-6.0F, 15.0F}, 3.0F, 18, 7.0F},
};
constexpr std::array kMeadows{
    Stand{{-3.4F, -8.4F}, 1.8F, 110, 0.42F},
    Stand{{3.6F, -7.0F}, 1.5F, 90, 0.36F},
    Stand{{2.3F, -5.2F}, 0.9F, 40, 0.30F},
    Stand{{-6.2F, -3.2F}, 1.2F, 50, 0.40F},
    Stand{{-1.8F, -14.0F}, 3.0F, 140, 0.46F},
    Stand{{6.0F, -11.5F}, 2.2F, 90, 0.44F},
    Stand{{4.0F, 6.0F}, 3.0F, 150, 0.42F},
    Stand{{-7.0F, 7.0F}, 3.4F, 150, 0.44F},
};

// An evenly distributed point of the unit disc by rejection: no square root, no angle. Different
// indices of a seed are independent.
glm::vec2 inDisc(std::uint32_t seed, std::uint32_t index) {
    constexpr std::uint32_t kTries = 16;
    for (std::uint32_t attempt = 0; attempt < kTries; ++attempt) {
        const std::uint32_t hash = hashOf(seed, index * kTries + attempt);
        const glm::vec2 point{signedUnitOf(hash), signedUnitOf(hashOf(hash))};
        if (point.x * point.x + point.y * point.y <= 1.0F) return point;
    }
    // All tries miss once in 10^11 calls.
    return glm::vec2{0.0F};
}

// How much lower the sand is on a slope between the two reefs, ahead and to the left, where it
// falls away into the blue. 0 around the fish's water.
float dropAt(glm::vec2 xz) {
    constexpr glm::vec2 kTowards{-0.5F, -0.8660254F};
    constexpr float kBeginsMetres = 14.0F;
    constexpr float kOverMetres = 22.0F;
    const float along = (xz.x * kTowards.x + xz.y * kTowards.y - kBeginsMetres) / kOverMetres;
    const float share = along < 0.0F ? 0.0F : along > 1.0F ? 1.0F : along;
    return kDropMetres * share * share * (3.0F - 2.0F * share);
}

// A boulder on the sand.
Rock rockAt(const PlaceKey& place, glm::vec2 xz, float radiusMetres, std::uint32_t rockSeed) {
    constexpr float kSunk = 0.12F;  // of the radius: a boulder lies in the sand, not on it
    return {{xz.x, floorHeight(place, xz) + kSunk * radiusMetres, xz.y}, radiusMetres, rockSeed};
}

// A reef that climbs: each boulder sits on the one below, a little to one side; a smaller one on
// the other side supports it. Stops below the surface.
void pile(std::vector<Rock>& rocks, const RockGroup& group, Rock below, std::uint32_t seed) {
    constexpr float kHighestMetres = -1.2F;  // the sea wears off what comes near its surface
    for (int storey = 0; storey < group.storeys; ++storey) {
        const std::uint32_t next = hashOf(seed, 100 + static_cast<std::uint32_t>(storey));
        const glm::vec2 aside = inDisc(next, 0);
        const float radius = below.radiusMetres * (0.74F + 0.20F * unitOf(hashOf(next, 1)));
        const Rock buttress{below.centre + glm::vec3{-1.1F * radius * aside.x,
                                                     0.10F * below.radiusMetres,
                                                     -1.1F * radius * aside.y},
                            0.8F * radius,
                            hashOf(next, 2)};
        below.centre += glm::vec3{0.6F * radius * aside.x,
                                  0.50F * below.radiusMetres + 0.20F * radius,
                                  0.6F * radius * aside.y};
        if (below.centre.y + radius > kHighestMetres) return;
        below.radiusMetres = radius;
        below.seed = next;
        rocks.push_back(below);
        rocks.push_back(buttress);
    }
}

// A main boulder near the planned place, its pile, and satellites within 1.5 radii. next: the state
// of a chain of random numbers that runs through all groups.
void addGroup(std::vector<Rock>& rocks,
              const PlaceKey& place,
              const RockGroup& group,
              std::uint32_t& next) {
    next = hashOf(next);
    const glm::vec2 shift = inDisc(next, 0);
    const glm::vec2 main{group.xz.x + 0.3F * shift.x, group.xz.y + 0.3F * shift.y};
    const float radius = group.radiusMetres * (0.92F + 0.16F * unitOf(hashOf(next, 1)));
    rocks.push_back(rockAt(place, main, radius, next));
    pile(rocks, group, rocks.back(), next);
    for (int i = 0; i < group.satellites; ++i) {
        next = hashOf(next);
        const glm::vec2 away = inDisc(next, 0);
        const glm::vec2 xz{main.x + away.x * radius * 1.5F, main.y + away.y * radius * 1.5F};
        const float share = 0.25F + 0.4F * unitOf(hashOf(next, 1));
        rocks.push_back(rockAt(place, xz, radius * share, next));
    }
}

void addArch(std::vector<Rock>& rocks, const PlaceKey& place) {
    const float sand = floorHeight(place, kArch);
    for (std::uint32_t i = 0; i < kArchStones.size(); ++i) {
        const ArchStone& stone = kArchStones[i];
        const std::uint32_t seed = hashOf(hashOf(place.seed, Stream::Arch), i);
        rocks.push_back(
            {{kArch.x + stone.offset.x, sand + stone.heightMetres, kArch.y + stone.offset.y},
             stone.radiusMetres,
             seed});
    }
}

// Whether a group of the ring may stand at xz: neither within the planned view nor near the eye,
// and at a distance from all rocks so far.
bool isFree(const std::vector<Rock>& rocks, glm::vec2 xz, float radius) {
    const float range2 = xz.x * xz.x + xz.y * xz.y;
    const float least = kRingInnerMetres + radius;
    const float sideways = xz.x < 0.0F ? -xz.x : xz.x;
    if (range2 < least * least || xz.y < 2.0F - 0.25F * sideways) return false;
    for (const Rock& rock : rocks) {
        const float dx = rock.centre.x - xz.x;
        const float dz = rock.centre.z - xz.y;
        const float gap = rock.radiusMetres + radius + 1.2F;
        if (dx * dx + dz * dz < gap * gap) return false;
    }
    return true;
}

// Tries random places in the ring until enough groups stand, or the tries are used up.
void addRing(std::vector<Rock>& rocks, const PlaceKey& place) {
    std::uint32_t next = hashOf(place.seed, Stream::Ring);
    constexpr std::uint32_t kTries = 220;
    int groups = 0;
    for (std::uint32_t attempt = 0; attempt < kTries && groups < kRingGroups; ++attempt) {
        const glm::vec2 spot = inDisc(hashOf(place.seed, Stream::Ring), attempt);
        const glm::vec2 xz{spot.x * kRingOuterMetres, spot.y * kRingOuterMetres};
        const float share = unitOf(hashOf(hashOf(place.seed, Stream::Ring), 5000 + attempt));
        const float radius = 0.9F + 2.4F * share;
        if (!isFree(rocks, xz, radius)) continue;
        addGroup(rocks,
                 place,
                 {xz, radius, 3, share > 0.3F ? 1 + static_cast<int>(share * 3.0F) : 0},
                 next);
        ++groups;
    }
}

// A pile with a crown at the wanted height above the sand, and small boulders about its foot.
void addHead(std::vector<Rock>& rocks, const PlaceKey& place, std::uint32_t index) {
    constexpr float kNearCrownMetres = 0.05F;  // of the wanted height: near enough
    constexpr std::uint32_t kSatellites = 4;
    const config::Head& head = place.heads[index];
    const std::uint32_t seed = hashOf(hashOf(place.seed, Stream::Heads), index);
    const float crown = floorHeight(place, head.xz) + head.heightMetres;
    Rock top = rockAt(place, head.xz, std::min(head.radiusMetres, head.heightMetres), seed);
    rocks.push_back(top);
    for (std::uint32_t storey = 0; top.centre.y + top.radiusMetres < crown - kNearCrownMetres;
         ++storey) {
        const std::uint32_t next = hashOf(seed, 100 + storey);
        const glm::vec2 aside = inDisc(next, 0);
        const float radius = top.radiusMetres * (0.74F + 0.20F * unitOf(hashOf(next, 1)));
        top.centre += glm::vec3{0.5F * radius * aside.x,
                                0.50F * top.radiusMetres + 0.20F * radius,
                                0.5F * radius * aside.y};
        top.centre.y = std::min(top.centre.y, crown - radius);
        top.radiusMetres = radius;
        top.seed = next;
        rocks.push_back(top);
    }
    for (std::uint32_t i = 0; i < kSatellites; ++i) {
        const std::uint32_t next = hashOf(seed, 200 + i);
        const glm::vec2 away = inDisc(next, 0);
        const float share = 0.25F + 0.3F * unitOf(hashOf(next, 1));
        rocks.push_back(rockAt(
            place, head.xz + away * (1.5F * head.radiusMetres), head.radiusMetres * share, next));
    }
}

// Cost: all rocks for each plant.
bool standsInRock(const std::vector<Rock>& rocks, glm::vec3 root) {
    for (const Rock& rock : rocks) {
        const float dx = root.x - rock.centre.x;
        const float dz = root.z - rock.centre.z;
        const float clear = rock.radiusMetres * 0.95F;
        if (dx * dx + dz * dz < clear * clear) return true;
    }
    return false;
}

// One kind of plant that is sown, with its seed and its least height as a share of the stand's.
struct Sowing {
    PlantKind kind;
    std::uint32_t seed;
    float leastHeight;
};

// Plants that would stand in a rock are left out; this does not move the others.
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

// Beyond this there is only bare sand.
constexpr double kReefHalfWidthMetres = 30;
// The lowest water of the open sea: 5 m above its floor.
constexpr double kSeaBottomMetres = -55;
// Allowance for the dunes of the reef, above its mean floor.
constexpr float kFloorBumpsMetres = 0.6F;
// Limits of the submarine: margin around water and eye; the highest place of its middle; the height
// of a stop above the floor, for the hull and its safe distance.
constexpr float kRoamMetres = 4;
constexpr float kHighestHullMetres = -0.75F;
constexpr float kLowestStopMetres = 0.8F;

// Cubic metres of the scene's own box.
double volumeOf(const config::SceneWater& water) {
    const glm::dvec3 half = water.halfExtent;
    return 8 * half.x * half.y * half.z;
}

// Cubic metres that a fish needs.
double roomOf(const config::Scene& scene, double meanLengthMetres) {
    return scene.water.leastLengthsCubed * meanLengthMetres * meanLengthMetres * meanLengthMetres;
}

float floorOf(const config::Scene& scene) {
    return scene.place == config::PlaceKind::Reef ? -kMeanFloorDepthMetres + kFloorBumpsMetres
                                                  : -kOpenSeaFloorDepthMetres;
}

// Why the submarine cannot go to a stop; empty where it can.
std::string wrongWith(const config::Scene& scene,
                      const Region& roaming,
                      const config::TourStop& stop) {
    const glm::vec3 from = stop.at - roaming.centre;
    const glm::vec3 half = roaming.halfExtent;
    if (std::abs(from.x) > half.x || std::abs(from.y) > half.y || std::abs(from.z) > half.z)
        return "the stop is out of where the submarine may go, 4 m about the water and the eye: "
               "move it in";
    if (stop.at.y <= floorOf(scene) + kLowestStopMetres)
        return "the stop is too near to the sand: raise it";
    return {};
}

// The factors by which the box grows: sideways and away from the eye, and downwards.
struct Growth {
    double wider = 1, deeper = 1;
};

// more: the factor of the volume. In the open sea the depth grows as its eighth root only, down to
// kSeaBottomMetres: the sea is shallow against its breadth.
Growth growthFor(const config::Scene& scene, double more) {
    if (more <= 1) return {};
    if (scene.place == config::PlaceKind::Reef) return {std::sqrt(more), 1};
    const double top = static_cast<double>(scene.water.centre.y + scene.water.halfExtent.y);
    const double most =
        (top - kSeaBottomMetres) / 2 / static_cast<double>(scene.water.halfExtent.y);
    const double deeper =
        std::clamp(std::sqrt(std::sqrt(std::sqrt(more))), 1.0, std::max(most, 1.0));
    return {std::sqrt(more / deeper), deeper};
}

}  // namespace

float valueNoise(std::uint32_t seed, glm::vec2 place) {
    const float x = std::clamp(place.x, -kFarthestCell, kFarthestCell);
    const float y = std::clamp(place.y, -kFarthestCell, kFarthestCell);
    const int cellX = cellOf(x);
    const int cellY = cellOf(y);
    const float u = smooth(x - static_cast<float>(cellX));
    const float v = smooth(y - static_cast<float>(cellY));
    const float near = mixed(lattice(seed, cellX, cellY), lattice(seed, cellX + 1, cellY), u);
    const float far =
        mixed(lattice(seed, cellX, cellY + 1), lattice(seed, cellX + 1, cellY + 1), u);
    return mixed(near, far, v);
}

float fractalNoise(std::uint32_t seed, glm::vec2 place, int octaves) {
    assert(octaves >= 1);
    float sum = 0.0F;
    float height = 1.0F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * valueNoise(hashOf(seed, static_cast<std::uint32_t>(octave)), place);
        // The lattices of two octaves must not meet at the origin: all would be flat there.
        place = glm::vec2{place.x * 2.0F + 17.31F, place.y * 2.0F - 9.73F};
        height *= 0.5F;
    }
    return sum;
}

float floorHeight(const PlaceKey& place, glm::vec2 xz) {
    if (place.kind == config::PlaceKind::OpenSea) return -kOpenSeaFloorDepthMetres;
    xz = inFirstReef(place, xz);
    // Two scales: long dunes of 14 m and hummocks of 3 m.
    const glm::vec2 dunes{xz.x * 0.07F, xz.y * 0.07F};
    const glm::vec2 hummocks{xz.x * 0.33F, xz.y * 0.33F};
    return -kMeanFloorDepthMetres +
           0.22F * fractalNoise(hashOf(place.seed, Stream::Dunes), dunes, 2) +
           0.07F * fractalNoise(hashOf(place.seed, Stream::Hummocks), hummocks, 2) - dropAt(xz);
}

std::vector<Rock> rocksOf(const PlaceKey& place) {
    std::vector<Rock> rocks;
    if (place.kind == config::PlaceKind::OpenSea) return rocks;
    std::uint32_t next = hashOf(place.seed, Stream::Rocks);
    for (const RockGroup& group : kRockGroups) addGroup(rocks, place, group, next);
    addArch(rocks, place);
    addRing(rocks, place);
    for (std::uint32_t i = 0; i < place.heads.size(); ++i) addHead(rocks, place, i);
    return inAllReefs(place, rocks);
}

PlaceKey placeOf(const config::Scene& scene, std::uint32_t seed) {
    return {seed,
            scene.place,
            scene.heads,
            scene.sites,
            {scene.water.centre, scene.water.halfExtent},
            scene.reefs};
}

std::vector<Plant> plantsOf(const PlaceKey& place) {
    std::vector<Plant> plants;
    if (place.kind == config::PlaceKind::OpenSea) return plants;
    const std::vector<Rock> rocks = rocksOf(place);
    std::uint32_t stand = 0;
    for (const Stand& kelp : kKelpStands)
        sow(plants,
            rocks,
            place,
            kelp,
            {PlantKind::Kelp, hashOf(hashOf(place.seed, Stream::Kelp), stand++), 0.55F});
    for (const Stand& meadow : kMeadows)
        sow(plants,
            rocks,
            place,
            meadow,
            {PlantKind::Seagrass, hashOf(hashOf(place.seed, Stream::Meadow), stand++), 0.45F});
    return plants;
}

// --- how much water a scene gives

Region waterFor(const config::Scene& scene, std::size_t fish, float meanLengthMetres) {
    assert(meanLengthMetres >= 0);
    const config::SceneWater& box = scene.water;
    const double wanted =
        static_cast<double>(fish) * roomOf(scene, static_cast<double>(meanLengthMetres));
    const Growth growth = growthFor(scene, wanted / volumeOf(box));
    const auto wider = static_cast<float>(growth.wider);
    const auto deeper = static_cast<float>(growth.deeper);
    const glm::vec3 half = box.halfExtent * glm::vec3{wider, deeper, wider};
    const glm::vec3 grown = half - box.halfExtent;
    return {box.centre - glm::vec3{0, grown.y, grown.z}, half};
}

Region roamingRegion(const Region& fishWater, glm::vec3 eye) {
    assert(fishWater.halfExtent.x >= 0);
    assert(fishWater.halfExtent.y >= 0);
    assert(fishWater.halfExtent.z >= 0);
    const glm::vec3 roam{kRoamMetres};
    const glm::vec3 least = glm::min(fishWater.centre - fishWater.halfExtent, eye) - roam;
    glm::vec3 most = glm::max(fishWater.centre + fishWater.halfExtent, eye) + roam;
    most.y = std::min(most.y, kHighestHullMetres);
    return {(least + most) * 0.5F, (most - least) * 0.5F};
}

std::uint32_t mostFishIn(const config::Scene& scene, float meanLengthMetres) {
    assert(meanLengthMetres > 0);
    if (scene.place == config::PlaceKind::OpenSea) return kMostFish;
    const double wider =
        std::max(1.0, kReefHalfWidthMetres / static_cast<double>(scene.water.halfExtent.x));
    const double fish = volumeOf(scene.water) * wider * wider /
                        roomOf(scene, static_cast<double>(meanLengthMetres));
    return static_cast<std::uint32_t>(std::min(fish, static_cast<double>(kMostFish)));
}

void checkRoom(const config::Scene& scene,
               const std::string& scenePath,
               std::size_t fish,
               float meanLengthMetres) {
    assert(!scene.cast.empty());
    const config::SourcePlace place = scene.cast.front().place;
    const std::uint32_t most = mostFishIn(scene, meanLengthMetres);
    if (fish > most)
        throw Error(config::placed(scenePath,
                                   place,
                                   std::to_string(fish) + " fish: there is room for " +
                                       std::to_string(most) +
                                       (scene.place == config::PlaceKind::Reef
                                            ? " about this reef; take fewer, or an OPEN_SEA"
                                            : " in all; take fewer")));
    if (scene.eye.y <= floorOf(scene))
        throw Error(config::placed(scenePath, scene.eyePlace, "the eye is in the sand: raise it"));
    if (scene.water.centre.y - scene.water.halfExtent.y <= floorOf(scene) - 2 * kFloorBumpsMetres)
        throw Error(config::placed(
            scenePath, scene.waterPlace, "the water reaches into the sand: raise it"));
    if (!scene.tour) return;
    const Region roaming = roamingRegion({scene.water.centre, scene.water.halfExtent}, scene.eye);
    for (const config::TourStop& stop : scene.tour->stops) {
        const std::string wrong = wrongWith(scene, roaming, stop);
        if (!wrong.empty()) throw Error(config::placed(scenePath, stop.place, wrong));
    }
}

}  // namespace aquarama::place
