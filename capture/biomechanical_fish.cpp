// SPDX-License-Identifier: Apache-2.0
#include "capture/biomechanical_fish.h"

#include <algorithm>
#include <cassert>
#include <string>

#include <Eigen/QR>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/body/fins.h"

namespace aquarama::capture {

namespace {

// Connections.

constexpr int kRings = 5;
constexpr int kDorsalTip = 21;
constexpr int kVentralTip = 22;

// The k-th node of a ring: dorsal left, dorsal right, ventral right, ventral left; k is taken
// modulo 4, so that k + 1 is always the next corner. Here rings count from 0.
constexpr int ringNode(int ring, int k) {
    return 1 + 4 * ring + k % 4;
}

// The side of the corner k of a ring, 0 to 3.
constexpr Side sideOf(int k) {
    return k == 1 || k == 2 ? Side::Right : Side::Left;
}

// Lists units and faces from head to tail. The order is part of the format of a simulation: it
// decides the order of the sums in step(), and so the last bit of a captured repertoire.
class Builder {
  public:
    // Used once for each Builder. 4 + 5 * 6 + 4 * 12 + 9 = 91 units and 4 + 4 * 16 + 10 = 78 faces.
    Anatomy build() {
        for (int k = 0; k < 4; ++k) {
            unit(0, ringNode(0, k), UnitKind::Normal);
            face(0, ringNode(0, k), ringNode(0, k + 1), 1);
        }
        for (int ring = 0; ring < kRings; ++ring) addRing(ring);
        for (int ring = 0; ring + 1 < kRings; ++ring) addSegment(ring);
        addTail();
        assert(units_ == kUnits);
        assert(faces_ == kDragFaces);
        return anatomy_;
    }

  private:
    // The four edges of a ring and its two diagonals.
    void addRing(int ring) {
        for (int k = 0; k < 4; ++k)
            unit(ringNode(ring, k), ringNode(ring, k + 1), UnitKind::Normal);
        unit(ringNode(ring, 0), ringNode(ring, 2), UnitKind::Cross);
        unit(ringNode(ring, 1), ringNode(ring, 3), UnitKind::Cross);
    }

    // Between a ring and the next: four units along the body and both diagonals of each of the four
    // side faces. The units along the first three segments are the 12 muscles.
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

    // From the last ring to the two tips. The dorsal nodes hold the dorsal tip by normal units and
    // the ventral tip by cross units, and the other way round.
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
    // Both ways of splitting a quad, each triangle with half the weight (see DragFace).
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

// The node of the same ring at the exchanged corner, for a node of a ring.
int exchanged(int node, const std::array<int, 4>& exchange) {
    assert(node > 0);
    assert(node < kDorsalTip);
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

// The rigidity matrix has a row for each unit and a column for each coordinate of each node. An
// element is the derivative of half the squared length of the unit by that coordinate.
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
    // The smallest pivot of a thin but rigid fish is about a hundredth of the largest. Where a unit
    // is missing, only rounding remains. The threshold is far from both.
    reduced.setThreshold(1e-6);
    return kShapeChanges - static_cast<int>(reduced.rank());
}

namespace {

// Physical parameters. Here rings count from 1, as in the paper and in the species files.

constexpr int kLastHeadNode = 8;       // the last node of ring 2
constexpr std::size_t kFirstTip = 21;  // the dorsal tip; the ventral one follows

// Nose at the origin, tips of the tail at x = -1; the four corners of a ring in the order of
// ringNode().
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

// The masses in a species file are relative; here their sum is 1.
std::array<double, body::kNodalPoints> massesOf(const config::Skeleton& skeleton) {
    std::array<double, body::kNodalPoints> masses{};
    masses[0] = skeleton.noseMass;
    for (std::size_t node = 1; node < kFirstTip; ++node)
        masses.at(node) = skeleton.rings.at((node - 1) / 4).nodeMass;
    masses[kFirstTip] = masses[kFirstTip + 1] = skeleton.tailTipMass;
    double sum = 0;
    for (const double mass : masses) sum += mass;
    assert(sum > 0);
    for (double& mass : masses) mass /= sum;
    return masses;
}

// The same motion, a times faster, needs stiffness times a^2 and damping times a, by dimensions.
// Drag that is proportional to the square of speed needs no change. a is tissue.timeScale.
double stiffnessOf(const Unit& unit, const config::Tissue& tissue) {
    double stiffness = tissue.muscleStiffness;
    if (unit.kind == UnitKind::Normal) stiffness = tissue.stiffness;
    if (unit.kind == UnitKind::Cross) stiffness = tissue.crossStiffness;
    if (unit.first >= kFirstTailNode) stiffness *= tissue.tailStiffening;
    return stiffness * tissue.timeScale * tissue.timeScale;
}

Blade bladeOf(const config::Species& species) {
    const body::PectoralFin fin = body::pectoralFinOf(species);
    const double ring2 = species.skeleton.rings[1].s;
    return {.root = glm::dvec3(fin.root) - glm::dvec3(ring2, 0, 0),
            .hinge = fin.hinge,
            .stroke = fin.stroke,
            .ray = fin.ray,
            .chord = fin.chord,
            .span = static_cast<double>(fin.span),
            .area = static_cast<double>(fin.area),
            .rowing = static_cast<double>(fin.rowing),
            .folded = static_cast<double>(fin.folded),
            .drag = species.water.drag};
}

}  // namespace

BiomechanicalFish makeBiomechanicalFish(const config::Species& species) {
    assert(species.tissue.timeScale > 0);
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
    fish.blade = bladeOf(species);
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
        // A real body recovers pressure behind its widest part. The one-sided law has no such
        // recovery and overestimates the drag of the head, so a factor below 1 reduces it.
        const bool isHead = std::ranges::max(face.nodes) <= kLastHeadNode;
        fish.faces.at(i) = {
            face.nodes,
            species.water.drag * face.weight * (isHead ? species.water.frontFactor : 1)};
    }
    return fish;
}

glm::dvec3 meanOf(const BiomechanicalFish& fish, const NodeVectors& vectors) {
    glm::dvec3 mean{};
    for (std::size_t i = 0; i < vectors.size(); ++i) mean += fish.masses.at(i) * vectors.at(i);
    return mean;
}

FishState stateAtRest(const BiomechanicalFish& fish) {
    return {.positions = fish.restPositions, .velocities = {}};
}

}  // namespace aquarama::capture
