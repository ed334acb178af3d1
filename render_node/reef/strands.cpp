// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/strands.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "render_node/reef/angles.h"

namespace aquarama::scene {

// Hashes at the corners of the lattice, blended by smoothstep.
float solidNoise(std::uint32_t seed, glm::vec3 place) {
    const glm::vec3 cell = glm::floor(place);
    const glm::vec3 t = place - cell;
    const glm::vec3 s = t * t * (3.0F - 2.0F * t);
    const glm::ivec3 at{cell};
    const auto corner = [&](int x, int y, int z) {
        const std::uint32_t column = hashOf(seed, static_cast<std::uint32_t>(at.x + x));
        const std::uint32_t row = hashOf(column, static_cast<std::uint32_t>(at.y + y));
        return signedUnitOf(hashOf(row, static_cast<std::uint32_t>(at.z + z)));
    };
    const auto plane = [&](int z) {
        return glm::mix(glm::mix(corner(0, 0, z), corner(1, 0, z), s.x),
                        glm::mix(corner(0, 1, z), corner(1, 1, z), s.x),
                        s.y);
    };
    return glm::mix(plane(0), plane(1), s.z);
}

// Each octave is about twice as fine and half as high. The odd factors and offsets keep the
// lattices of the octaves apart.
float billows(std::uint32_t seed, glm::vec3 place, int octaves) {
    float sum = 0.0F;
    float height = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * solidNoise(seed, place);
        place = place * 2.03F + 7.1F;
        height *= 0.5F;
    }
    return sum;
}

float ridges(std::uint32_t seed, glm::vec3 place, int octaves) {
    float sum = 0.0F;
    float height = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * (1.0F - 2.0F * std::abs(solidNoise(seed, place)));
        place = place * 2.1F + 3.7F;
        height *= 0.5F;
    }
    return sum;
}

float resolvedShare(float verticesACell) {
    return glm::smoothstep(0.8F, 1.6F, verticesACell);
}

glm::mat3 frameAbout(glm::vec3 up, float turnRadians) {
    const glm::vec3 away = std::abs(up.y) < 0.99F ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
    const glm::vec3 x = glm::normalize(glm::cross(away, up));
    const glm::vec3 z = glm::cross(x, up);
    const float c = std::cos(turnRadians);
    const float s = std::sin(turnRadians);
    return {x * c + z * s, up, z * c - x * s};
}

namespace {

// Unit tangent of the axis at a joint, by central difference.
glm::vec3 alongAt(std::span<const Joint> joints, std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = i + 1 < joints.size() ? i + 1 : i;
    return glm::normalize(joints[after].centre - joints[before].centre);
}

// The surface with its albedo multiplied.
Surface shaded(Surface surface, float shade) {
    surface.albedo *= shade;
    return surface;
}

// Vertices of a circle for each cell of a noise that has so many of them on its radius.
float verticesACell(int around, float cells) {
    return static_cast<float>(around) / (kTwoPi * cells);
}

}  // namespace

float waverAt(const Turning& turning, glm::vec3 out) {
    float sum = 0.0F;
    for (const auto& [height, finer] : {std::pair{1.0F, 1.0F}, {0.5F, 2.7F}, {0.3F, 7.1F}}) {
        const float cells = turning.lobes * finer;
        sum += height * resolvedShare(verticesACell(turning.around, cells)) *
               solidNoise(turning.seed, out * cells);
    }
    return sum;
}

void addStrand(Mesh& mesh, std::span<const Joint> joints, int sides, glm::vec3 facing) {
    assert(joints.size() >= 2);
    assert((sides == 0 || sides >= 3));
    if (sides == 0) {
        const glm::vec3 across = glm::cross(joints.back().centre - joints.front().centre, facing);
        const float width = glm::length(across);
        addLeaf(mesh, joints, {.side = width > 1.0e-5F ? across / width : glm::vec3{1, 0, 0}});
        return;
    }
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const glm::mat3 frame = frameAbout(alongAt(joints, i), 0.0F);
        // The last vertex of a ring repeats the first, as joinRows() needs.
        for (int side = 0; side <= sides; ++side) {
            const float turn =
                kTwoPi * static_cast<float>(side % sides) / static_cast<float>(sides);
            const glm::vec3 outward = frame[0] * std::cos(turn) + frame[2] * std::sin(turn);
            addVertex(mesh,
                      joints[i].centre + outward * joints[i].radius,
                      outward,
                      joints[i].surface,
                      joints[i].ambientOcclusion);
        }
    }
    joinRows(mesh, first, static_cast<int>(joints.size()), sides + 1);
}

void addLeaf(Mesh& mesh, std::span<const Joint> joints, const Leaf& leaf) {
    assert(joints.size() >= 2);
    // A ruffled leaf has three vertices across, others two.
    const bool ribbed = leaf.ruffle > 0.0F;
    static constexpr std::array kEdges{-1.0F, 1.0F};
    static constexpr std::array kRibbed{-1.0F, 0.0F, 1.0F};
    const std::span<const float> edges = ribbed ? std::span<const float>{kRibbed} : kEdges;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Joint& joint = joints[i];
        const float v = static_cast<float>(i) / static_cast<float>(joints.size() - 1);
        const glm::vec3 normal = glm::normalize(glm::cross(leaf.side, alongAt(joints, i)));
        for (const float edge : edges) {
            const float wave = leaf.ruffle * joint.radius * edge *
                               std::sin(leaf.waves * v + leaf.phase + 1.3F * edge);
            addVertex(mesh,
                      joint.centre + leaf.side * (edge * joint.radius) + normal * wave,
                      glm::normalize(normal + leaf.side * (0.45F * edge)),
                      shaded(joint.surface, edge == 0.0F && ribbed ? 0.72F : 1.0F),
                      joint.ambientOcclusion);
        }
    }
    joinRows(mesh, first, static_cast<int>(joints.size()), static_cast<int>(edges.size()));
}

void addTurned(Mesh& mesh,
               std::span<const Ring> rings,
               const Turning& turning,
               const Surface& surface) {
    assert(rings.size() >= 2);
    assert(turning.around >= 3);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::size_t firstIndex = mesh.indices.size();
    const glm::mat3 frame = frameAbout(turning.up, 0.0F);
    for (const Ring& ring : rings)
        for (int i = 0; i <= turning.around; ++i) {
            const float turn = kTwoPi * static_cast<float>(i % turning.around) /
                               static_cast<float>(turning.around);
            const glm::vec3 out{std::cos(turn), 0.0F, std::sin(turn)};
            const glm::vec3 at = out * turning.lobes;
            const float waver = waverAt(turning, out);
            const float lift = solidNoise(turning.seed ^ 1U, at * 1.4F);
            const float radius = ring.radius * (1.0F + turning.wide * waver * ring.waver);
            const float height = ring.height + turning.high * lift * ring.waver;
            addVertex(mesh,
                      turning.centre + frame * glm::vec3{out.x * radius, height, out.z * radius},
                      turning.up,
                      shaded(surface, ring.shade),
                      ring.ambientOcclusion);
        }
    joinRows(mesh, first, static_cast<int>(rings.size()), turning.around + 1);
    setSmoothNormals(mesh, first, firstIndex);
}

void addBall(Mesh& mesh, const Ball& ball, const Surface& surface) {
    assert(ball.rings >= 1);
    assert(ball.around >= 3);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::size_t firstIndex = mesh.indices.size();
    const float lumps =
        ball.lumps * resolvedShare(verticesACell(ball.around, std::max(ball.cells, 1.0F)));
    // From the lower rim up to the top, as addTurned() from foot to crown.
    for (int ring = ball.rings; ring >= 0; --ring)
        for (int i = 0; i <= ball.around; ++i) {
            const float polar =
                ball.capRadians * static_cast<float>(ring) / static_cast<float>(ball.rings);
            const float turn =
                kTwoPi * static_cast<float>(i % ball.around) / static_cast<float>(ball.around);
            const glm::vec3 out{std::sin(polar) * std::cos(turn),
                                std::cos(polar),
                                std::sin(polar) * std::sin(turn)};
            const float lump = lumps * solidNoise(ball.seed, out * ball.cells);
            addVertex(mesh,
                      ball.centre + out * ball.radii * (1.0F + lump),
                      out,
                      shaded(surface,
                             1.0F + 1.6F * lump + 0.16F * solidNoise(ball.seed ^ 3U, out * 5.0F)),
                      glm::mix(0.35F, 1.0F, glm::smoothstep(-0.6F, 0.5F, out.y)));
        }
    joinRows(mesh, first, ball.rings + 1, ball.around + 1);
    setSmoothNormals(mesh, first, firstIndex);
}

}  // namespace aquarama::scene
