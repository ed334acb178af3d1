// SPDX-License-Identifier: Apache-2.0
#include "common/skin/skin_places.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::skin {

namespace {

using Face = std::array<std::uint16_t, 4>;

bool onFin(const body::CageVertex& vertex) {
    return vertex.fin.y > 0.0F;
}

body::CagePart partOf(const body::ControlCage& cage, const Face& face) {
    for (const std::uint16_t corner : face) {
        if (onFin(cage.vertices[corner])) return cage.vertices[corner].part;
    }
    return body::CagePart::Body;
}

// (p, q) at the corners of a fin's face. Where a fin grows out of the body, the corner is the
// body's and knows no p: it takes that of the ray which starts there.
std::array<glm::vec2, 4> finCorners(const body::ControlCage& cage, const Face& face) {
    std::array<glm::vec2, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        const body::CageVertex& own = cage.vertices[face[k]];
        const body::CageVertex& next = cage.vertices[face[(k + 1) % 4]];
        const body::CageVertex& previous = cage.vertices[face[(k + 3) % 4]];
        corners[k] = own.fin;
        if (onFin(own)) continue;
        if (onFin(next)) corners[k] = {next.fin.x, 0.0F};
        if (onFin(previous)) corners[k] = {previous.fin.x, 0.0F};
    }
    return corners;
}

float tableAt(const std::vector<float>& x, const std::vector<float>& y, float at) {
    const auto above = std::ranges::upper_bound(x, at);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - x.begin());
    return glm::mix(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

glm::vec4 restOf(const body::FishBody& body, const LimitTable& table, std::size_t vertex) {
    glm::vec3 rest{};
    for (std::uint32_t k = table.firstEntry[vertex]; k < table.firstEntry[vertex + 1]; ++k) {
        const StencilEntry& entry = table.entries[k];
        rest += entry.position * body.cage.vertices[entry.controlPoint].rest;
    }
    return {rest, heightOnBody(body, rest.x, rest.y)};
}

void placeFinVertices(const body::ControlCage& cage, const FaceGrid& grid, LimitTable& table) {
    const int n = grid.cuts();
    for (std::size_t f = 0; f < cage.faces.size(); ++f) {
        const body::CagePart part = partOf(cage, cage.faces[f]);
        if (part == body::CagePart::Body) continue;
        const auto corners = finCorners(cage, cage.faces[f]);
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                SkinPlace& place = table.vertices[grid.at(f, i, j)];
                const float u = static_cast<float>(i) / static_cast<float>(n);
                const float v = static_cast<float>(j) / static_cast<float>(n);
                place.fin = glm::mix(
                    glm::mix(corners[0], corners[1], u), glm::mix(corners[3], corners[2], u), v);
                const bool isInside = i > 0 && i < n && j > 0 && j < n;
                if (isInside || (n == 1 && place.fin.y > 0.0F))
                    place.part = static_cast<std::uint32_t>(part);
            }
        }
    }
}

// A quad's part is told by the last vertex of its triangles (GL's provoking vertex), which
// therefore must be the face's own: inside it, or on level 0 the corner that is furthest out.
std::size_t provokingCorner(const LimitTable& table,
                            const std::array<std::uint32_t, 4>& quad,
                            const std::array<bool, 4>& isInside) {
    std::size_t best = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (isInside[k]) return k;
        if (table.vertices[quad[k]].fin.y > table.vertices[quad[best]].fin.y) best = k;
    }
    return best;
}

void addTriangles(const FaceGrid& grid,
                  std::size_t face,
                  const LimitTable& table,
                  std::vector<std::uint32_t>& indices) {
    const int n = grid.cuts();
    const auto inside = [n](int i, int j) { return i > 0 && i < n && j > 0 && j < n; };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const std::array quad{grid.at(face, i, j),
                                  grid.at(face, i + 1, j),
                                  grid.at(face, i + 1, j + 1),
                                  grid.at(face, i, j + 1)};
            const std::size_t last = provokingCorner(
                table,
                quad,
                {inside(i, j), inside(i + 1, j), inside(i + 1, j + 1), inside(i, j + 1)});
            for (const std::size_t first : {last + 1, last + 2})
                indices.insert(indices.end(), {quad[first % 4], quad[(first + 1) % 4], quad[last]});
        }
    }
}

}  // namespace

float heightOnBody(const body::FishBody& body, float s, float y) {
    const auto& halfHeight = y >= 0.0F ? body.profileDorsal : body.profileVentral;
    return glm::clamp(
        y / std::max(tableAt(body.profileStations, halfHeight, s), 1e-3F), -1.0F, 1.0F);
}

void paintPlaces(const body::FishBody& body, const FaceGrid& grid, LimitTable& table) {
    table.vertices.resize(grid.locations().size());
    for (std::size_t i = 0; i < table.vertices.size(); ++i)
        table.vertices[i].rest = restOf(body, table, i);
    placeFinVertices(body.cage, grid, table);

    std::vector<std::uint32_t> fins;
    for (std::size_t f = 0; f < body.cage.faces.size(); ++f) {
        const bool isBody = partOf(body.cage, body.cage.faces[f]) == body::CagePart::Body;
        addTriangles(grid, f, table, isBody ? table.indices : fins);
    }
    table.bodyIndices = table.indices.size();
    table.indices.insert(table.indices.end(), fins.begin(), fins.end());
}

}  // namespace aquarama::skin
