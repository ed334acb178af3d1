// SPDX-License-Identifier: Apache-2.0
#include "common/skin/limit_table.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include "common/base/log.h"
#include "common/skin/attachments.h"

namespace aquarama::skin {

namespace {

// The two ends of the edge on which a border vertex of a face lies, and how many cuts it is from
// the first.
struct OnEdge {
    std::uint16_t from, to;
    int step;
};

OnEdge onEdge(const std::array<std::uint16_t, 4>& face, int i, int j, int cuts) {
    if (j == 0) return {face[0], face[1], i};
    if (i == cuts) return {face[1], face[2], j};
    if (j == cuts) return {face[3], face[2], i};
    return {face[0], face[3], j};
}

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Semi-sharp creases of the cage end at sharpness 3, so four levels isolate every feature.
constexpr int kIsolationLevel = 4;

// The cage with its creases, refined adaptively by Catmull-Clark.
std::unique_ptr<Far::TopologyRefiner> refine(const body::ControlCage& cage) {
    const std::vector<int> verticesPerFace(cage.faces.size(), 4);
    std::vector<int> corners;
    for (const auto& face : cage.faces) corners.insert(corners.end(), face.begin(), face.end());
    std::vector<int> creaseEnds;
    std::vector<float> creaseSharpness;
    for (const body::CageCrease& crease : cage.creases) {
        creaseEnds.insert(creaseEnds.end(), crease.edge.begin(), crease.edge.end());
        creaseSharpness.push_back(crease.sharpness);
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(cage.vertices.size());
    descriptor.numFaces = static_cast<int>(cage.faces.size());
    descriptor.numVertsPerFace = verticesPerFace.data();
    descriptor.vertIndicesPerFace = corners.data();
    descriptor.numCreases = static_cast<int>(cage.creases.size());
    descriptor.creaseVertexIndexPairs = creaseEnds.data();
    descriptor.creaseWeights = creaseSharpness.data();

    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    std::unique_ptr<Far::TopologyRefiner> refiner{
        Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, Sdc::Options()))};
    if (!refiner) throw Error("OpenSubdiv does not accept the control cage as a surface");
    refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(kIsolationLevel));
    return refiner;
}

// The limit stencils, with first derivatives, of the vertices in faceOrder. OpenSubdiv takes
// locations face by face, so vertices of the same face must follow each other.
std::unique_ptr<const Far::LimitStencilTable> limitStencils(
    const Far::TopologyRefiner& refiner,
    const std::vector<FaceGrid::Location>& locations,
    std::span<const std::uint32_t> faceOrder) {
    std::vector<float> u, v;
    for (const std::uint32_t vertex : faceOrder) {
        u.push_back(locations[vertex].u);
        v.push_back(locations[vertex].v);
    }
    Far::LimitStencilTableFactory::LocationArrayVec arrays;
    for (std::size_t first = 0; first < faceOrder.size();) {
        Far::LimitStencilTableFactory::LocationArray array;
        const std::uint32_t face = locations[faceOrder[first]].face;
        std::size_t last = first;
        while (last < faceOrder.size() && locations[faceOrder[last]].face == face) ++last;
        array.ptexIdx = static_cast<int>(face);  // all faces are quads: the same number
        array.numLocations = static_cast<int>(last - first);
        array.s = &u[first];
        array.t = &v[first];
        arrays.push_back(array);
        first = last;
    }
    Far::LimitStencilTableFactory::Options options;
    options.generate1stDerivatives = true;
    return std::unique_ptr<const Far::LimitStencilTable>{
        Far::LimitStencilTableFactory::Create(refiner, arrays, nullptr, nullptr, options)};
}

// One stencil as entries, without entries that are all zero.
std::vector<StencilEntry> entriesOf(const Far::LimitStencilTable& stencils, std::size_t stencil) {
    const auto first = static_cast<std::size_t>(stencils.GetOffsets()[stencil]);
    const auto size = static_cast<std::size_t>(stencils.GetSizes()[stencil]);
    std::vector<StencilEntry> entries;
    for (std::size_t k = first; k < first + size; ++k) {
        const StencilEntry entry{static_cast<std::uint32_t>(stencils.GetControlIndices()[k]),
                                 stencils.GetWeights()[k],
                                 stencils.GetDuWeights()[k],
                                 stencils.GetDvWeights()[k]};
        if (entry.position != 0 || entry.tangentU != 0 || entry.tangentV != 0)
            entries.push_back(entry);
    }
    return entries;
}

// Level 0 only: its vertices are the control points themselves; the tangents, and so the normals,
// stay those of the limit surface.
void holdToControlPoint(std::vector<StencilEntry>& entries, std::uint32_t controlPoint) {
    for (StencilEntry& entry : entries)
        entry.position = entry.controlPoint == controlPoint ? 1.0F : 0.0F;
}

// The limit surface at rest of the right side of the head, around the eye: the faces of the body
// within three radii of it, each cut into 4 x 4.
std::vector<RestTriangle> headAtRest(const Far::TopologyRefiner& refiner,
                                     const body::FishBody& body) {
    constexpr int kCuts = 4;
    const FaceGrid grid{body.cage, kCuts};
    const float nearest = body.face.eye.x - 3 * body.face.eye.z,
                farthest = body.face.eye.x + 3 * body.face.eye.z;
    std::vector<FaceGrid::Location> locations;
    for (std::size_t f = 0; f < body.cage.faces.size(); ++f) {
        const bool isHead = std::ranges::all_of(body.cage.faces[f], [&](std::uint16_t corner) {
            const body::CageVertex& vertex = body.cage.vertices[corner];
            return vertex.part == body::CagePart::Body && vertex.rest.z > 0;
        });
        const auto [first, last] = std::ranges::minmax(
            body.cage.faces[f], {}, [&](std::uint16_t c) { return body.cage.vertices[c].rest.x; });
        if (!isHead || body.cage.vertices[last].rest.x < nearest ||
            body.cage.vertices[first].rest.x > farthest)
            continue;
        for (int j = 0; j <= kCuts; ++j)
            for (int i = 0; i <= kCuts; ++i)
                locations.push_back({static_cast<std::uint32_t>(f),
                                     static_cast<float>(i) / kCuts,
                                     static_cast<float>(j) / kCuts});
    }
    std::vector<std::uint32_t> order(locations.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto stencils = limitStencils(refiner, locations, order);
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < locations.size(); ++i) {
        glm::vec3& point = points.emplace_back();
        for (const StencilEntry& entry : entriesOf(*stencils, i))
            point += entry.position * body.cage.vertices[entry.controlPoint].rest;
    }
    constexpr std::size_t kRow = kCuts + 1;
    std::vector<RestTriangle> head;
    for (std::size_t first = 0; first < points.size(); first += kRow * kRow)
        for (std::size_t j = 0; j < kCuts; ++j)
            for (std::size_t i = 0; i < kCuts; ++i) {
                const std::size_t a = first + j * kRow + i;
                head.push_back({points[a], points[a + 1], points[a + kRow]});
                head.push_back({points[a + 1], points[a + kRow + 1], points[a + kRow]});
            }
    return head;
}

// Adds the attachments to a table whose skin is complete: vertices at the end, triangles at the end
// of the body's and of the fins'.
void append(const body::FishBody& body, const Attachments& attachments, LimitTable& table) {
    table.skinVertices = table.vertices.size();
    const auto first = static_cast<std::uint32_t>(table.vertices.size());
    for (const Attachments::Vertex& vertex : attachments.vertices) {
        table.entries.insert(table.entries.end(), vertex.entries.begin(), vertex.entries.end());
        table.firstEntry.push_back(static_cast<std::uint32_t>(table.entries.size()));
        table.vertices.push_back(vertex.place);
        glm::vec4& rest = table.vertices.back().rest;
        rest.w = heightOnBody(body, rest.x, rest.y);
    }
    std::vector<std::uint32_t> onBody;
    for (const auto& triangle : attachments.onBody)
        for (const std::uint32_t vertex : triangle) onBody.push_back(first + vertex);
    table.indices.insert(table.indices.begin() + static_cast<std::ptrdiff_t>(table.bodyIndices),
                         onBody.begin(),
                         onBody.end());
    table.bodyIndices += onBody.size();
    for (const auto& triangle : attachments.onFins)
        for (const std::uint32_t vertex : triangle) table.indices.push_back(first + vertex);
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair ordered(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

// The edges that only the two triangles of one quad share. The two triangles of a quad follow each
// other; those of attachments, which stand between, are skipped.
std::set<Pair> diagonalsOf(const LimitTable& table) {
    std::vector<std::array<std::uint32_t, 3>> skin;
    for (std::size_t t = 0; t < table.indices.size(); t += 3) {
        const std::array triangle{table.indices[t], table.indices[t + 1], table.indices[t + 2]};
        if (std::ranges::max(triangle) < table.skinVertices) skin.push_back(triangle);
    }
    std::set<Pair> diagonals;
    for (std::size_t t = 0; t + 1 < skin.size(); t += 2) {
        std::vector<std::uint32_t> shared;
        for (const std::uint32_t vertex : skin[t])
            if (std::ranges::find(skin[t + 1], vertex) != skin[t + 1].end())
                shared.push_back(vertex);
        diagonals.insert(ordered(shared.at(0), shared.at(1)));
    }
    return diagonals;
}

}  // namespace

// Runs over all faces; a vertex on an edge is found again by the edge's ends and its step, however
// the other face is turned.
FaceGrid::FaceGrid(const body::ControlCage& cage, int cuts) : cuts_{cuts} {
    assert(cuts >= 1);
    using EdgePoint = std::array<int, 3>;  // lower end, higher end, cuts from the lower
    std::map<EdgePoint, std::uint32_t> edgePoints;
    locations_.resize(cage.vertices.size());

    const auto number = [&](std::uint32_t face, int i, int j) -> std::uint32_t {
        const Location location{face,
                                static_cast<float>(i) / static_cast<float>(cuts),
                                static_cast<float>(j) / static_cast<float>(cuts)};
        const bool atI = i == 0 || i == cuts, atJ = j == 0 || j == cuts;
        const auto& corners = cage.faces[face];
        if (atI && atJ) {
            const std::uint16_t corner = j == 0 ? corners[i == 0 ? 0 : 1] : corners[i == 0 ? 3 : 2];
            locations_[corner] = location;
            return corner;
        }
        const auto fresh = static_cast<std::uint32_t>(locations_.size());
        if (atI || atJ) {
            auto [from, to, step] = onEdge(corners, i, j, cuts);
            if (from > to) {
                std::swap(from, to);
                step = cuts - step;
            }
            const auto [found, isNew] = edgePoints.try_emplace({from, to, step}, fresh);
            if (!isNew) return found->second;
        }
        locations_.push_back(location);
        return fresh;
    };

    for (std::uint32_t face = 0; face < cage.faces.size(); ++face) {
        for (int j = 0; j <= cuts; ++j) {
            for (int i = 0; i <= cuts; ++i) numbers_.push_back(number(face, i, j));
        }
    }
}

std::uint32_t FaceGrid::at(std::size_t face, int i, int j) const {
    assert(i >= 0);
    assert(i <= cuts_);
    assert(j >= 0);
    assert(j <= cuts_);
    const std::size_t side = static_cast<std::size_t>(cuts_) + 1;
    assert((face + 1) * side * side <= numbers_.size());
    return numbers_[face * side * side + static_cast<std::size_t>(j) * side +
                    static_cast<std::size_t>(i)];
}

SkinPoint skinPoint(const LimitTable& table,
                    std::size_t vertex,
                    std::span<const glm::vec3> controlPoints) {
    assert(vertex + 1 < table.firstEntry.size());
    glm::vec3 position{}, u{}, v{};
    for (std::uint32_t k = table.firstEntry[vertex]; k < table.firstEntry[vertex + 1]; ++k) {
        const StencilEntry& entry = table.entries[k];
        position += entry.position * controlPoints[entry.controlPoint];
        u += entry.tangentU * controlPoints[entry.controlPoint];
        v += entry.tangentV * controlPoints[entry.controlPoint];
    }
    return {position, glm::normalize(glm::cross(u, v))};
}

LimitTable makeLimitTable(const body::FishBody& body, int level) {
    assert(level >= 0);
    assert(level < kSurfaceLevels);
    const FaceGrid grid{body.cage, 1 << level};
    const auto& locations = grid.locations();

    std::vector<std::uint32_t> faceOrder(locations.size());
    for (std::uint32_t i = 0; i < faceOrder.size(); ++i) faceOrder[i] = i;
    std::ranges::stable_sort(faceOrder, {}, [&](std::uint32_t i) { return locations[i].face; });

    const auto refiner = refine(body.cage);
    const auto stencils = limitStencils(*refiner, locations, faceOrder);
    if (!stencils || stencils->GetNumStencils() != static_cast<int>(locations.size()))
        throw Error("OpenSubdiv gives no limit stencils for the cage of " + body.species);

    std::vector<std::vector<StencilEntry>> perVertex(locations.size());
    for (std::size_t k = 0; k < faceOrder.size(); ++k)
        perVertex[faceOrder[k]] = entriesOf(*stencils, k);
    if (level == 0) {
        for (std::uint32_t i = 0; i < perVertex.size(); ++i) holdToControlPoint(perVertex[i], i);
    }

    LimitTable table;
    table.firstEntry.push_back(0);
    for (const auto& entries : perVertex) {
        table.entries.insert(table.entries.end(), entries.begin(), entries.end());
        table.firstEntry.push_back(static_cast<std::uint32_t>(table.entries.size()));
    }
    paintPlaces(body, grid, table);
    append(body, makeAttachments(body, headAtRest(*refiner, body)), table);
    return table;
}

std::vector<std::array<std::uint32_t, 2>> coarserParents(const body::FishBody& body,
                                                         int level,
                                                         const LimitTable& coarser) {
    assert(level >= 1);
    assert(level < kSurfaceLevels);
    const FaceGrid fine{body.cage, 1 << level};
    const FaceGrid coarse{body.cage, 1 << (level - 1)};
    const std::set<Pair> diagonals = diagonalsOf(coarser);
    std::vector<std::array<std::uint32_t, 2>> parents(fine.locations().size());
    const int n = fine.cuts();
    // A vertex with an odd column or row is in the middle of an edge; with both odd it is in the
    // middle of a quad, whose diagonal decides.
    const auto parentsAt = [&](std::size_t face, int i, int j) -> std::array<std::uint32_t, 2> {
        const int di = i % 2, dj = j % 2;
        if (di == 0 || dj == 0)
            return {fine.at(face, i - di, j - dj), fine.at(face, i + di, j + dj)};
        const Pair rising =
            ordered(coarse.at(face, i / 2, j / 2), coarse.at(face, i / 2 + 1, j / 2 + 1));
        if (diagonals.contains(rising))
            return {fine.at(face, i - 1, j - 1), fine.at(face, i + 1, j + 1)};
        return {fine.at(face, i + 1, j - 1), fine.at(face, i - 1, j + 1)};
    };
    for (std::size_t face = 0; face < body.cage.faces.size(); ++face)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) parents[fine.at(face, i, j)] = parentsAt(face, i, j);
    // Attachments are the same at every level.
    for (std::size_t k = coarser.skinVertices; k < coarser.vertices.size(); ++k) {
        const auto own = static_cast<std::uint32_t>(parents.size());
        parents.push_back({own, own});
    }
    return parents;
}

}  // namespace aquarama::skin
