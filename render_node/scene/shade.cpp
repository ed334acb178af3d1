// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/shade.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::scene {

namespace {

constexpr float kBodyShare = 0.74F;  // of a rock's radius: its mean crag

}  // namespace

glm::vec3 sunInWater() {
    return glm::normalize(glm::vec3{-0.27F, 0.82F, -0.51F});
}

float sunOpenness(std::span<const place::Rock> rocks, glm::vec3 place) {
    const glm::vec3 sun = sunInWater();
    float open = 1.0F;
    for (const place::Rock& rock : rocks) {
        const float radius = rock.radiusMetres * kBodyShare;
        const glm::vec3 away = rock.centre - place;
        const float along = glm::dot(away, sun);
        if (along < 0.0F) continue;
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
        // A ball hides about (r/d)^2 of a hemisphere, weighted by where it stands in it.
        const float ratio = glm::min(radius / glm::max(distance, 0.01F), 1.0F);
        const float facing = 0.5F + 0.5F * glm::dot(normal, direction);
        open *= 1.0F - 0.85F * facing * ratio * ratio;
    }
    return open;
}

void shade(Mesh& mesh, std::span<const place::Rock> others) {
    for (SolidVertex& vertex : mesh.vertices) {
        const glm::vec3 normal = glm::vec3(vertex.normal) / 127.0F;
        const glm::vec3 place = vertex.position + normal * 0.05F;
        const float sky = skyOpenness(others, place, normal);
        vertex.albedo.w = static_cast<glm::u8>(static_cast<float>(vertex.albedo.w) * sky);
        vertex.response.x = static_cast<glm::u8>(255.0F * sunOpenness(others, place));
    }
}

}  // namespace aquarama::scene
