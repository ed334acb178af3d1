// SPDX-License-Identifier: Apache-2.0
#include "common/body/cage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/units.h"
#include "common/body/fish_body.h"
#include "common/body/spine.h"

namespace aquarama::body {

namespace {

using Vertex = std::uint16_t;
using Face = std::array<Vertex, 4>;
using Edge = std::pair<Vertex, Vertex>;
using Cell = std::pair<int, int>;  // ring and column of a tube face's first corner

// Sharp enough that margins stay crisp to the finest level of detail, yet round under a lens; the
// roots only a little, so that fins grow out of the body.
constexpr float kMarginSharpness = 2.5F;
constexpr float kRootSharpness = 1.0F;
constexpr float kLipSharpness = 1.5F;

Vertex tubeVertex(int ring, int column) {
    return static_cast<Vertex>(ring * kTubeColumns + column % kTubeColumns);
}

// Builds the cage with faces clockwise as seen from outside; finish() turns them over. The order of
// calls decides the numbers of vertices and faces: change it, and every table that refers to them
// is stale.
class Builder {
  public:
    // The open tube. Its vertices come first, so that tubeVertex() gives their numbers.
    Builder() {
        for (int r = 0; r < kTubeRings; ++r)
            for (int c = 0; c < kTubeColumns; ++c)
                sites_.push_back({.part = r > kBodyEndRing ? CagePart::Caudal : CagePart::Body,
                                  .ring = r,
                                  .column = c});
        for (int r = 0; r + 1 < kTubeRings; ++r)
            for (int c = 0; c < kTubeColumns; ++c)
                tube_[{r, c}] = {tubeVertex(r, c),
                                 tubeVertex(r, c + 1),
                                 tubeVertex(r + 1, c + 1),
                                 tubeVertex(r + 1, c)};
    }

    // Fills ring 0, the loop of the lips, with a grid of 3 x 3 quads: its 12 border vertices are
    // those of the ring, its 4 inner ones are new. Creases the lips.
    void closeMouth() {
        const Vertex n = add({.kind = CageSiteKind::Mouth, .ring = 0, .column = 0});
        const Vertex n1 = add({.kind = CageSiteKind::Mouth, .ring = 0, .column = 1});
        const Vertex n2 = add({.kind = CageSiteKind::Mouth, .ring = 1, .column = 0});
        const Vertex n3 = add({.kind = CageSiteKind::Mouth, .ring = 1, .column = 1});
        const std::array<Face, 4> grid{
            {{11, 0, 1, 2}, {10, n, n1, 3}, {9, n2, n3, 4}, {8, 7, 6, 5}}};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                faces_.push_back({grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
        for (int c = 0; c < kTubeColumns; ++c)
            crease(tubeVertex(0, c), tubeVertex(0, c + 1), kLipSharpness);
    }

    // Closes the last ring with 5 quads from the left to the right columns, and creases all margins
    // of the tail fin.
    void closeTail() {
        constexpr int kEnd = kTubeRings - 1;
        const std::array<int, 6> right{1, 2, 3, 4, 5, 6};
        const std::array<int, 6> left{0, 11, 10, 9, 8, 7};
        for (std::size_t i = 0; i < 5; ++i)
            faces_.push_back({tubeVertex(kEnd, left[i]),
                              tubeVertex(kEnd, right[i]),
                              tubeVertex(kEnd, right[i + 1]),
                              tubeVertex(kEnd, left[i + 1])});
        for (int c = 0; c < kTubeColumns; ++c)
            crease(tubeVertex(kEnd, c), tubeVertex(kEnd, c + 1), kMarginSharpness);
        for (int r = kBodyEndRing + 1; r < kEnd; ++r)
            for (const int c : {0, 1, 6, 7})
                crease(tubeVertex(r, c), tubeVertex(r + 1, c), kMarginSharpness);
    }

    // Extrudes a strip of tube faces by some levels into a flap: on each level a copy of the
    // strip's vertices, joined to the level below by a wall of quads along the outline. Creases the
    // root, the front and rear margin and the edge. The strip's faces move to the top of the flap
    // and leave tube_.
    void raise(CagePart part, const std::vector<Cell>& cells, int levels) {
        const std::vector<Edge> outline = outlineOf(cells);
        std::map<Vertex, Vertex> below;
        for (const Cell& cell : cells)
            for (const Vertex v : tube_.at(cell)) below[v] = v;
        for (const auto& [a, b] : outline) crease(a, b, kRootSharpness);
        const std::vector<Vertex> corners = cornersOf(cells);
        for (int level = 1; level <= levels; ++level) {
            std::map<Vertex, Vertex> above;
            for (const auto& [foot, _] : below)
                above[foot] = add({.kind = CageSiteKind::Flap,
                                   .part = part,
                                   .ring = sites_[foot].ring,
                                   .column = sites_[foot].column,
                                   .level = level,
                                   .levels = levels});
            for (const auto& [a, b] : outline)
                faces_.push_back({below.at(a), below.at(b), above.at(b), above.at(a)});
            for (const Vertex corner : corners)
                crease(below.at(corner), above.at(corner), kMarginSharpness);
            below = std::move(above);
        }
        for (const auto& [a, b] : outline) crease(below.at(a), below.at(b), kMarginSharpness);
        for (const Cell& cell : cells) {
            Face face = tube_.at(cell);
            for (Vertex& v : face) v = below.at(v);
            faces_.push_back(face);
            tube_.erase(cell);
        }
    }

    // Adds the tube's remaining faces and turns all faces outwards. The builder is empty
    // afterwards.
    [[nodiscard]] CageTopology finish() && {
        for (const auto& [cell, face] : tube_) faces_.push_back(face);
        for (Face& face : faces_) std::ranges::reverse(face);
        return {std::move(sites_), std::move(faces_), std::move(creases_)};
    }

  private:
    Vertex add(CageSite site) {
        sites_.push_back(site);
        return static_cast<Vertex>(sites_.size() - 1);
    }

    void crease(Vertex a, Vertex b, float sharpness) {
        creases_.push_back({{std::min(a, b), std::max(a, b)}, sharpness});
    }

    // The directed edges of the cells that no two of them share.
    [[nodiscard]] std::vector<Edge> outlineOf(const std::vector<Cell>& cells) const {
        std::set<Edge> edges;
        for (const Cell& cell : cells) {
            const Face& face = tube_.at(cell);
            for (std::size_t k = 0; k < 4; ++k) edges.insert({face[k], face[(k + 1) % 4]});
        }
        std::vector<Edge> outline;
        for (const auto& [a, b] : edges)
            if (!edges.contains({b, a})) outline.emplace_back(a, b);
        return outline;
    }

    // The vertices that only one of the cells has: where a fin's front and rear margin rise.
    [[nodiscard]] std::vector<Vertex> cornersOf(const std::vector<Cell>& cells) const {
        std::map<Vertex, int> uses;
        for (const Cell& cell : cells)
            for (const Vertex v : tube_.at(cell)) ++uses[v];
        std::vector<Vertex> corners;
        for (const auto& [vertex, count] : uses)
            if (count == 1) corners.push_back(vertex);
        return corners;
    }

    std::vector<CageSite> sites_;
    std::vector<Face> faces_;
    std::map<Cell, Face> tube_;  // the faces that are not raised yet
    std::vector<CageCrease> creases_;
};

// The tube faces of one column between two rings.
std::vector<Cell> strip(int firstRing, int lastRing, int column) {
    std::vector<Cell> cells;
    for (int r = firstRing; r < lastRing; ++r) cells.emplace_back(r, column);
    return cells;
}

// The shape of the cage. Lengths in body lengths.
constexpr float kRidgeHalfWidth = 0.006F;  // of the strips along back and belly that fins grow from
// A lone dorsal fin takes both strips, with hardly a gap between them; this is the share of the
// first.
constexpr float kFirstStripShare = 0.54F;
constexpr float kStripGap = 0.001F;
constexpr float kStripOverlap = 0.02F;  // of the rays, above the gap, which therefore does not show
constexpr float kRootHalfLength = 0.012F;  // of the pectoral fins

// How many columns a column is from the middle of the back, on its side.
int stepOf(int column) {
    return column >= 1 && column <= 6 ? column - 1 : (kTubeColumns - column) % kTubeColumns;
}

// Where a column is on its ring: how far down from back (0) over flank (1) to belly (2), at what
// angle above the horizontal (radians), on which side, and which ray of the tail fin it becomes.
struct ColumnPlace {
    float down;
    float angle;
    float side;  // +1 right
    float ray;
};

ColumnPlace placeOf(int column) {
    constexpr std::array<float, 6> kDown{0, 0.35F, 0.8F, 1.2F, 1.65F, 2};
    constexpr std::array<float, 6> kAngle{0, 58, 20, -20, -58, 0};
    const bool isRight = column >= 1 && column <= 6;
    const auto k = static_cast<std::size_t>(stepOf(column));
    return {kDown[k],
            kAngle[k] * kRadiansPerDegree<float>,
            isRight ? 1.0F : -1.0F,
            static_cast<float>(k) / 5};
}

// The sine or cosine of an ellipse's angle, on a superellipse.
float superellipse(float circular, float fullness) {
    return std::copysign(std::pow(std::abs(circular), 2 / fullness), circular);
}

// The four columns along the middle of back and belly, between which the median fins grow.
bool isRidge(int column) {
    return column <= 1 || column == 6 || column == 7;
}

// Half the thickness of a fin, in body lengths: a membrane is thinner at its edge than at its root.
float finHalfThickness(float q) {
    return 0.0045F * (1 - q) + 0.0008F;
}

// Even steps from one value to another.
float between(float from, float to, int step, int steps) {
    return glm::mix(from, to, static_cast<float>(step) / static_cast<float>(steps));
}

// The rings of the head, from the one around the lips: closer together towards the nose, where the
// head curves most.
float headStation(std::size_t ring, std::size_t lastRing, float first, float last) {
    const float share = static_cast<float>(ring - 1) / static_cast<float>(lastRing - 1);
    return glm::mix(first, last, std::pow(share, 1.35F));
}

// The two rings between which the pectoral fins grow from the flank, and the columns of their
// roots.
bool isPectoralRing(int ring) {
    return ring == 5 || ring == 6;
}

bool isPectoralRoot(int ring, int column) {
    return isPectoralRing(ring) && !isRidge(column) && column != 2 && column != 11;
}

// The unit vector perpendicular to a fin's base, on the side of its rays.
glm::vec2 awayFrom(glm::vec2 base, const FinPatch& fin) {
    const glm::vec2 square{-base.y, base.x};
    return glm::dot(fin.at(0.5F, 1) - fin.at(0.5F, 0), square) < 0 ? -square : square;
}

// Columns 3-5 and 10-8 are the front, the middle and the rear ray of a pectoral fin.
float pectoralRay(int column) {
    return static_cast<float>(column < 6 ? column - 3 : 10 - column) / 2;
}

// A rest position carried along by the spine: the plane across the axis is kept square to it.
glm::vec3 place(const Spine& spine, glm::vec3 rest) {
    const SpineSample sample = sampleAt(spine, rest.x);
    const glm::vec3 forward = -glm::normalize(sample.tailwards);
    const glm::vec3 right =
        glm::normalize(sample.right - forward * glm::dot(sample.right, forward));
    return sample.centre + rest.y * glm::cross(right, forward) + rest.z * right;
}

}  // namespace

CageTopology makeCageTopology() {
    Builder cage;
    cage.closeMouth();
    cage.closeTail();
    cage.raise(CagePart::FirstDorsal, strip(6, 13, 0), 2);
    cage.raise(CagePart::SecondDorsal, strip(14, 20, 0), 1);
    cage.raise(CagePart::Anal, strip(15, 20, 6), 2);
    cage.raise(CagePart::Pelvic, {{7, 5}}, 2);
    cage.raise(CagePart::Pelvic, {{7, 7}}, 2);
    cage.raise(CagePart::Pectoral, {{5, 3}, {5, 4}}, 2);
    cage.raise(CagePart::Pectoral, {{5, 8}, {5, 9}}, 2);
    CageTopology topology = std::move(cage).finish();
    assert(topology.sites.size() == kControlPoints);
    assert(topology.faces.size() == kCageFaces);
    return topology;
}

CageShape::CageShape(const config::Species& species)
    : sections_(species.profile),
      mouth_(species.mouth, sections_),
      firstDorsal_(species.fins.firstDorsal),
      secondDorsal_(species.fins.secondDorsal.value_or(species.fins.firstDorsal)),
      anal_(species.fins.anal),
      caudal_(species.fins.caudal),
      pelvic_(species.fins.pelvic),
      pectoral_(species.fins.pectoral),
      isOneDorsal_(!species.fins.secondDorsal) {
    slantRings(species);
}

// Ring by ring: 6-13 span the first dorsal fin on the back and 14-20 the second; on the belly 7-8
// span the pelvic and 15-20 the anal fin; on the flank 5-6 hold the root of the pectoral fin. The
// head's rings are spaced by headStation(); flank rings behind the pectoral fin follow the mean of
// back and belly.
void CageShape::slantRings(const config::Species& species) {
    const float end = species.profile.stations.back();
    const auto fill = [](RingStations& rings, int first, int last, float from, float to) {
        for (int r = first; r <= last; ++r)
            rings.at(static_cast<std::size_t>(r)) = between(from, to, r - first, last - first);
    };
    const float first = firstDorsal_.baseFront().x;
    const float last = secondDorsal_.baseRear().x;
    const float cut = glm::mix(first, last, kFirstStripShare);
    fill(back_, 6, 13, first, isOneDorsal_ ? cut - kStripGap / 2 : firstDorsal_.baseRear().x);
    fill(back_, 14, 20, isOneDorsal_ ? cut + kStripGap / 2 : secondDorsal_.baseFront().x, last);

    float root = 0;  // mean station of the pectoral's root, between rings 5 and 6
    for (const glm::vec2& point : species.fins.pectoral.base)
        root += point.x / static_cast<float>(species.fins.pectoral.base.size());
    belly_[7] = pelvic_.baseFront().x;
    belly_[6] = std::min(belly_[7] - 0.03F, std::max(back_[6], root + 0.03F));
    fill(belly_, 8, 15, pelvic_.baseRear().x, anal_.baseFront().x);
    fill(belly_, 15, 20, anal_.baseFront().x, anal_.baseRear().x);
    back_[kBodyEndRing] = belly_[kBodyEndRing] = flank_[kBodyEndRing] = end;
    const auto [back, flank, belly] = mouth_.ringStations();
    for (std::size_t r = 1; r < 6; ++r) {
        back_.at(r) = headStation(r, 6, back, back_[6]);
        belly_.at(r) = headStation(r, 6, belly, belly_[6]);
        flank_.at(r) = headStation(r, 5, flank, root - kRootHalfLength);
    }
    flank_[6] = root + kRootHalfLength;
    const float middle = (back_[6] + belly_[6]) / 2;
    for (std::size_t r = 7; r < kBodyEndRing; ++r)
        flank_.at(r) =
            glm::mix(flank_[6], end, ((back_.at(r) + belly_.at(r)) / 2 - middle) / (end - middle));
}

CageVertex CageShape::place(const CageSite& site) const {
    assert(site.ring >= 0);
    assert(site.ring < kTubeRings);
    assert(site.column >= 0);
    assert(site.column < kTubeColumns);
    assert(site.kind != CageSiteKind::Flap || (site.level >= 1 && site.level <= site.levels));
    switch (site.kind) {
        case CageSiteKind::Mouth:
            return {.rest = mouth_.inside(site.ring, site.column == 0 ? -1.0F : 1.0F), .mouth = 1};
        case CageSiteKind::Tube:
            if (site.ring > kBodyEndRing) return onCaudal(site.ring, site.column);
            if (site.ring == 0)
                return {.rest = mouth_.onLip(stepOf(site.column), placeOf(site.column).side),
                        .mouth = kLips};
            return {.rest = onBody(site.ring, site.column)};
        case CageSiteKind::Flap:
            break;
    }
    const bool isPaired = site.part == CagePart::Pelvic || site.part == CagePart::Pectoral;
    return isPaired ? onPairedFin(site) : onMedianFin(site);
}

// On the superellipse of the section, grown by kCageGrowth; the ring around the lips and the
// columns of the ridges and of the pectoral root have places of their own.
glm::vec3 CageShape::onBody(int ring, int column) const {
    const auto r = static_cast<std::size_t>(ring);
    const ColumnPlace at = placeOf(column);
    const int step = stepOf(column);
    if (ring == 1) return mouth_.aroundLips(step, at.side);
    const float s = at.down < 1 ? glm::mix(back_.at(r), flank_.at(r), at.down)
                                : glm::mix(flank_.at(r), belly_.at(r), at.down - 1);
    const Section section = sections_.at(s);
    const float height = at.down < 1 ? section.dorsal : section.ventral;
    const float fullness = at.down < 1 ? section.fullnessUp : section.fullnessDown;
    // No fin grows from the belly there; the belly makes up for what the pectoral root takes from
    // the flank.
    if (isPectoralRing(ring) && isRidge(column) && at.down > 1)
        return {s, -0.98F * section.ventral, at.side * 0.3F * section.halfWidth};
    if (isRidge(column))
        return {s,
                at.down < 1 ? section.dorsal : -section.ventral,
                at.side * std::min(kRidgeHalfWidth, 0.45F * section.halfWidth)};
    if (ring == 2 && (step == 2 || step == 3)) {
        // Half of the way from the columns beside the corner of the mouth to those of the flank.
        const float flank = superellipse(std::sin(at.angle), fullness);
        const float share = glm::mix(mouth_.shareBeside(step), flank, 0.5F);
        return {s,
                kCageGrowth * section.heightAt(share),
                at.side * kCageGrowth * section.widthAt(share)};
    }
    if (!isPectoralRoot(ring, column))
        return {
            s,
            height * superellipse(std::sin(at.angle), fullness) * kCageGrowth,
            at.side * section.halfWidth * superellipse(std::cos(at.angle), fullness) * kCageGrowth};
    return onPectoralRoot(ring, column);
}

// On the drawn base of the pectoral fin, a little before it (ring 5) or behind it (ring 6), as far
// out as the section is at that height.
glm::vec3 CageShape::onPectoralRoot(int ring, int column) const {
    const glm::vec2 base = pectoral_.at(pectoralRay(column), 0);
    const float s = base.x + (ring == 5 ? -kRootHalfLength : kRootHalfLength);
    const Section section = sections_.at(s);
    const bool isAbove = base.y > 0;
    const float relative = std::abs(base.y) / (isAbove ? section.dorsal : section.ventral);
    const float fullness = isAbove ? section.fullnessUp : section.fullnessDown;
    return {s,
            base.y,
            placeOf(column).side * section.halfWidth *
                std::pow(std::max(0.05F, 1 - std::pow(relative, fullness)), 1 / fullness)};
}

// Rays of the tail fin start where the body ends, not at the drawn base.
CageVertex CageShape::onCaudal(int ring, int column) const {
    const ColumnPlace at = placeOf(column);
    const float q = static_cast<float>(ring - kBodyEndRing) / (kTubeRings - 1 - kBodyEndRing);
    const glm::vec2 root{back_[kBodyEndRing], caudal_.at(at.ray, 0).y};
    return {.rest = {glm::mix(root, caudal_.at(at.ray, 1), q), at.side * finHalfThickness(q)},
            .part = CagePart::Caudal,
            .fin = {at.ray, q}};
}

// Rays of a median fin start at the ridge itself: a base that is drawn a little too deep would hide
// the fin's margins inside the body.
CageVertex CageShape::onMedianFin(const CageSite& site) const {
    const bool isAnal = site.part == CagePart::Anal;
    const FinPatch& fin = isAnal                               ? anal_
                          : site.part == CagePart::FirstDorsal ? firstDorsal_
                                                               : secondDorsal_;
    const float s = (isAnal ? belly_ : back_).at(static_cast<std::size_t>(site.ring));
    const float q = static_cast<float>(site.level) / static_cast<float>(site.levels);
    const bool isCut = isOneDorsal_ && site.part == CagePart::FirstDorsal && site.ring == 13;
    const float p = fin.rayAtStation(s) + (isCut ? kStripOverlap : 0);
    const Section section = sections_.at(s);
    const glm::vec2 ridge{fin.at(p, 0).x, isAnal ? -section.ventral : section.dorsal};
    return {
        .rest = {glm::mix(ridge, fin.at(p, 1), q), placeOf(site.column).side * finHalfThickness(q)},
        .part = isOneDorsal_ && !isAnal ? CagePart::FirstDorsal : site.part,
        .fin = {p, q}};
}

// A paired fin is flat and stands off the flank by its angle, turned about its base.
CageVertex CageShape::onPairedFin(const CageSite& site) const {
    const bool isPelvic = site.part == CagePart::Pelvic;
    const FinPatch& fin = isPelvic ? pelvic_ : pectoral_;
    const float p = isPelvic ? static_cast<float>(site.ring - 7) : pectoralRay(site.column);
    const float q = static_cast<float>(site.level) / static_cast<float>(site.levels);
    const glm::vec2 hinge = glm::normalize(fin.baseRear() - fin.baseFront());
    const glm::vec2 outwards = awayFrom(hinge, fin);
    const glm::vec2 drawn = fin.paddleAt(p, q) - fin.baseFront();
    const float reach = glm::dot(drawn, outwards);
    const float root = (isPelvic ? 0.35F : 0.97F) * sections_.at(fin.at(0.5F, 0).x).halfWidth;
    // Its root is twisted by a quarter turn. On a fin that points back, the front of the root
    // becomes the outer side; on a fin that points down, the inner side.
    const bool pointsDown = hinge.x * outwards.y < hinge.y * outwards.x;
    const bool isOuter =
        isPelvic ? site.column == 5 || site.column == 8 : (site.ring == 5) != pointsDown;
    const float thickness = (isOuter ? 0.003F : -0.003F) * (1 - 0.7F * q);
    const float sine = std::sin(fin.angleRadians());
    const float cosine = std::cos(fin.angleRadians());
    const glm::vec2 inFlank = fin.baseFront() + hinge * glm::dot(drawn, hinge) +
                              outwards * (reach * cosine - thickness * sine);
    return {
        .rest = {inFlank, placeOf(site.column).side * (root + reach * sine + thickness * cosine)},
        .part = site.part,
        .fin = {p, q}};
}

void poseCage(const FishBody& body, const NodalPoints& nodes, std::span<glm::vec3> controlPoints) {
    assert(controlPoints.size() == body.cage.vertices.size());
    const Spine spine = spineOf(knotStations(body), nodes);
    for (std::size_t i = 0; i < controlPoints.size(); ++i)
        controlPoints[i] = place(spine, body.cage.vertices[i].rest);
}

}  // namespace aquarama::body
