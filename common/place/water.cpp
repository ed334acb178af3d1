// SPDX-License-Identifier: Apache-2.0
#include "common/place/water.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "common/base/log.h"

namespace aquarama::place {

namespace {

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

// By which factors the box grows: sideways and away from the eye, and downwards.
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
