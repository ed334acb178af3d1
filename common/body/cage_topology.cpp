// SPDX-License-Identifier: Apache-2.0
#include "common/body/cage_topology.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

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

Vertex tubeVertex(int ring, int column) {
    return static_cast<Vertex>(ring * kTubeColumns + column % kTubeColumns);
}

// Builds the cage with faces clockwise as seen from outside; makeCageTopology turns them over.
class Builder {
  public:
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

    void closeNose() {
        const Vertex n = add({.kind = CageSiteKind::Nose, .ring = 0, .column = 0});
        const Vertex n1 = add({.kind = CageSiteKind::Nose, .ring = 0, .column = 1});
        const Vertex n2 = add({.kind = CageSiteKind::Nose, .ring = 1, .column = 0});
        const Vertex n3 = add({.kind = CageSiteKind::Nose, .ring = 1, .column = 1});
        const std::array<Face, 4> grid{
            {{11, 0, 1, 2}, {10, n, n1, 3}, {9, n2, n3, 4}, {8, 7, 6, 5}}};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                faces_.push_back({grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
    }

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

    // Raises a strip of tube faces by some levels; walls follow its outline.
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
    std::map<Cell, Face> tube_;  // what is not yet raised
    std::vector<CageCrease> creases_;
};

std::vector<Cell> strip(int firstRing, int lastRing, int column) {
    std::vector<Cell> cells;
    for (int r = firstRing; r < lastRing; ++r) cells.emplace_back(r, column);
    return cells;
}

}  // namespace

CageTopology makeCageTopology() {
    Builder cage;
    cage.closeNose();
    cage.closeTail();
    cage.raise(CagePart::FirstDorsal, strip(6, 13, 0), 2);
    cage.raise(CagePart::SecondDorsal, strip(14, 20, 0), 1);
    cage.raise(CagePart::Anal, strip(15, 20, 6), 2);
    cage.raise(CagePart::Pelvic, {{7, 5}}, 2);
    cage.raise(CagePart::Pelvic, {{7, 7}}, 2);
    cage.raise(CagePart::Pectoral, {{5, 3}, {5, 4}}, 2);
    cage.raise(CagePart::Pectoral, {{5, 8}, {5, 9}}, 2);
    return std::move(cage).finish();
}

}  // namespace aquarama::body
