// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/few_triangles.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/cage.h"

namespace aquarama::surface {

namespace {

// Index of a control point.
using Corner = std::uint32_t;
using Triangle = std::array<Corner, 3>;

// Columns of the tube that are kept: back, right side, belly, left side.
constexpr std::array<int, 4> kColumns{0, 3, 6, 10};

// The first control points are those of the tube, ring by ring.
Corner tubeCorner(int ring, int column) {
    return static_cast<Corner>(ring * body::kTubeColumns + column);
}

// Control points at rest along the axes of the body frame. The origin is the cage's own, which does
// not matter here.
std::vector<glm::vec3> atRest(const body::FishBody& body) {
    std::vector<glm::vec3> points;
    for (const body::CageVertex& vertex : body.cage.vertices)
        points.emplace_back(-vertex.rest.x, vertex.rest.y, vertex.rest.z);
    return points;
}

// Height of the straight line between two points, at x.
float heightBetween(glm::vec3 front, glm::vec3 rear, float x) {
    const float length = front.x - rear.x;
    const float share = length > 0.0F ? glm::clamp((front.x - x) / length, 0.0F, 1.0F) : 0.0F;
    return glm::mix(front.y, rear.y, share);
}

// The area of the side view that is lost or gained when only these rings are kept.
float profileError(std::span<const glm::vec3> points, const std::array<int, 4>& rings) {
    float error = 0.0F;
    for (std::size_t k = 0; k + 1 < rings.size(); ++k)
        for (int ring = rings.at(k); ring < rings.at(k + 1); ++ring)
            for (const int column : {kColumns[0], kColumns[2]}) {
                const glm::vec3 here = points[tubeCorner(ring, column)];
                const float kept = heightBetween(points[tubeCorner(rings.at(k), column)],
                                                 points[tubeCorner(rings.at(k + 1), column)],
                                                 here.x);
                error +=
                    std::abs(kept - here.y) * (here.x - points[tubeCorner(ring + 1, column)].x);
            }
    return error;
}

// The four rings with the least error, always with the one around the lips and the last of the
// body. Tries all pairs between them, about 200.
std::array<int, 4> bestRings(std::span<const glm::vec3> points) {
    std::array<int, 4> best{1, 7, 14, body::kBodyEndRing};
    for (int front = 2; front < body::kBodyEndRing - 1; ++front)
        for (int rear = front + 1; rear < body::kBodyEndRing; ++rear) {
            const std::array rings{1, front, rear, body::kBodyEndRing};
            if (profileError(points, rings) < profileError(points, best)) best = rings;
        }
    return best;
}

// A cone from the middle of the upper lip to the first ring, then two triangles for each side of
// each segment.
std::vector<Triangle> bodyTriangles(const std::array<int, 4>& rings) {
    std::vector<Triangle> triangles;
    for (std::size_t j = 0; j < kColumns.size(); ++j) {
        const int here = kColumns.at(j), next = kColumns.at((j + 1) % kColumns.size());
        triangles.push_back(
            {tubeCorner(0, 0), tubeCorner(rings[0], here), tubeCorner(rings[0], next)});
        for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
            const Corner a = tubeCorner(rings.at(k), here), b = tubeCorner(rings.at(k), next);
            const Corner c = tubeCorner(rings.at(k + 1), next),
                         d = tubeCorner(rings.at(k + 1), here);
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        }
    }
    return triangles;
}

// A fin without thickness. A vertex of the fin is placed on it by its row and column in the cage,
// not by distance: otherwise the fin would not fill the sheet.
struct Sheet {
    body::CagePart part = body::CagePart::Body;
    std::vector<Triangle> triangles;
    // Ends of its base, front and rear; for the tail, of its root, from the back down.
    Corner foot = 0, heel = 0;
    // The free edge, in the direction of the base; at least two corners.
    std::vector<Corner> edge;
    // Rings that carry a fin of the midline.
    float firstRing = 0, lastRing = 0;
};

// A point of the free edge; share: 0 at its first corner, 1 at its last.
glm::vec3 alongEdge(const Sheet& sheet, std::span<const glm::vec3> points, float share) {
    assert(sheet.edge.size() >= 2);
    const float at = share * static_cast<float>(sheet.edge.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(at), sheet.edge.size() - 2);
    return glm::mix(points[sheet.edge[before]],
                    points[sheet.edge[before + 1]],
                    at - static_cast<float>(before));
}

// Position of a column between the back (0) and the belly (1), the same on both sides of the tube.
float downTube(int column) {
    const int steps = column == 0 ? 0 : column <= 6 ? column - 1 : body::kTubeColumns - column;
    return static_cast<float>(steps) / 5.0F;
}

// Place of a cage vertex on the sheet: along the base, then outwards to the edge, both as shares.
glm::vec3 placeOnSheet(const Sheet& sheet,
                       const body::CageSite& site,
                       std::span<const glm::vec3> points) {
    const bool isTail = sheet.part == body::CagePart::Caudal;
    const float rings = std::max(sheet.lastRing - sheet.firstRing, 1.0F);
    const float along =
        isTail ? downTube(site.column) : (static_cast<float>(site.ring) - sheet.firstRing) / rings;
    const float outwards = isTail
                               ? static_cast<float>(site.ring - body::kBodyEndRing) /
                                     float{body::kTubeRings - 1 - body::kBodyEndRing}
                               : static_cast<float>(site.level) / static_cast<float>(site.levels);
    const glm::vec3 base = glm::mix(points[sheet.foot], points[sheet.heel], along);
    return glm::mix(base, alongEdge(sheet, points, along), outwards);
}

// The tail: its root is the last ring of the body, its edge runs over the fork.
Sheet tailSheet() {
    constexpr int kEnd = body::kTubeRings - 1;
    const Corner back = tubeCorner(body::kBodyEndRing, 0),
                 belly = tubeCorner(body::kBodyEndRing, 6);
    const Corner upper = tubeCorner(kEnd, 0), lower = tubeCorner(kEnd, 6),
                 fork = tubeCorner(kEnd, 3);
    return {body::CagePart::Caudal,
            {{back, fork, upper}, {back, belly, fork}, {belly, lower, fork}},
            back,
            belly,
            {upper, fork, lower}};
}

// A fin of the midline, from the first to the last ring that carries it, from its base to its edge;
// empty where the species does not have it.
std::optional<Sheet> midlineSheet(body::CagePart part, const std::vector<body::CageSite>& sites) {
    std::optional<std::size_t> front, rear;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const body::CageSite& site = sites[i];
        if (site.kind != body::CageSiteKind::Flap || site.part != part || site.level != site.levels)
            continue;
        if (!front || site.ring < sites[*front].ring) front = i;
        if (!rear || site.ring > sites[*rear].ring) rear = i;
    }
    if (!front) return std::nullopt;
    const Corner topFront = static_cast<Corner>(*front), topRear = static_cast<Corner>(*rear);
    const Corner foot = tubeCorner(sites[*front].ring, sites[*front].column);
    const Corner heel = tubeCorner(sites[*rear].ring, sites[*rear].column);
    return Sheet{part,
                 {{foot, heel, topRear}, {foot, topRear, topFront}},
                 foot,
                 heel,
                 {topFront, topRear},
                 static_cast<float>(sites[*front].ring),
                 static_cast<float>(sites[*rear].ring)};
}

// The point of a triangle that is nearest to `point`, as weights of the corners (barycentric).
glm::vec3 nearestOn(const std::array<glm::vec3, 3>& t, glm::vec3 point) {
    const glm::vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0];
    const float aa = glm::dot(ab, ab), cc = glm::dot(ac, ac), bc = glm::dot(ab, ac);
    const float pb = glm::dot(ap, ab), pc = glm::dot(ap, ac);
    const float determinant = aa * cc - bc * bc;
    if (determinant > 1e-12F) {
        const float v = (cc * pb - bc * pc) / determinant, w = (aa * pc - bc * pb) / determinant;
        if (v >= 0.0F && w >= 0.0F && v + w <= 1.0F) return {1.0F - v - w, v, w};
    }
    // Outside: on the nearest edge.
    glm::vec3 best{1, 0, 0};
    float least = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const glm::vec3 a = t.at(static_cast<std::size_t>(k));
        const glm::vec3 edge = t.at(static_cast<std::size_t>(next)) - a;
        const float squared = glm::dot(edge, edge);
        const float share =
            squared > 0.0F ? glm::clamp(glm::dot(point - a, edge) / squared, 0.0F, 1.0F) : 0.0F;
        const float away = glm::distance(point, a + share * edge);
        if (away >= least) continue;
        least = away;
        best = {};
        best[k] = 1.0F - share;
        best[next] += share;
    }
    return best;
}

// Builds one mesh; used once.
class Maker {
  public:
    Maker(const body::FishBody& body, const skin::LimitTable& controlMesh)
        : body_{body}, mesh_{controlMesh}, points_{atRest(body)} {
        assert(controlMesh.vertices.size() >= points_.size());
        for (std::size_t i = 0; i < controlMesh.vertices.size(); ++i)
            normals_.push_back(skin::skinPoint(controlMesh, i, points_).normal);
    }

    // Triangles first, as the places of the cage refer to them.
    FewTriangles make() {
        const std::vector<body::CageSite> sites = body::makeCageTopology().sites;
        const std::vector<Triangle> body = bodyTriangles(bestRings(points_));
        for (const Triangle& triangle : body) add(outward(triangle), body::CagePart::Body);
        few_.bodyIndices = few_.indices.size();
        std::map<body::CagePart, Sheet> sheets;
        const auto addSheet = [&](const Sheet& sheet) {
            for (const Triangle& triangle : sheet.triangles) add(triangle, sheet.part);
            sheets[sheet.part] = sheet;
        };
        addSheet(tailSheet());
        for (const body::CagePart part :
             {body::CagePart::FirstDorsal, body::CagePart::SecondDorsal, body::CagePart::Anal})
            if (const auto sheet = midlineSheet(part, sites)) addSheet(*sheet);
        for (Corner i = 0; i < mesh_.vertices.size(); ++i) {
            // A vertex of an eye or of a whip, which shrinks into the body.
            if (i >= points_.size()) {
                const glm::vec4 rest = mesh_.vertices[i].rest;
                few_.cage.push_back(
                    placeOn(body::CagePart::Body, body, i, {-rest.x, rest.y, rest.z}));
                continue;
            }
            const auto sheet = sheets.find(body_.cage.vertices[i].part);
            few_.cage.push_back(sheet == sheets.end()
                                    ? placeOn(body::CagePart::Body, body, i, points_[i])
                                    : placeOn(sheet->first,
                                              sheet->second.triangles,
                                              i,
                                              placeOnSheet(sheet->second, sites[i], points_)));
        }
        return std::move(few_);
    }

  private:
    // The triangle with its corners in the order that faces outwards, judged by the normals at
    // rest.
    [[nodiscard]] Triangle outward(const Triangle& t) const {
        const glm::vec3 normal =
            glm::cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
        const glm::vec3 out = normals_[t[0]] + normals_[t[1]] + normals_[t[2]];
        return glm::dot(normal, out) < 0.0F ? Triangle{t[0], t[2], t[1]} : t;
    }

    // The skin of a corner as a part paints it. Where a sheet grows out of the body, the corner
    // belongs to the body and has no place on the fin: it takes that of the nearest corner of the
    // triangle, at the root of its ray.
    [[nodiscard]] skin::SkinPlace placeOf(Corner corner,
                                          body::CagePart part,
                                          const Triangle& triangle) const {
        skin::SkinPlace place = mesh_.vertices[corner];
        place.part = static_cast<std::uint32_t>(part);
        if (part == body::CagePart::Body) place.fin = {};
        if (part == body::CagePart::Body || body_.cage.vertices[corner].fin.y > 0.0F) return place;
        float away = std::numeric_limits<float>::infinity();
        for (const Corner other : triangle) {
            const body::CageVertex& vertex = body_.cage.vertices[other];
            const float distance = glm::distance(points_[other], points_[corner]);
            if (vertex.fin.y <= 0.0F || distance >= away) continue;
            away = distance;
            place.fin = {vertex.fin.x, 0.0F};
        }
        return place;
    }

    // Appends a triangle; a corner that the part already has is shared.
    void add(const Triangle& triangle, body::CagePart part) {
        for (const Corner corner : triangle) {
            const auto [known, isNew] = numbers_.try_emplace(
                {part, corner}, static_cast<std::uint32_t>(few_.vertices.size()));
            if (isNew)
                few_.vertices.push_back(
                    {placeOf(corner, part, triangle), corner, normals_[corner]});
            few_.indices.push_back(known->second);
        }
    }

    // The place on the triangles of a part that is nearest to `wanted`.
    [[nodiscard]] FewTriangles::Place placeOn(body::CagePart part,
                                              std::span<const Triangle> triangles,
                                              Corner corner,
                                              glm::vec3 wanted) const {
        FewTriangles::Place best;
        float least = std::numeric_limits<float>::infinity();
        for (const Triangle& t : triangles) {
            const glm::vec3 weights =
                nearestOn({points_[t[0]], points_[t[1]], points_[t[2]]}, wanted);
            const glm::vec3 place =
                weights.x * points_[t[0]] + weights.y * points_[t[1]] + weights.z * points_[t[2]];
            const float away = glm::distance(place, wanted);
            if (away >= least) continue;
            least = away;
            best = {t,
                    {weights.x, weights.y, weights.z},
                    glm::normalize(weights.x * normals_[t[0]] + weights.y * normals_[t[1]] +
                                   weights.z * normals_[t[2]] + 1e-6F * normals_[corner]),
                    mixed(part, t, weights)};
            // A body's own place on a fin is never read, but fins that grow out of it interpolate
            // from it.
            if (part == body::CagePart::Body) best.place.fin = mesh_.vertices[corner].fin;
        }
        return best;
    }

    // Weighted mean of the skin of three corners.
    [[nodiscard]] skin::SkinPlace mixed(body::CagePart part,
                                        const Triangle& t,
                                        glm::vec3 weights) const {
        skin::SkinPlace place;
        for (int k = 0; k < 3; ++k) {
            const skin::SkinPlace corner = placeOf(t.at(static_cast<std::size_t>(k)), part, t);
            place.rest += weights[k] * corner.rest;
            place.fin += weights[k] * corner.fin;
        }
        return place;
    }

    const body::FishBody& body_;
    const skin::LimitTable& mesh_;
    std::vector<glm::vec3> points_, normals_;
    // Index of the vertex of each part and corner.
    std::map<std::pair<body::CagePart, Corner>, std::uint32_t> numbers_;
    FewTriangles few_;
};

}  // namespace

FewTriangles makeFewTriangles(const body::FishBody& body, const skin::LimitTable& controlMesh) {
    return Maker{body, controlMesh}.make();
}

}  // namespace aquarama::surface
