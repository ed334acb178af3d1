// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/neighbours.h"

#include <cassert>

#include "common/place/place.h"

namespace aquarama::behaviour {

void Neighbours::insert(std::uint32_t other, float squared) {
    const auto isNearer = [&](std::size_t place) {
        return squared < distanceSquared[place] ||
               (squared == distanceSquared[place] && other < fish[place]);
    };
    if (count == kMostNeighbours && !isNearer(kMostNeighbours - 1)) return;
    if (count < kMostNeighbours) ++count;
    std::size_t place = count - 1;
    for (; place > 0 && isNearer(place - 1); --place) {
        fish[place] = fish[place - 1];
        distanceSquared[place] = distanceSquared[place - 1];
    }
    fish[place] = other;
    distanceSquared[place] = squared;
}

bool inFieldOfView(glm::vec3 heading, glm::vec3 offset) {
    // Visible: ahead, or at an angle to straight behind whose squared cosine is small enough.
    const float ahead = place::dot(heading, offset);
    return ahead >= 0 || ahead * ahead <= kBlindCosineSquared * place::dot(offset, offset);
}

NearestFish nearestVisibleReference(const fish::FishView& view,
                                    const SpatialGrid& grid,
                                    const fish::SpeciesParameters& parameters,
                                    std::uint32_t fish) {
    assert(fish < view.size());
    NearestFish nearest;
    const glm::vec3 position = view.position(fish);
    const glm::vec3 heading = view.heading(fish);
    constexpr float kReachSquared = kSightMetres * kSightMetres;
    grid.visitAround(position, kReachSquared, [&](const SpatialGrid::Candidates& row) {
        for (std::size_t i = 0; i < row.index.size(); ++i) {
            const std::uint32_t other = row.index[i];
            const glm::vec3 offset = glm::vec3{row.x[i], row.y[i], row.z[i]} - position;
            const float squared = place::dot(offset, offset);
            if (squared > kReachSquared || other == fish || !inFieldOfView(heading, offset))
                continue;
            const bool mate = other >= parameters.first && other < parameters.last;
            (mate ? nearest.schoolmates : nearest.others).insert(other, squared);
        }
    });
    return nearest;
}

}  // namespace aquarama::behaviour
