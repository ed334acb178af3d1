// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/plant_mesh.h"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/scene/solid_noise.h"

namespace aquarama {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kGoldenAngle = 2.39996F;

std::uint16_t add(PlantMesh& mesh,
                  glm::vec4 offsetAndShare,
                  glm::vec3 normal,
                  float blade,
                  glm::vec4 albedoAndOpenness) {
    PlantVertex vertex;
    vertex.offsetAndShare = offsetAndShare;
    const glm::vec3 unit = glm::normalize(normal) * 127.0F;
    vertex.normalAndBlade = glm::i8vec4(glm::round(glm::vec4(unit, 127.0F * blade)));
    vertex.albedo = glm::u8vec4(glm::clamp(albedoAndOpenness, 0.0F, 1.0F) * 255.0F + 0.5F);
    mesh.vertices.push_back(vertex);
    return static_cast<std::uint16_t>(mesh.vertices.size() - 1);
}

// Rows of three: both edges and the midrib.
void joinStrip(PlantMesh& mesh, std::uint16_t first, int rows) {
    for (int row = 0; row + 1 < rows; ++row)
        for (int half = 0; half < 2; ++half) {
            const auto a = static_cast<std::uint16_t>(first + 3 * row + half);
            const auto b = static_cast<std::uint16_t>(a + 3);
            for (const int corner : {a + 0, a + 1, b + 1, a + 0, b + 1, b + 0})
                mesh.indices.push_back(static_cast<std::uint16_t>(corner));
        }
}

struct Blade {
    float share;    // where on the stem it hangs
    glm::vec3 out;  // its direction
    float length;
    float width;
    glm::vec3 albedo;
    int rows;
};

// A kelp blade: out, then drooping, ruffled at the edges, folded along the midrib.
void addBlade(PlantMesh& mesh, const Blade& blade) {
    const glm::vec3 side =
        glm::normalize(glm::cross(blade.out, glm::vec3{0, 1, 0}) + glm::vec3{0, 0.35F, 0});
    const auto first = static_cast<std::uint16_t>(mesh.vertices.size());
    const float openness = 0.45F + 0.55F * blade.share;
    for (int row = 0; row < blade.rows; ++row) {
        const float v = static_cast<float>(row) / static_cast<float>(blade.rows - 1);
        const float width = blade.width * std::sin(kPi * (0.08F + 0.9F * std::pow(v, 0.7F)));
        const glm::vec3 centre =
            blade.out * (blade.length * v) - glm::vec3{0, blade.length * 0.6F * v * v, 0};
        const glm::vec3 normal = glm::cross(side, blade.out);
        for (const float edge : {-1.0F, 0.0F, 1.0F}) {
            const float ruffle = 0.35F * width * edge * std::sin(17.0F * v + 2.0F * edge);
            const glm::vec3 place = centre + side * (edge * width) + normal * ruffle;
            add(mesh,
                glm::vec4(place, blade.share),
                normal + side * (0.5F * edge),
                v,
                glm::vec4(blade.albedo * (edge == 0.0F ? 0.75F : 1.0F), openness));
        }
    }
    joinStrip(mesh, first, blade.rows);
}

// A three-sided tube; the shader bends it.
void addStem(PlantMesh& mesh, int rows, float radius, glm::vec3 albedo) {
    constexpr int kSides = 3;
    const auto first = static_cast<int>(mesh.vertices.size());
    for (int row = 0; row < rows; ++row)
        for (int side = 0; side <= kSides; ++side) {
            const float share = static_cast<float>(row) / static_cast<float>(rows - 1);
            const float turn = 2.0F * kPi * static_cast<float>(side % kSides) / kSides;
            const glm::vec3 out{std::cos(turn), 0.0F, std::sin(turn)};
            add(mesh,
                glm::vec4(out * (radius * (1.0F - 0.5F * share)), share),
                out,
                0.0F,
                glm::vec4(albedo, 0.45F + 0.55F * share));
        }
    for (int row = 0; row + 1 < rows; ++row)
        for (int side = 0; side < kSides; ++side) {
            const int a = first + row * (kSides + 1) + side;
            const int b = a + kSides + 1;
            for (const int corner : {a, b, b + 1, a, b + 1, a + 1})
                mesh.indices.push_back(static_cast<std::uint16_t>(corner));
        }
}

PlantMesh growKelp(int level) {
    constexpr std::array kBlades{52, 34, 22};
    constexpr std::array kBladeRows{6, 4, 4};
    constexpr std::array kStemRows{14, 8, 5};
    const auto at = static_cast<std::size_t>(level);
    PlantMesh mesh;
    addStem(
        mesh, kStemRows[at], 0.020F + 0.006F * static_cast<float>(level), {0.20F, 0.16F, 0.05F});
    const auto blades = static_cast<float>(kBlades[at]);
    const float broader = std::sqrt(52.0F / blades);
    Dice dice{5};
    for (int i = 0; i < kBlades[at]; ++i) {
        const float share = (static_cast<float>(i) + 1.2F) / (blades + 0.6F);
        const float turn = kGoldenAngle * static_cast<float>(i) + dice.unit();
        const glm::vec3 out =
            glm::normalize(glm::vec3{std::cos(turn), dice.between(-0.1F, 0.5F), std::sin(turn)});
        const float shade = dice.between(0.8F, 1.25F);
        addBlade(mesh,
                 {share,
                  out,
                  dice.between(0.45F, 0.8F) * (1.1F - 0.3F * share) * broader,
                  0.075F * broader,
                  glm::vec3{0.62F, 0.31F, 0.05F} * shade,
                  kBladeRows[at]});
    }
    return mesh;
}

// A tuft: narrow leaves that fan out from one root.
PlantMesh growSeagrass(int level) {
    constexpr std::array kLeaves{10, 6, 4};
    constexpr std::array kRows{5, 4, 3};
    const auto at = static_cast<std::size_t>(level);
    const float broader = std::sqrt(10.0F / static_cast<float>(kLeaves[at]));
    PlantMesh mesh;
    Dice dice{9};
    for (int leaf = 0; leaf < kLeaves[at]; ++leaf) {
        const float turn = kGoldenAngle * static_cast<float>(leaf);
        const glm::vec3 out{std::cos(turn), 0.0F, std::sin(turn)};
        const glm::vec3 side{-out.z, 0.0F, out.x};
        const glm::vec3 foot = out * dice.between(0.0F, 0.16F);
        const float tall = dice.between(0.55F, 1.0F);
        const float shade = dice.between(0.75F, 1.25F);
        const auto first = static_cast<std::uint16_t>(mesh.vertices.size());
        for (int row = 0; row < kRows[at]; ++row) {
            const float v = static_cast<float>(row) / static_cast<float>(kRows[at] - 1);
            const glm::vec3 centre = foot + out * (0.16F * tall * v * v);
            const float width = 0.011F * broader * (1.04F - v * v);
            for (const float edge : {-1.0F, 0.0F, 1.0F})
                add(mesh,
                    glm::vec4(centre + side * (edge * width), tall * v),
                    out + glm::vec3{0, 0.3F, 0} + side * (0.4F * edge),
                    0.35F * v,
                    glm::vec4(glm::vec3{0.17F, 0.30F, 0.07F} * shade * (0.6F + 0.5F * v),
                              0.45F + 0.55F * v));
        }
        joinStrip(mesh, first, kRows[at]);
    }
    return mesh;
}

}  // namespace

PlantMesh growPlant(PlantKind kind, int level) {
    return kind == PlantKind::Kelp ? growKelp(level) : growSeagrass(level);
}

}  // namespace aquarama
