// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render_node/reef/fade.h"
#include "render_node/reef/strands.h"
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

std::uint32_t addVertex(Mesh& mesh,
                        glm::vec3 position,
                        glm::vec3 normal,
                        const Surface& surface,
                        float ambientOcclusion) {
    SolidVertex vertex;
    vertex.position = position;
    vertex.normal = glm::i8vec4(packedNormal(normal), glm::i8(surface.roughness * 127.0F));
    vertex.albedo = {packedUnit(surface.albedo.r),
                     packedUnit(surface.albedo.g),
                     packedUnit(surface.albedo.b),
                     packedUnit(ambientOcclusion)};
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
    assert(rows > 0);
    assert(columns > 0);
    assert(mesh.vertices.size() >=
           first + static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    const auto width = static_cast<std::uint32_t>(columns);
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + static_cast<std::uint32_t>(row) * width +
                                    static_cast<std::uint32_t>(column);
            addQuad(mesh, a, a + width, a + width + 1, a + 1);
        }
    mesh.patches.push_back({mesh.nextKey++, first, rows, columns});
}

void turnOver(Mesh& mesh, std::size_t firstIndex) {
    assert(firstIndex % 3 == 0);
    assert(mesh.indices.size() % 3 == 0);
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
    assert(first <= mesh.vertices.size());
    assert(firstIndex % 3 == 0);
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

float sunVisibility(std::span<const place::Rock> rocks, glm::vec3 place) {
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

float ambientOcclusion(std::span<const place::Rock> rocks, glm::vec3 place, glm::vec3 normal) {
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
        const float sky = ambientOcclusion(others, place, normal);
        vertex.albedo.w = static_cast<glm::u8>(static_cast<float>(vertex.albedo.w) * sky);
        vertex.response.x = static_cast<glm::u8>(255.0F * sunVisibility(others, place));
    }
}

namespace {

// The sphere is a cube whose faces are grids: cells along an edge at the finest level, and where
// spots for what grows are.
constexpr int kFaces = 6;
constexpr int kFinest = 48;
constexpr int kBedCells = 32;
// By level, the finest vertices from one to the next.
constexpr std::array<int, kLevels> kSteps{1, 2, 4, 8, 16};

// The parameters in which the shapes differ.
struct Habit {
    std::uint32_t seed;
    glm::vec3 stretch;
    // Depth of the ledges, relative to the radius.
    float beds;
    // Number of beds over a height of 1.
    float thick;
    // How much narrower its foot is, relative to the radius.
    float undercut;
    // Height of the lobes.
    float crags;
};

Habit habitOf(int shape) {
    Dice dice{hashOf(0x5eaU, static_cast<std::uint32_t>(shape))};
    Habit habit{};
    habit.seed = dice.seed();
    habit.stretch = {
        dice.between(0.82F, 1.0F), dice.between(0.78F, 1.0F), dice.between(0.82F, 1.0F)};
    habit.beds = dice.between(0.05F, 0.17F);
    habit.thick = dice.between(2.0F, 4.2F);
    habit.undercut = dice.between(0.05F, 0.36F);
    habit.crags = dice.between(0.16F, 0.30F);
    return habit;
}

// Profile of the beds of limestone, 0 to 1: each stands out at its top and recedes below.
float bedAt(const Habit& habit, glm::vec3 place) {
    const float height =
        place.y * habit.thick + 0.7F * solidNoise(habit.seed ^ 3U, place * 1.7F) + 9.0F;
    const float within = height - std::floor(height);
    return glm::smoothstep(0.0F, 0.55F, within) * (1.0F - glm::smoothstep(0.80F, 1.0F, within));
}

// Lobes, as of corals that have grown together: cellular noise, 1 minus the distance to the nearest
// of jittered points. The points stay in the middle half of their cells, so that eight cells are
// enough to search.
float lobes(std::uint32_t seed, glm::vec3 place) {
    const glm::vec3 low = glm::floor(place - 0.5F);
    float nearest2 = 4.0F;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 cell = low + glm::vec3{i % 2, i / 2 % 2, i / 4};
        const glm::ivec3 at{cell};
        std::uint32_t hash = hashOf(seed, static_cast<std::uint32_t>(at.x));
        hash = hashOf(hash, static_cast<std::uint32_t>(at.y));
        hash = hashOf(hash, static_cast<std::uint32_t>(at.z));
        const glm::vec3 jitter{unitOf(hash), unitOf(hashOf(hash)), unitOf(hashOf(hash, 1))};
        const glm::vec3 way = cell + 0.25F + 0.5F * jitter - place;
        nearest2 = std::min(nearest2, glm::dot(way, way));
    }
    return 1.0F - std::sqrt(nearest2);
}

// The point of the surface in a direction: body, then ledges and undercut, then crags, then a
// limit.
glm::vec3 pointTowards(const Habit& habit, glm::vec3 direction) {
    const float body = 0.70F + 0.26F * billows(habit.seed, direction * 1.3F, 2);
    glm::vec3 place = direction * body * habit.stretch;
    const float beds = bedAt(habit, place);
    // Ledges fade towards top and bottom, where the surface is level.
    const float level = 1.0F - 0.8F * direction.y * direction.y;
    const float foot = glm::smoothstep(0.25F, -0.55F, place.y);
    const float wide = 1.0F + habit.beds * (beds - 0.4F) * 2.0F * level - habit.undercut * foot;
    place *= glm::vec3{wide, 1.0F, wide};
    const float crag = habit.crags * (lobes(habit.seed ^ 5U, place * 2.3F) - 0.45F) +
                       0.10F * ridges(habit.seed ^ 7U, place * 3.4F, 3) +
                       0.05F * lobes(habit.seed ^ 6U, place * 6.5F) - 0.05F;
    place += direction * crag;
    constexpr float kMost = 0.985F;
    const float radius = glm::length(place);
    // Beyond a radius of 0.8 the surface is compressed smoothly, so that it stays within the ball
    // without being cut off.
    const float held = radius < 0.8F
                           ? radius
                           : 0.8F + (kMost - 0.8F) * std::tanh((radius - 0.8F) / (kMost - 0.8F));
    return place * (held / radius);
}

// Direction of a point (u, v in -1 to 1) of a face of the cube. The tangent makes the cells nearly
// equal in angle.
glm::vec3 directionOn(int face, float u, float v) {
    const float x = std::tan(u * std::numbers::pi_v<float> / 4.0F);
    const float y = std::tan(v * std::numbers::pi_v<float> / 4.0F);
    switch (face) {
        case 0:
            return glm::normalize(glm::vec3{1, y, -x});
        case 1:
            return glm::normalize(glm::vec3{-1, y, x});
        case 2:
            return glm::normalize(glm::vec3{x, 1, -y});
        case 3:
            return glm::normalize(glm::vec3{x, -1, y});
        case 4:
            return glm::normalize(glm::vec3{x, y, 1});
        default:
            return glm::normalize(glm::vec3{-x, y, -1});
    }
}

// The surface: grids of so many cells a side on the faces of a cube, projected onto the rock.
Mesh skinOf(const Habit& habit, int cells) {
    Mesh mesh;
    for (int face = 0; face < kFaces; ++face) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int row = 0; row <= cells; ++row)
            for (int column = 0; column <= cells; ++column) {
                const auto side = static_cast<float>(cells);
                const glm::vec3 direction =
                    directionOn(face,
                                2.0F * static_cast<float>(column) / side - 1.0F,
                                2.0F * static_cast<float>(row) / side - 1.0F);
                // Rounded, so that the vertices where faces meet are equal bit by bit and seamsOf()
                // finds them.
                const glm::vec3 rounded = glm::round(direction * 65536.0F) / 65536.0F;
                addVertex(mesh, pointTowards(habit, rounded), rounded, {}, 1.0F);
            }
        joinRows(mesh, first, cells + 1, cells + 1);
    }
    turnOver(mesh, 0);
    setSmoothNormals(mesh, 0, 0);
    return mesh;
}

// Replaces the value at each vertex by the mean of those at its neighbours, so many times.
template <class Value>
void smooth(std::vector<Value>& values, const Mesh& mesh, int steps) {
    assert(values.size() == mesh.vertices.size());
    const std::vector<std::uint32_t> same = seamsOf(mesh);
    std::vector<Value> sums(values.size());
    std::vector<float> counts(values.size());
    for (int step = 0; step < steps; ++step) {
        std::ranges::fill(sums, Value{0.0F});
        std::ranges::fill(counts, 0.0F);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            // Each edge counts in both directions; vertices of a seam share one sum.
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = mesh.indices[i + k];
                const std::uint32_t to = mesh.indices[i + (k + 1) % 3];
                sums[same[to]] += values[from];
                sums[same[from]] += values[to];
                ++counts[same[to]];
                ++counts[same[from]];
            }
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = sums[same[i]] / counts[same[i]];
    }
}

std::vector<glm::vec3> placesOf(const Mesh& mesh) {
    std::vector<glm::vec3> places;
    for (const SolidVertex& vertex : mesh.vertices) places.push_back(vertex.position);
    return places;
}

// How far each vertex lies behind the surface, smoothed by this many steps, along its normal:
// positive in hollows. Few steps find cracks, many find caves.
std::vector<float> hollowsOf(const Mesh& mesh, int steps) {
    std::vector<glm::vec3> places = placesOf(mesh);
    smooth(places, mesh, steps);
    std::vector<float> hollows;
    for (std::size_t i = 0; i < places.size(); ++i)
        hollows.push_back(glm::dot(places[i] - mesh.vertices[i].position,
                                   glm::vec3(mesh.vertices[i].normal) / 127.0F));
    return hollows;
}

// The shades of bare rock; the shader adds what grows on it. r: lightness; g: amount of turf; b:
// amount of pink crust, which prefers the shade.
glm::vec3 mottleAt(const Habit& habit, glm::vec3 place, glm::vec3 normal, float hollow) {
    const float patches = solidNoise(habit.seed ^ 0x91U, place * 2.6F);
    const float turf = glm::smoothstep(-0.1F, 0.75F, normal.y + 0.5F * patches);
    const float crust = glm::smoothstep(
        0.05F, 0.45F, solidNoise(habit.seed ^ 0x92U, place * 3.6F) - 0.3F * normal.y);
    const float light = 0.5F + 0.16F * patches - 0.25F * glm::clamp(hollow, 0.0F, 1.0F);
    return {light, turf, crust};
}

// Sets albedo and ambient occlusion of all vertices.
void paint(Mesh& mesh, const Habit& habit) {
    const std::vector<float> cracks = hollowsOf(mesh, 5);
    const std::vector<float> caves = hollowsOf(mesh, 54);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        SolidVertex& vertex = mesh.vertices[i];
        const glm::vec3 normal = glm::normalize(glm::vec3(vertex.normal));
        const float hollow = 14.0F * cracks[i] + 5.0F * caves[i];
        const float open = glm::clamp(1.0F - hollow, 0.12F, 1.0F) *
                           glm::mix(0.35F, 1.0F, glm::smoothstep(-0.9F, 0.5F, normal.y));
        const glm::vec3 mottle =
            glm::clamp(mottleAt(habit, vertex.position, normal, hollow), 0.0F, 1.0F);
        vertex.normal.w = 127;
        vertex.albedo = glm::u8vec4(glm::vec4(mottle, open) * 255.0F + 0.5F);
    }
}

// The finest mesh without what is too fine for a level that has every step-th of its vertices:
// places and shades are means over about a cell of that level.
Mesh smoothedFor(Mesh mesh, int step) {
    const int steps = step * step / 4;
    if (steps == 0) return mesh;
    std::vector<glm::vec3> places = placesOf(mesh);
    std::vector<glm::vec4> shades;
    for (const SolidVertex& vertex : mesh.vertices) shades.emplace_back(vertex.albedo);
    smooth(places, mesh, steps);
    smooth(shades, mesh, steps);
    for (std::size_t i = 0; i < places.size(); ++i) {
        mesh.vertices[i].position = places[i];
        mesh.vertices[i].albedo = glm::u8vec4(shades[i] + 0.5F);
    }
    setSmoothNormals(mesh, 0, 0);
    return mesh;
}

// The mesh with every step-th vertex in both directions of each face; the faces have so many cells
// along an edge.
Mesh thinned(const Mesh& finest, int finestCells, int step) {
    assert(step > 0);
    assert(finestCells % step == 0);
    Mesh mesh;
    const int cells = finestCells / step;
    for (int face = 0; face < kFaces; ++face) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int row = 0; row <= cells; ++row)
            for (int column = 0; column <= cells; ++column)
                mesh.vertices.push_back(finest.vertices[static_cast<std::size_t>(
                    (face * (finestCells + 1) + row * step) * (finestCells + 1) + column * step)]);
        joinRows(mesh, first, cells + 1, cells + 1);
    }
    turnOver(mesh, 0);
    return mesh;
}

}  // namespace

Levels growRock(int shape) {
    assert(shape >= 0);
    assert(shape < kRockShapes);
    const Habit habit = habitOf(shape);
    Mesh finest = skinOf(habit, kFinest);
    paint(finest, habit);
    Levels levels;
    for (std::size_t level = 0; level < kLevels; ++level)
        levels.at(level) =
            thinned(smoothedFor(finest, kSteps.at(level)), kFinest, kSteps.at(level));
    setCoarse(levels);
    return levels;
}

Mesh rockBed(int shape) {
    assert(shape >= 0);
    assert(shape < kRockShapes);
    return thinned(skinOf(habitOf(shape), kBedCells), kBedCells, 2);
}

}  // namespace aquarama::scene
