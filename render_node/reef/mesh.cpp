// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/mesh.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/water/water_tables.h"

namespace aquarama::scene {

namespace {

// Packs numbers into bytes, as SolidVertex has them.
glm::i8vec3 packedNormal(glm::vec3 normal) {
    return glm::i8vec3(glm::round(normal * 127.0F));
}

glm::u8 packedUnit(float x) {
    return static_cast<glm::u8>(glm::round(glm::clamp(x, 0.0F, 1.0F) * 255.0F));
}

// Lexicographic order of places, for sorting.
bool isBefore(glm::vec3 a, glm::vec3 b) {
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace

std::uint32_t addVertex(
    Mesh& mesh, glm::vec3 position, glm::vec3 normal, const Surface& surface, float skyOpenness) {
    SolidVertex vertex;
    vertex.position = position;
    vertex.normal = glm::i8vec4(packedNormal(normal), glm::i8(surface.roughness * 127.0F));
    vertex.albedo = {packedUnit(surface.albedo.r),
                     packedUnit(surface.albedo.g),
                     packedUnit(surface.albedo.b),
                     packedUnit(skyOpenness)};
    vertex.response = {packedUnit(surface.sway),
                       packedUnit(surface.translucency),
                       packedUnit(surface.fluorescence),
                       packedUnit(surface.relief)};
    mesh.vertices.push_back(vertex);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

void joinRows(Mesh& mesh, std::uint32_t first, int rows, int columns) {
    assert(rows > 0 && columns > 0);
    assert(mesh.vertices.size() >=
           first + static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    const auto width = static_cast<std::uint32_t>(columns);
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + static_cast<std::uint32_t>(row) * width +
                                    static_cast<std::uint32_t>(column);
            addQuad(mesh, a, a + width, a + width + 1, a + 1);
        }
}

void turnOver(Mesh& mesh, std::size_t firstIndex) {
    assert(firstIndex % 3 == 0 && mesh.indices.size() % 3 == 0);
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

// Sorts by place, so that equal places are adjacent; the stable sort puts the first of them first.
// O(n log n).
std::vector<std::uint32_t> seamsOf(const Mesh& mesh, std::uint32_t first) {
    assert(first <= mesh.vertices.size());
    const SolidVertex* vertices = mesh.vertices.data() + first;
    std::vector<std::uint32_t> order(mesh.vertices.size() - first);
    std::iota(order.begin(), order.end(), 0U);
    std::vector<std::uint32_t> same = order;
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return isBefore(vertices[a].position, vertices[b].position);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (vertices[order[i]].position == vertices[order[i - 1]].position)
            same[order[i]] = same[order[i - 1]];
    return same;
}

void setSmoothNormals(Mesh& mesh, std::uint32_t first, std::size_t firstIndex) {
    assert(first <= mesh.vertices.size() && firstIndex % 3 == 0);
    std::vector<glm::vec3> sums(mesh.vertices.size() - first, glm::vec3{0.0F});
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const glm::vec3 a = mesh.vertices[corner[0]].position;
        const glm::vec3 area = glm::cross(mesh.vertices[corner[1]].position - a,
                                          mesh.vertices[corner[2]].position - a);
        for (int k = 0; k < 3; ++k) sums[corner[k] - first] += area;
    }
    // Vertices at one place add their sums.
    const std::vector<std::uint32_t> same = seamsOf(mesh, first);
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (same[i] != i) sums[same[i]] += sums[i];
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::vec3 sum = sums[same[i]];
        // The triangles at a pole have no area: it keeps the normal that it was made with.
        if (glm::dot(sum, sum) == 0.0F) continue;
        SolidVertex& vertex = mesh.vertices[first + i];
        vertex.normal = glm::i8vec4(packedNormal(glm::normalize(sum)), vertex.normal.w);
    }
}

namespace {

// Radius of the ball that stands for a rock, relative to the rock's: its surface lies there on
// average.
constexpr float kBodyShare = 0.74F;

}  // namespace

float sunOpenness(std::span<const place::Rock> rocks, glm::vec3 place) {
    const glm::vec3 sun = sunInWater();
    float open = 1.0F;
    for (const place::Rock& rock : rocks) {
        const float radius = rock.radiusMetres * kBodyShare;
        const glm::vec3 away = rock.centre - place;
        const float along = glm::dot(away, sun);
        if (along < 0.0F) continue;
        // Distance of the ray from the ball's centre, in radii. The edge is softer further behind
        // the ball.
        const float miss = glm::length(away - sun * along) / radius;
        const float soft = 0.15F + 0.05F * along;
        open *= glm::smoothstep(1.0F - soft, 1.0F + soft, miss);
    }
    return open;
}

float skyOpenness(std::span<const place::Rock> rocks, glm::vec3 place, glm::vec3 normal) {
    float open = 1.0F;
    for (const place::Rock& rock : rocks) {
        const float radius = rock.radiusMetres * kBodyShare;
        const glm::vec3 away = rock.centre - place;
        const float distance = glm::length(away);
        if (distance > 6.0F * radius) continue;
        const glm::vec3 direction = away / glm::max(distance, 0.01F);
        // A ball hides about (r/d)^2 of a hemisphere, weighted by its direction against the normal.
        const float ratio = glm::min(radius / glm::max(distance, 0.01F), 1.0F);
        const float facing = 0.5F + 0.5F * glm::dot(normal, direction);
        open *= 1.0F - 0.85F * facing * ratio * ratio;
    }
    return open;
}

void shade(Mesh& mesh, std::span<const place::Rock> others) {
    for (SolidVertex& vertex : mesh.vertices) {
        const glm::vec3 normal = glm::vec3(vertex.normal) / 127.0F;
        // A little above the surface, so that it does not shade itself.
        const glm::vec3 place = vertex.position + normal * 0.05F;
        const float sky = skyOpenness(others, place, normal);
        vertex.albedo.w = static_cast<glm::u8>(static_cast<float>(vertex.albedo.w) * sky);
        vertex.response.x = static_cast<glm::u8>(255.0F * sunOpenness(others, place));
    }
}

}  // namespace aquarama::scene
