// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/rock_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/scene/solid_noise.h"

namespace aquarama {

namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

// Distance from the centre in a direction, metres: ridged crags on a squat body, flat where the
// sea has worn its top.
float radiusTowards(const Rock& rock, glm::vec3 direction) {
    const glm::vec3 place = direction * 1.35F;
    const float crags = ridges(rock.seed, place, 5);
    const float lumps = billows(rock.seed ^ 0x51U, direction * 3.3F, 3);
    const float share = 0.58F + 0.34F * crags + 0.26F * lumps;
    const float squat = direction.y > 0.0F ? 1.0F - 0.22F * direction.y * direction.y : 1.0F;
    return rock.radiusMetres * glm::clamp(share, 0.35F, 1.0F) * squat;
}

glm::vec3 pointTowards(const Rock& rock, glm::vec3 direction) {
    return rock.centre + direction * radiusTowards(rock, direction);
}

glm::vec3 normalTowards(const Rock& rock, glm::vec3 direction) {
    constexpr float kStep = 0.03F;
    const glm::mat3 frame = frameAbout(direction, 0.0F);
    const glm::vec3 right = pointTowards(rock, glm::normalize(direction + frame[0] * kStep));
    const glm::vec3 ahead = pointTowards(rock, glm::normalize(direction + frame[2] * kStep));
    const glm::vec3 here = pointTowards(rock, direction);
    const glm::vec3 normal = glm::normalize(glm::cross(right - here, ahead - here));
    return glm::dot(normal, direction) < 0.0F ? -normal : normal;
}

// Turf of algae on what looks up, encrusting pinks and ochres in patches, dark hollows.
glm::vec3 crustAt(const Rock& rock, glm::vec3 place, glm::vec3 direction) {
    const glm::vec3 stone{0.26F, 0.235F, 0.20F};
    const glm::vec3 turf{0.22F, 0.25F, 0.09F};
    const glm::vec3 pink{0.62F, 0.25F, 0.32F};
    const glm::vec3 ochre{0.60F, 0.36F, 0.11F};
    const float patchA = solidNoise(rock.seed ^ 0x91U, place * 1.9F);
    const float patchB = solidNoise(rock.seed ^ 0x92U, place * 2.6F);
    glm::vec3 colour = glm::mix(stone, turf, glm::smoothstep(-0.1F, 0.7F, direction.y));
    colour = glm::mix(colour, pink, 0.85F * glm::smoothstep(0.18F, 0.42F, patchA));
    colour = glm::mix(colour, ochre, 0.75F * glm::smoothstep(0.22F, 0.5F, patchB));
    return colour * (0.85F + 0.5F * solidNoise(rock.seed ^ 0x93U, place * 7.0F));
}

float opennessAt(const Rock& rock, glm::vec3 direction) {
    const float crags = ridges(rock.seed, direction * 1.35F, 4);
    const float hollow = glm::smoothstep(-0.25F, 0.55F, crags);
    const float height = glm::smoothstep(-0.35F, 0.6F, direction.y);
    return glm::mix(0.25F, 1.0F, height) * glm::mix(0.45F, 1.0F, hollow);
}

}  // namespace

void addBoulder(Mesh& mesh, const Rock& rock, int level) {
    constexpr std::array kColumns{88, 48, 28, 18};
    constexpr std::array kRows{50, 28, 16, 10};
    // A pebble needs no more facets than a boulder twice as far.
    const int step = level + (rock.radiusMetres < 0.6F ? 1 : 0);
    const auto grid = static_cast<std::size_t>(std::min(step, 3));
    const int columns = kColumns.at(grid);
    const int rows = kRows.at(grid);
    constexpr float kLowest = 0.72F;  // of a half turn from the zenith: the rest is in the sand
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::size_t firstIndex = mesh.indices.size();
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const float polar = kLowest * std::numbers::pi_v<float> * static_cast<float>(row) /
                                static_cast<float>(rows - 1);
            const float turn =
                kTwoPi * static_cast<float>(column % columns) / static_cast<float>(columns);
            const glm::vec3 direction{std::sin(polar) * std::cos(turn),
                                      std::cos(polar),
                                      std::sin(polar) * std::sin(turn)};
            const glm::vec3 place = pointTowards(rock, direction);
            addVertex(mesh,
                      place,
                      direction,
                      {crustAt(rock, place, direction), 1.0F, 0.0F},
                      opennessAt(rock, direction));
        }
    joinRows(mesh, first, rows, columns + 1);
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);  // outward is counter-clockwise
    setSmoothNormals(mesh, first, firstIndex);
    // The seam's two columns are one place: one normal, or a crease shows.
    for (int row = 0; row < rows; ++row) {
        const auto width = static_cast<std::uint32_t>(columns + 1);
        const std::uint32_t a = first + static_cast<std::uint32_t>(row) * width;
        const std::uint32_t b = a + width - 1;
        const glm::vec3 sum =
            glm::vec3(mesh.vertices[a].normal) + glm::vec3(mesh.vertices[b].normal);
        const glm::i8vec3 both{glm::round(glm::normalize(sum) * 127.0F)};
        mesh.vertices[a].normal = glm::i8vec4(both, 127);
        mesh.vertices[b].normal = glm::i8vec4(both, 127);
    }
}

std::vector<Spot> spotsOn(const Rock& rock, int count) {
    std::vector<Spot> spots;
    for (int i = 0; i < count; ++i) {
        const float height =
            1.0F - 1.25F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        const float turn = 2.39996F * static_cast<float>(i) + unitOf(rock.seed) * kTwoPi;
        const float flat = std::sqrt(1.0F - height * height);
        const glm::vec3 direction{flat * std::cos(turn), height, flat * std::sin(turn)};
        const Spot spot{pointTowards(rock, direction), normalTowards(rock, direction)};
        if (spot.normal.y > -0.25F) spots.push_back(spot);
    }
    return spots;
}

}  // namespace aquarama
