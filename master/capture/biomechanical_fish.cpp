// SPDX-License-Identifier: Apache-2.0

#include "master/capture/biomechanical_fish.h"

#include <algorithm>
#include <cassert>
#include <string>

#include <Eigen/QR>
#include <glm/geometric.hpp>

#include "common/units/log.h"

namespace aquarama::capture {

namespace {

constexpr int kRings = 5;
constexpr int kDorsalTip = 21;
constexpr int kVentralTip = 22;

// The k-th node of a ring: dorsal left, dorsal right, ventral right, ventral left, and round again.
constexpr int ringNode(int ring, int k) {
    return 1 + 4 * ring + k % 4;
}

constexpr Side sideOf(int k) {
    return k == 1 || k == 2 ? Side::Right : Side::Left;
}

class Builder {
  public:
    Anatomy build() {
        for (int k = 0; k < 4; ++k) {
            unit(0, ringNode(0, k), UnitKind::Normal);
            face(0, ringNode(0, k), ringNode(0, k + 1), 1);
        }
        for (int ring = 0; ring < kRings; ++ring) addRing(ring);
        for (int ring = 0; ring + 1 < kRings; ++ring) addSegment(ring);
        addTail();
        assert(units_ == kUnits && faces_ == kDragFaces);
        return anatomy_;
    }

  private:
    void addRing(int ring) {
        for (int k = 0; k < 4; ++k)
            unit(ringNode(ring, k), ringNode(ring, k + 1), UnitKind::Normal);
        unit(ringNode(ring, 0), ringNode(ring, 2), UnitKind::Cross);
        unit(ringNode(ring, 1), ringNode(ring, 3), UnitKind::Cross);
    }

    // Between a ring and the next: four units along the body and two struts across each face.
    void addSegment(int ring) {
        constexpr std::array<UnitKind, 4> kAlong{
            UnitKind::FrontMuscle, UnitKind::MiddleMuscle, UnitKind::BackMuscle, UnitKind::Normal};
        const UnitKind along = kAlong.at(static_cast<std::size_t>(ring));
        for (int k = 0; k < 4; ++k) {
            const Side side = along == UnitKind::Normal ? Side::Neither : sideOf(k);
            unit(ringNode(ring, k), ringNode(ring + 1, k), along, side);
            unit(ringNode(ring, k), ringNode(ring + 1, k + 1), UnitKind::Cross);
            unit(ringNode(ring, k + 1), ringNode(ring + 1, k), UnitKind::Cross);
            quad(ringNode(ring, k),
                 ringNode(ring + 1, k),
                 ringNode(ring + 1, k + 1),
                 ringNode(ring, k + 1));
        }
    }

    void addTail() {
        const int dorsalLeft = ringNode(4, 0);
        const int dorsalRight = ringNode(4, 1);
        const int ventralRight = ringNode(4, 2);
        const int ventralLeft = ringNode(4, 3);
        for (const int node : {dorsalLeft, dorsalRight}) {
            unit(node, kDorsalTip, UnitKind::Normal);
            unit(node, kVentralTip, UnitKind::Cross);
        }
        for (const int node : {ventralRight, ventralLeft}) {
            unit(node, kVentralTip, UnitKind::Normal);
            unit(node, kDorsalTip, UnitKind::Cross);
        }
        unit(kDorsalTip, kVentralTip, UnitKind::Normal);
        face(dorsalLeft, kDorsalTip, dorsalRight, 1);
        face(ventralRight, kVentralTip, ventralLeft, 1);
        quad(dorsalRight, kDorsalTip, kVentralTip, ventralRight);
        quad(ventralLeft, kVentralTip, kDorsalTip, dorsalLeft);
    }

    void unit(int a, int b, UnitKind kind, Side side = Side::Neither) {
        anatomy_.units.at(units_++) = {static_cast<std::uint8_t>(std::min(a, b)),
                                       static_cast<std::uint8_t>(std::max(a, b)),
                                       kind,
                                       side};
    }
    void face(int a, int b, int c, double weight) {
        anatomy_.faces.at(faces_++) = {{static_cast<std::uint8_t>(a),
                                        static_cast<std::uint8_t>(b),
                                        static_cast<std::uint8_t>(c)},
                                       weight};
    }
    void quad(int a, int b, int c, int d) {
        face(a, b, c, 0.5);
        face(a, c, d, 0.5);
        face(a, b, d, 0.5);
        face(b, c, d, 0.5);
    }

    Anatomy anatomy_;
    std::size_t units_ = 0;
    std::size_t faces_ = 0;
};

// The same ring, its nodes exchanged in the given way.
int exchanged(int node, const std::array<int, 4>& exchange) {
    const int ring = (node - 1) / 4;
    return ringNode(ring, exchange.at(static_cast<std::size_t>((node - 1) % 4)));
}

}  // namespace

const Anatomy& anatomy() {
    static const Anatomy kAnatomy = Builder().build();
    return kAnatomy;
}

int mirroredLeftRight(int node) {
    const bool isOnMidplane = node == 0 || node >= kDorsalTip;
    return isOnMidplane ? node : exchanged(node, {1, 0, 3, 2});
}

int mirroredTopBottom(int node) {
    if (node == 0) return 0;
    if (node >= kDorsalTip) return kDorsalTip + kVentralTip - node;
    return exchanged(node, {3, 2, 1, 0});
}

// A row a unit: how fast its length grows, times that length, as each coordinate does.
int freeShapeChanges(const NodeVectors& positions, std::span<const Unit> units) {
    constexpr Eigen::Index kCoordinates = 3 * Eigen::Index{body::kNodalPoints};
    Eigen::MatrixXd rigidity =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(units.size()), kCoordinates);
    for (std::size_t i = 0; i < units.size(); ++i) {
        const Unit& unit = units[i];
        const glm::dvec3 r = positions.at(unit.second) - positions.at(unit.first);
        for (int p = 0; p < 3; ++p) {
            rigidity(static_cast<Eigen::Index>(i), 3 * unit.first + p) = -r[p];
            rigidity(static_cast<Eigen::Index>(i), 3 * unit.second + p) = r[p];
        }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> reduced(rigidity);
    // The softest change of shape of a thin fish has a pivot of a hundredth of the largest; what a
    // missing unit leaves is rounding.
    reduced.setThreshold(1e-6);
    return kShapeChanges - static_cast<int>(reduced.rank());
}

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
