// SPDX-License-Identifier: Apache-2.0
#include "common/skin/attachments.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "common/body/cage.h"

namespace aquarama::skin {

namespace {

std::uint32_t tubePoint(int ring, int column) {
    return static_cast<std::uint32_t>(ring * body::kTubeColumns + column);
}

// The ring whose flank is nearest to a station; neither the last of the body nor the lips nor the
// ring around them, so it has two neighbours that no jaw moves.
int ringNear(const body::ControlCage& cage, float station) {
    constexpr int kFlank = 3;
    int nearest = 2;
    const auto distance = [&](int ring) {
        return std::abs(cage.vertices[tubePoint(ring, kFlank)].rest.x - station);
    };
    for (int ring = nearest + 1; ring < body::kBodyEndRing; ++ring)
        if (distance(ring) < distance(nearest)) nearest = ring;
    return nearest;
}

// The mesh of an eye: vertices on each of its rings.
constexpr std::size_t kSpokes = 16;
// Radii of its rings, in radii of the eye; the last lies under the skin.
constexpr std::array kEyeRings{0.38F, 0.70F, 0.94F, 1.12F};
// How deep the last ring lies under the skin, in radii of the eye.
constexpr float kSunk = 0.10F;
// How far the middle of an eye follows the curve of the head (1) instead of a plane (0).
constexpr float kDraped = 0.55F;
// The mesh of a thread.
constexpr std::size_t kSides = 4;
// Its half thickness across the body: a share of its half width, with an upper limit in body
// lengths.
constexpr float kThreadDepth = 0.3F;
constexpr float kMostThreadDepth = 0.003F;
// No thread is bound behind this station: a whip trails behind the middle of the body and does not
// swing with the tail.
constexpr float kLastBinding = 0.6F;

// Adds the weights of a binding, times a factor, to one component (position or tangent) of a
// vertex's entries; a control point has one entry.
void add(std::vector<StencilEntry>& entries,
         const RestBinding& binding,
         const RestBinding::Weights& weights,
         float StencilEntry::*component,
         float factor = 1) {
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t point = binding.points().at(k);
        const auto found = std::ranges::find(entries, point, &StencilEntry::controlPoint);
        StencilEntry& entry = found != entries.end()
                                  ? *found
                                  : entries.emplace_back(StencilEntry{.controlPoint = point});
        entry.*component += factor * weights.at(k);
    }
}

// A vertex with two tangents. The cross product u x v has to point outwards in the body frame,
// whose x axis runs against s.
Attachments::Vertex vertexAt(const RestBinding& binding, glm::vec3 rest, glm::vec3 u, glm::vec3 v) {
    Attachments::Vertex vertex;
    add(vertex.entries, binding, binding.ofPlace(rest), &StencilEntry::position);
    add(vertex.entries, binding, binding.ofDirection(u), &StencilEntry::tangentU);
    add(vertex.entries, binding, binding.ofDirection(v), &StencilEntry::tangentV);
    vertex.place.rest = {rest, 0};
    return vertex;
}

// Two triangles of a quad, with its orientation.
void addQuad(std::vector<std::array<std::uint32_t, 3>>& triangles,
             const std::array<std::size_t, 4>& quad) {
    const auto number = [&](std::size_t k) { return static_cast<std::uint32_t>(quad.at(k)); };
    triangles.push_back({number(0), number(1), number(2)});
    triangles.push_back({number(0), number(2), number(3)});
}

// How far from the middle plane the skin is at (s, y); -1 where no triangle covers the point.
// Searches all triangles.
float skinAt(std::span<const RestTriangle> skin, glm::vec2 at) {
    float out = -1;
    for (const RestTriangle& t : skin) {
        const glm::vec2 a(t[0]), b(t[1]), c(t[2]);
        const auto area = [](glm::vec2 p, glm::vec2 q) { return p.x * q.y - p.y * q.x; };
        const float whole = area(b - a, c - a);
        if (std::abs(whole) < 1e-12F) continue;
        const float v = area(at - a, c - a) / whole, w = area(b - a, at - a) / whole;
        if (v < -1e-4F || w < -1e-4F || v + w > 1 + 1e-4F) continue;
        out = std::max(out, (1 - v - w) * t[0].z + v * t[1].z + w * t[2].z);
    }
    return out;
}

// The surface of the right eye: its z as a function of a place (tailwards, up) relative to its
// middle, in radii of the eye. The sum of the head's skin, flattened, and a dome.
class Ball {
  public:
    Ball(const body::FishBody& body, std::span<const RestTriangle> head)
        : eye_(body.face.eye), bulge_(body.eyeBulge), head_(head) {
        constexpr float kStep = 0.5F;
        middle_ = skin({0, 0});
        slope_ = {(skin({kStep, 0}) - skin({-kStep, 0})) / (2 * kStep),
                  (skin({0, kStep}) - skin({0, -kStep})) / (2 * kStep)};
    }

    [[nodiscard]] glm::vec3 at(glm::vec2 radii) const {
        const float rho = glm::length(radii);
        const float flat = middle_ + glm::dot(slope_, radii);
        const float drape =
            glm::mix(flat, skin(radii), glm::mix(kDraped, 1.0F, std::min(rho, 1.0F)));
        const float dome = std::pow(std::max(1 - rho * rho, 0.0F), 0.6F) * bulge_;
        const float sunk = kSunk * glm::smoothstep(0.96F, 1.12F, rho);
        return {
            eye_.x + radii.x * eye_.z, eye_.y + radii.y * eye_.z, drape + (dome - sunk) * eye_.z};
    }

  private:
    [[nodiscard]] float skin(glm::vec2 radii) const {
        return skinAt(head_, glm::vec2(eye_) + radii * eye_.z);
    }
    glm::vec3 eye_;
    float bulge_;
    std::span<const RestTriangle> head_;
    float middle_ = 0;
    glm::vec2 slope_{};
};

// side: 1 right, -1 left, mirrored. Tangents by central differences.
Attachments::Vertex eyeVertex(const Ball& ball,
                              const RestBinding& binding,
                              glm::vec2 at,
                              float side) {
    constexpr float kStep = 0.04F;
    const glm::vec3 mirror(1, 1, side);
    const glm::vec3 tailwards =
        (ball.at(at + glm::vec2(kStep, 0)) - ball.at(at - glm::vec2(kStep, 0)));
    const glm::vec3 upwards =
        (ball.at(at + glm::vec2(0, kStep)) - ball.at(at - glm::vec2(0, kStep)));
    // On the right side "up" x "tailwards" points outwards, since tailwards is -x; on the left side
    // the order is reversed.
    const glm::vec3 u = mirror * (side > 0 ? upwards : tailwards);
    const glm::vec3 v = mirror * (side > 0 ? tailwards : upwards);
    Attachments::Vertex vertex = vertexAt(binding, mirror * ball.at(at), u, v);
    vertex.place.fin = at;
    vertex.place.part = static_cast<std::uint32_t>(body::CagePart::Eye);
    return vertex;
}

// A disc of rings and spokes around a middle vertex.
void addEye(const body::FishBody& body, const Ball& ball, float side, Attachments& attachments) {
    const RestBinding binding(body.cage, body.face.eye.x);
    const std::size_t middle = attachments.vertices.size();
    attachments.vertices.push_back(eyeVertex(ball, binding, {0, 0}, side));
    for (const float rho : kEyeRings)
        for (std::size_t k = 0; k < kSpokes; ++k) {
            const float angle =
                glm::two_pi<float>() * static_cast<float>(k) / static_cast<float>(kSpokes);
            const glm::vec2 at = rho * glm::vec2(std::cos(angle), std::sin(angle));
            attachments.vertices.push_back(eyeVertex(ball, binding, at, side));
        }
    const auto on = [&](std::size_t ring, std::size_t k) {
        return middle + 1 + ring * kSpokes + k % kSpokes;
    };
    // Spokes are numbered from tailwards to upwards, clockwise as seen from the right.
    for (std::size_t k = 0; k < kSpokes; ++k) {
        const std::size_t here = side > 0 ? k + 1 : k, next = side > 0 ? k : k + 1;
        attachments.onBody.push_back({static_cast<std::uint32_t>(on(0, here)),
                                      static_cast<std::uint32_t>(on(0, next)),
                                      static_cast<std::uint32_t>(middle)});
        for (std::size_t ring = 0; ring + 1 < kEyeRings.size(); ++ring)
            addQuad(attachments.onBody,
                    {on(ring + 1, here), on(ring + 1, next), on(ring, next), on(ring, here)});
    }
}

// The right vertices of the margin of the first dorsal fin, from front to rear.
std::vector<std::uint32_t> marginOf(const body::FishBody& body) {
    const auto& vertices = body.cage.vertices;
    std::vector<std::uint32_t> margin;
    for (std::uint32_t i = 0; i < vertices.size(); ++i)
        if (vertices[i].part == body::CagePart::FirstDorsal && vertices[i].fin.y == 1 &&
            vertices[i].rest.z > 0)
            margin.push_back(i);
    std::ranges::sort(margin, {}, [&](std::uint32_t i) { return vertices[i].fin.x; });
    return margin;
}

// Adds the ripple of the first dorsal fin's margin at p to a vertex of a whip: the difference of
// the margin's control points from where the body alone would take them.
void addRipple(const body::FishBody& body,
               float p,
               float gain,
               std::vector<StencilEntry>& entries) {
    const std::vector<std::uint32_t> margin = marginOf(body);
    const auto rayOf = [&](std::size_t k) { return body.cage.vertices[margin[k]].fin.x; };
    std::size_t k = 0;
    while (k + 2 < margin.size() && rayOf(k + 1) < p) ++k;
    const float between = std::max(rayOf(k + 1) - rayOf(k), 1e-3F);
    const float share = std::clamp((p - rayOf(k)) / between, 0.0F, 1.0F);
    for (const auto& [point, weight] :
         {std::pair{margin[k], gain * (1 - share)}, std::pair{margin[k + 1], gain * share}}) {
        const glm::vec3 rest = body.cage.vertices[point].rest;
        const RestBinding binding(body.cage, rest.x);
        add(entries, binding, binding.ofPlace(rest), &StencilEntry::position, -weight);
        entries.push_back({.controlPoint = point, .position = weight});
    }
}

// A point of the Catmull-Rom curve through the points (Catmull & Rom 1974), share from 0 to 1.
// Beyond its ends the curve is extended in a straight line.
glm::vec2 along(const std::vector<glm::vec2>& points, float share) {
    const float at = share * static_cast<float>(points.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(at), points.size() - 2);
    const float t = at - static_cast<float>(k);
    const glm::vec2 b = points[k], c = points[k + 1];
    const glm::vec2 a = k == 0 ? 2.0F * b - c : points[k - 1];
    const glm::vec2 d = k + 2 == points.size() ? 2.0F * c - b : points[k + 2];
    return 0.5F * (2.0F * b + (c - a) * t + (2.0F * a - 5.0F * b + 4.0F * c - d) * (t * t) +
                   (3.0F * b - 3.0F * c + d - a) * (t * t * t));
}

// The p of the margin vertex of the first dorsal fin that is nearest to the root of a thread.
float dorsalRayOf(const body::FishBody& body, glm::vec2 root) {
    float best = 1e9F, p = 0;
    for (const body::CageVertex& vertex : body.cage.vertices) {
        if (vertex.part != body::CagePart::FirstDorsal || vertex.fin.y < 1) continue;
        const float distance = glm::distance(glm::vec2(vertex.rest), root);
        if (distance >= best) continue;
        best = distance;
        p = vertex.fin.x;
    }
    return p;
}

// A tube of kSides sides along the thread. Each place is bound to the station halfway between the
// thread's root and its own, so the thread swings less than the body there. A thread of the first
// dorsal fin also passes on that fin's ripple, more so towards its tip.
void addThread(const body::FishBody& body,
               const body::BodyThread& thread,
               Attachments& attachments) {
    const std::size_t steps = threadSteps(thread);
    const std::size_t first = attachments.vertices.size();
    const float ray = dorsalRayOf(body, thread.at.front());
    for (std::size_t i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(steps);
        const glm::vec2 at = along(thread.at, share);
        const glm::vec2 ahead = along(thread.at, std::min(share + 0.05F, 1.0F)) -
                                along(thread.at, std::max(share - 0.05F, 0.0F));
        const glm::vec2 run = glm::normalize(ahead);
        const float width = 0.5F * glm::mix(thread.rootWidth, thread.tipWidth, share);
        const float depth = std::min(kThreadDepth * width, kMostThreadDepth);
        const float station = std::min(glm::mix(thread.at.front().x, at.x, 0.5F), kLastBinding);
        const RestBinding binding(body.cage, station);
        for (std::size_t k = 0; k < kSides; ++k) {
            constexpr std::array<glm::vec2, kSides> kRound{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
            const auto round = [&](glm::vec2 r, float w, float d) {
                return glm::vec3(-run.y * r.x * w, run.x * r.x * w, r.y * d);
            };
            const glm::vec2 r = kRound.at(k);
            const glm::vec3 rest = glm::vec3(at, 0) + round(r, width, depth);
            // About the thread, then along it, turn outwards: s runs against x.
            const glm::vec3 about = round({-r.y, r.x}, 1, 1);
            Attachments::Vertex vertex =
                vertexAt(binding, rest, 0.01F * glm::vec3(run, 0), 0.01F * about);
            if (thread.isOfFirstDorsal) {
                const float wave = std::min(ray + 0.5F * share, 1.0F);
                addRipple(body, wave, 1 + share, vertex.entries);
                vertex.place.part = static_cast<std::uint32_t>(body::CagePart::FirstDorsal);
                vertex.place.fin = {ray, 1};
            }
            attachments.vertices.push_back(std::move(vertex));
        }
    }
    auto& triangles = thread.isOfFirstDorsal ? attachments.onFins : attachments.onBody;
    const auto on = [&](std::size_t i, std::size_t k) { return first + i * kSides + k % kSides; };
    for (std::size_t i = 0; i < steps; ++i)
        for (std::size_t k = 0; k < kSides; ++k)
            addQuad(triangles, {on(i, k), on(i, k + 1), on(i + 1, k + 1), on(i + 1, k)});
}

using Face = std::array<std::uint16_t, 4>;

// Whether a vertex lies off the base of a fin; vertices of the base count as the body's.
bool onFin(const body::CageVertex& vertex) {
    return vertex.fin.y > 0.0F;
}

// The fin to which any of its corners belongs, else the body.
body::CagePart partOf(const body::ControlCage& cage, const Face& face) {
    for (const std::uint16_t corner : face) {
        if (onFin(cage.vertices[corner])) return cage.vertices[corner].part;
    }
    return body::CagePart::Body;
}

// (p, q) at the corners of a fin's face. Where a fin grows out of the body, the corner is the
// body's and has no p: it takes that of the ray that starts there.
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

// Linear between the points of a table; outside of it the value of the nearest end.
float tableAt(const std::vector<float>& x, const std::vector<float>& y, float at) {
    const auto above = std::ranges::upper_bound(x, at);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - x.begin());
    return glm::mix(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

// The rest position of a vertex by its stencil, and its height on the body.
glm::vec4 restOf(const body::FishBody& body, const LimitTable& table, std::size_t vertex) {
    glm::vec3 rest{};
    for (std::uint32_t k = table.firstEntry[vertex]; k < table.firstEntry[vertex + 1]; ++k) {
        const StencilEntry& entry = table.entries[k];
        rest += entry.position * body.cage.vertices[entry.controlPoint].rest;
    }
    return {rest, heightOnBody(body, rest.x, rest.y)};
}

// Fin coordinates and parts of the vertices on fins. A vertex on the border of a face may belong to
// two parts: only inner vertices, or on level 0 those off the base, get the part of the face.
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

// The mouth coordinate of the vertices on and in the lips, in the place of q.
void placeMouthVertices(const body::ControlCage& cage, const FaceGrid& grid, LimitTable& table) {
    const int n = grid.cuts();
    for (std::size_t f = 0; f < cage.faces.size(); ++f) {
        const auto mouthAt = [&](std::size_t corner) {
            return cage.vertices[cage.faces[f].at(corner)].mouth;
        };
        if (mouthAt(0) + mouthAt(1) + mouthAt(2) + mouthAt(3) == 0) continue;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const float u = static_cast<float>(i) / static_cast<float>(n);
                const float v = static_cast<float>(j) / static_cast<float>(n);
                table.vertices[grid.at(f, i, j)].fin = {
                    0,
                    glm::mix(glm::mix(mouthAt(0), mouthAt(1), u),
                             glm::mix(mouthAt(3), mouthAt(2), u),
                             v)};
            }
    }
}

// The flat part of a triangle is that of its last vertex (GL's provoking vertex). It therefore must
// belong to this face alone: a vertex inside of it, or on level 0 the corner that is furthest out
// on the fin.
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

// Two triangles for each piece of a face, both with the provoking corner last.
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

// The four points: both flanks a ring before, back and belly a ring behind. They are never in one
// plane, so the matrix has an inverse.
RestBinding::RestBinding(const body::ControlCage& cage, float station) {
    assert(cage.vertices.size() == body::kControlPoints);
    const int ring = ringNear(cage, station);
    points_ = {tubePoint(ring - 1, 3),
               tubePoint(ring - 1, 10),
               tubePoint(ring + 1, 0),
               tubePoint(ring + 1, 6)};
    glm::mat4 restFromWeights{1.0F};
    for (int k = 0; k < 4; ++k)
        restFromWeights[k] =
            glm::vec4(cage.vertices[points_.at(static_cast<std::size_t>(k))].rest, 1);
    weightsFromRest_ = glm::inverse(restFromWeights);
}

RestBinding::Weights RestBinding::ofPlace(glm::vec3 rest) const {
    const glm::vec4 w = weightsFromRest_ * glm::vec4(rest, 1);
    return {w.x, w.y, w.z, w.w};
}

RestBinding::Weights RestBinding::ofDirection(glm::vec3 direction) const {
    const glm::vec4 w = weightsFromRest_ * glm::vec4(direction, 0);
    return {w.x, w.y, w.z, w.w};
}

std::size_t threadSteps(const body::BodyThread& thread) {
    assert(thread.at.size() >= 2);
    return 2 * (thread.at.size() - 1);
}

Attachments makeAttachments(const body::FishBody& body, std::span<const RestTriangle> head) {
    Attachments attachments;
    const Ball ball(body, head);
    for (const float side : {1.0F, -1.0F}) addEye(body, ball, side, attachments);
    for (const body::BodyThread& thread : body.threads) addThread(body, thread, attachments);
    return attachments;
}

float heightOnBody(const body::FishBody& body, float s, float y) {
    const auto& halfHeight = y >= 0.0F ? body.profileDorsal : body.profileVentral;
    return glm::clamp(
        y / std::max(tableAt(body.profileStations, halfHeight, s), 1e-3F), -1.0F, 1.0F);
}

void paintPlaces(const body::FishBody& body, const FaceGrid& grid, LimitTable& table) {
    assert(table.firstEntry.size() == grid.locations().size() + 1);
    table.vertices.resize(grid.locations().size());
    for (std::size_t i = 0; i < table.vertices.size(); ++i)
        table.vertices[i].rest = restOf(body, table, i);
    placeFinVertices(body.cage, grid, table);
    placeMouthVertices(body.cage, grid, table);

    std::vector<std::uint32_t> fins;
    for (std::size_t f = 0; f < body.cage.faces.size(); ++f) {
        const bool isBody = partOf(body.cage, body.cage.faces[f]) == body::CagePart::Body;
        addTriangles(grid, f, table, isBody ? table.indices : fins);
    }
    table.bodyIndices = table.indices.size();
    table.indices.insert(table.indices.end(), fins.begin(), fins.end());
}

}  // namespace aquarama::skin
