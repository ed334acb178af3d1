// SPDX-License-Identifier: Apache-2.0
#include "common/place/water.h"

#include <algorithm>
#include <cmath>

#include "common/units/error.h"

namespace aquarama {

namespace {

constexpr double kReefHalfWidthMetres = 30;  // beyond, there is but bare sand
constexpr double kSeaBottomMetres = -55;     // above the floor of the open sea by a margin
constexpr float kFloorBumpsMetres = 0.6F;    // of the reef's sand

double volumeOf(const SceneWater& water) {
    const glm::dvec3 half = water.halfExtent;
    return 8 * half.x * half.y * half.z;
}

double roomOf(const Scene& scene, double meanLengthMetres) {
    return scene.water.leastLengthsCubed * meanLengthMetres * meanLengthMetres * meanLengthMetres;
}

float floorOf(const Scene& scene) {
    return scene.place == PlaceKind::Reef ? -kMeanFloorDepthMetres + kFloorBumpsMetres
                                          : -kOpenSeaFloorDepthMetres;
}

// What the box grows by, as factors: sideways and away, and downwards.
struct Growth {
    double wider = 1, deeper = 1;
};

// In the open sea depth grows only as the fourth root of length and breadth: the sea is shallow.
Growth growthFor(const Scene& scene, double more) {
    if (more <= 1) return {};
    if (scene.place == PlaceKind::Reef) return {std::sqrt(more), 1};
    const double top = static_cast<double>(scene.water.centre.y + scene.water.halfExtent.y);
    const double most =
        (top - kSeaBottomMetres) / 2 / static_cast<double>(scene.water.halfExtent.y);
    const double deeper =
        std::clamp(std::sqrt(std::sqrt(std::sqrt(more))), 1.0, std::max(most, 1.0));
    return {std::sqrt(more / deeper), deeper};
}

}  // namespace

Region waterFor(const Scene& scene, std::size_t fish, float meanLengthMetres) {
    const SceneWater& box = scene.water;
    const double wanted =
        static_cast<double>(fish) * roomOf(scene, static_cast<double>(meanLengthMetres));
    const Growth growth = growthFor(scene, wanted / volumeOf(box));
    const auto wider = static_cast<float>(growth.wider);
    const auto deeper = static_cast<float>(growth.deeper);
    const glm::vec3 half = box.halfExtent * glm::vec3{wider, deeper, wider};
    const glm::vec3 grown = half - box.halfExtent;
    return {box.centre - glm::vec3{0, grown.y, grown.z}, half};
}

std::uint32_t mostFishIn(const Scene& scene, float meanLengthMetres) {
    if (scene.place == PlaceKind::OpenSea) return kMostFish;
    const double wider =
        std::max(1.0, kReefHalfWidthMetres / static_cast<double>(scene.water.halfExtent.x));
    const double fish = volumeOf(scene.water) * wider * wider /
                        roomOf(scene, static_cast<double>(meanLengthMetres));
    return static_cast<std::uint32_t>(std::min(fish, static_cast<double>(kMostFish)));
}

void checkRoom(const Scene& scene,
               const std::string& scenePath,
               std::size_t fish,
               float meanLengthMetres) {
    const SourcePlace place = scene.cast.front().place;
    const std::uint32_t most = mostFishIn(scene, meanLengthMetres);
    if (fish > most)
        throw Error(placed(
            scenePath,
            place,
            std::to_string(fish) + " fish: there is room for " + std::to_string(most) +
                (scene.place == PlaceKind::Reef ? " about this reef; take fewer, or an OPEN_SEA"
                                                : " in all; take fewer")));
    if (scene.eye.y <= floorOf(scene))
        throw Error(placed(scenePath, scene.eyePlace, "the eye is in the sand: raise it"));
    if (scene.water.centre.y - scene.water.halfExtent.y <= floorOf(scene) - 2 * kFloorBumpsMetres)
        throw Error(
            placed(scenePath, scene.waterPlace, "the water reaches into the sand: raise it"));
}

}  // namespace aquarama
