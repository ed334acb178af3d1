// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

#include "common/units/error.h"
#include "master/capture/dynamics/biomechanical_fish.h"
#include "master/capture/dynamics/rigidity.h"

namespace aquarama::capture {

namespace {

constexpr int kLastHeadNode = 8;    // of ring 2
constexpr int kFirstTailNode = 13;  // of ring 4
constexpr std::size_t kFirstTip = 21;

NodeVectors restPositionsOf(const config::Skeleton& skeleton) {
    NodeVectors nodes{};
    std::size_t next = 1;
    for (const config::SkeletonRing& ring : skeleton.rings) {
        nodes.at(next++) = {-ring.s, ring.halfHeight, -ring.halfWidth};
        nodes.at(next++) = {-ring.s, ring.halfHeight, ring.halfWidth};
        nodes.at(next++) = {-ring.s, -ring.halfHeight, ring.halfWidth};
        nodes.at(next++) = {-ring.s, -ring.halfHeight, -ring.halfWidth};
    }
    nodes[kFirstTip] = {-1, skeleton.tailHalfSpan, 0};
    nodes[kFirstTip + 1] = {-1, -skeleton.tailHalfSpan, 0};
    return nodes;
}

std::array<double, body::kNodalPoints> massesOf(const config::Skeleton& skeleton) {
    std::array<double, body::kNodalPoints> masses{};
    masses[0] = skeleton.noseMass;
    for (std::size_t node = 1; node < kFirstTip; ++node)
        masses.at(node) = skeleton.rings.at((node - 1) / 4).nodeMass;
    masses[kFirstTip] = masses[kFirstTip + 1] = skeleton.tailTipMass;
    double sum = 0;
    for (const double mass : masses) sum += mass;
    for (double& mass : masses) mass /= sum;
    return masses;
}

// A fish that lives a times faster is the same fish with stiffness a^2 and damping a; drag that
// goes with the square of speed needs no change.
double stiffnessOf(const Unit& unit, const config::Tissue& tissue) {
    double stiffness = tissue.muscleStiffness;
    if (unit.kind == UnitKind::Normal) stiffness = tissue.stiffness;
    if (unit.kind == UnitKind::Cross) stiffness = tissue.crossStiffness;
    if (unit.first >= kFirstTailNode) stiffness *= tissue.tailStiffening;
    return stiffness * tissue.timeScale * tissue.timeScale;
}

}  // namespace

BiomechanicalFish makeBiomechanicalFish(const config::Species& species) {
    BiomechanicalFish fish;
    fish.restPositions = restPositionsOf(species.skeleton);
    const int free = freeShapeChanges(fish.restPositions, anatomy().units);
    if (free > 0)
        throw Error(species.name + ": its skeleton is not rigid: the springs leave " +
                    std::to_string(free) +
                    " changes of shape free; give each ring of `skeleton` a height, a width and a "
                    "place of its own");
    fish.masses = massesOf(species.skeleton);
    fish.timeScale = species.tissue.timeScale;
    fish.finDrag = species.water.finDrag * species.tissue.timeScale;
    fish.damping = species.tissue.damping * species.tissue.timeScale;
    fish.muscleContraction = species.tissue.muscleContraction;
    for (std::size_t i = 0; i < fish.springs.size(); ++i) {
        const Unit& unit = anatomy().units.at(i);
        fish.springs.at(i) = {.first = unit.first,
                              .second = unit.second,
                              .stiffness = stiffnessOf(unit, species.tissue),
                              .restLength = glm::distance(fish.restPositions.at(unit.first),
                                                          fish.restPositions.at(unit.second))};
    }
    for (std::size_t i = 0; i < fish.faces.size(); ++i) {
        const DragFace& face = anatomy().faces.at(i);
        // The one-sided law gives back no pressure behind the widest part, so it overrates the drag
        // of the head.
        const bool isHead = std::ranges::max(face.nodes) <= kLastHeadNode;
        fish.faces.at(i) = {
            face.nodes,
            species.water.drag * face.weight * (isHead ? species.water.frontFactor : 1)};
    }
    return fish;
}

FishState stateAtRest(const BiomechanicalFish& fish) {
    return {.positions = fish.restPositions, .velocities = {}};
}

}  // namespace aquarama::capture
