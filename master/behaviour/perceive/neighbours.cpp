// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/neighbours.h"

#include "common/place/angle.h"

namespace aquarama {

namespace {

constexpr float kBlindCosineSquared = 0.75F;  // cos^2 of 30 degrees

// Keeps the nearest, sorted: an insertion among seven.
void insert(Neighbours& nearest, std::uint32_t fish, float distanceSquared) {
    const auto isNearer = [&](std::size_t place) {
        const float other = nearest.distanceSquared[place];
        return distanceSquared < other || (distanceSquared == other && fish < nearest.fish[place]);
    };
    if (nearest.count == kMostNeighbours && !isNearer(kMostNeighbours - 1)) return;
    if (nearest.count < kMostNeighbours) ++nearest.count;
    std::size_t place = nearest.count - 1;
    for (; place > 0 && isNearer(place - 1); --place) {
        nearest.fish[place] = nearest.fish[place - 1];
        nearest.distanceSquared[place] = nearest.distanceSquared[place - 1];
    }
    nearest.fish[place] = fish;
    nearest.distanceSquared[place] = distanceSquared;
}

struct Search {
    glm::vec3 position;
    glm::vec3 heading;
    std::uint32_t fish;
    float reachSquared = kSightMetres * kSightMetres;
    Neighbours nearest{};

    void look(const SpatialGrid::Candidates& candidates) {
        for (std::size_t i = 0; i < candidates.index.size(); ++i) {
            const glm::vec3 offset{candidates.x[i] - position.x,
                                   candidates.y[i] - position.y,
                                   candidates.z[i] - position.z};
            const float distanceSquared = dot(offset, offset);
            if (distanceSquared > reachSquared || candidates.index[i] == fish) continue;
            if (!inFieldOfView(heading, offset)) continue;
            insert(nearest, candidates.index[i], distanceSquared);
            if (nearest.count == kMostNeighbours) reachSquared = nearest.distanceSquared.back();
        }
    }
};

}  // namespace

bool inFieldOfView(glm::vec3 heading, glm::vec3 offset) {
    const float ahead = dot(heading, offset);
    return ahead >= 0 || ahead * ahead <= kBlindCosineSquared * dot(offset, offset);
}

Neighbours nearestVisible(const FishView& view, const SpatialGrid& grid, std::uint32_t fish) {
    Search search{view.position(fish), view.heading(fish), fish};
    grid.visitAround(
        search.position, search.reachSquared, [&](const auto& row) { search.look(row); });
    return search.nearest;
}

}  // namespace aquarama
