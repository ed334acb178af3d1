// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/coral_mesh.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/scene/solid_noise.h"

namespace aquarama {

namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

constexpr float kFluorescence = 0.6F;

struct Joint {
    glm::vec3 centre{};
    float radius = 0.0F;
    glm::vec3 albedo{};
    float openness = 1.0F;
};

// A tube through the joints, closed by a point.
void addTube(Mesh& mesh, std::span<const Joint> joints, int sides, float translucency) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Joint& here = joints[i];
        const glm::vec3 along = i + 1 < joints.size() ? joints[i + 1].centre - here.centre
                                                      : here.centre - joints[i - 1].centre;
        const glm::mat3 frame = frameAbout(glm::normalize(along), 0.0F);
        for (int side = 0; side <= sides; ++side) {
            const float turn =
                kTwoPi * static_cast<float>(side % sides) / static_cast<float>(sides);
            const glm::vec3 outward = frame[0] * std::cos(turn) + frame[2] * std::sin(turn);
            addVertex(mesh,
                      here.centre + outward * here.radius,
                      outward,
                      {here.albedo, 0.25F, translucency, kFluorescence},
                      here.openness);
        }
    }
    joinRows(mesh, first, static_cast<int>(joints.size()), sides + 1);
}

// A twig seen from afar: two triangles that stand across the line of growth.
void addTwig(Mesh& mesh, const Joint& from, const Joint& to, glm::vec3 side, float translucency) {
    const glm::vec3 normal = glm::normalize(glm::cross(side, to.centre - from.centre));
    std::array<std::uint32_t, 4> corners{};
    for (int i = 0; i < 4; ++i) {
        const Joint& joint = i < 2 ? from : to;
        const float edge = i == 0 || i == 3 ? -1.0F : 1.0F;
        corners.at(static_cast<std::size_t>(i)) =
            addVertex(mesh,
                      joint.centre + side * (edge * joint.radius),
                      glm::normalize(normal + side * edge),
                      {joint.albedo, 0.0F, translucency, kFluorescence},
                      joint.openness);
    }
    addQuad(mesh, corners[0], corners[1], corners[2], corners[3]);
}

struct Growth {
    Dice dice;
    glm::vec3 body;
    glm::vec3 tip;
    int generations;
    int sides;              // 0: twigs only
    glm::mat3 plane{1.0F};  // of a fan
};

void branch(
    Mesh& mesh, Growth& growth, const Joint& from, glm::vec3 direction, float length, int left) {
    const float age = 1.0F - static_cast<float>(left - 1) / static_cast<float>(growth.generations);
    Joint to{from.centre + direction * length,
             from.radius * 0.78F,
             glm::mix(growth.body, growth.tip, age * age),
             glm::mix(0.55F, 1.0F, age)};
    if (left == 1) to.radius *= 0.5F;
    if (growth.sides > 0 && left > 1)
        addTube(mesh, std::array{from, to}, growth.sides, 0.15F);
    else
        addTwig(mesh, from, to, frameAbout(direction, 6.0F * from.centre.x)[0], 0.15F);
    if (left == 1) return;
    const int children = 2 + (growth.dice.unit() < 0.5F ? 1 : 0);
    const float turn = growth.dice.between(0.0F, kTwoPi);
    for (int child = 0; child < children; ++child) {
        const glm::mat3 frame = frameAbout(
            direction, turn + kTwoPi * static_cast<float>(child) / static_cast<float>(children));
        const float bend = growth.dice.between(0.35F, 0.8F);
        const glm::vec3 next = glm::normalize(direction * std::cos(bend) +
                                              frame[0] * std::sin(bend) + glm::vec3{0, 0.25F, 0});
        branch(mesh, growth, to, next, length * growth.dice.between(0.7F, 0.95F), left - 1);
    }
}

// Staghorn and its kin.
void addBranching(
    Mesh& mesh, const Spot& spot, float size, glm::vec3 colour, Dice dice, int level) {
    const int stems = 4 + static_cast<int>(dice.unit() * 3.0F);
    Growth growth{Dice{dice.seed()},
                  colour * 0.7F,
                  glm::min(colour * 1.5F + 0.10F, glm::vec3{0.9F}),
                  4 - level,
                  level == 0 ? 3 : 0};
    for (int stem = 0; stem < stems; ++stem) {
        const glm::mat3 frame =
            frameAbout(spot.normal, kTwoPi * static_cast<float>(stem) / static_cast<float>(stems));
        const float lean = dice.between(0.15F, 0.95F);
        const glm::vec3 direction = glm::normalize(
            spot.normal * std::cos(lean) + frame[0] * std::sin(lean) + glm::vec3{0, 0.3F, 0});
        branch(mesh,
               growth,
               {spot.position, size * 0.05F, growth.body, 0.4F},
               direction,
               size * 0.30F,
               growth.generations);
    }
}

// A plate on a foot, its rim waved and pale where it grows.
void addTable(Mesh& mesh, const Spot& spot, float size, glm::vec3 colour, Dice dice, int level) {
    const int around = level == 0 ? 30 : level == 1 ? 16 : 11 - level;
    const int rings = level == 0 ? 5 : level < 3 ? 3 : 2;
    const std::uint32_t seed = dice.seed();
    const glm::vec3 up =
        glm::normalize(glm::vec3{0, 1, 0} + 0.3F * spot.normal * glm::vec3{1, 0, 1});
    const glm::mat3 frame = frameAbout(up, dice.between(0.0F, kTwoPi));
    const float foot = size * dice.between(0.28F, 0.45F);
    const glm::vec3 centre = spot.position + up * foot;
    addTube(mesh,
            std::array{Joint{spot.position - up * 0.1F * size, size * 0.16F, colour * 0.4F, 0.3F},
                       Joint{centre, size * 0.24F, colour * 0.5F, 0.3F}},
            6,
            0.0F);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::size_t firstIndex = mesh.indices.size();
    for (int ring = 0; ring <= rings; ++ring)
        for (int i = 0; i <= around; ++i) {
            const float t = static_cast<float>(ring) / static_cast<float>(rings);
            const float turn = kTwoPi * static_cast<float>(i % around) / static_cast<float>(around);
            const glm::vec3 outward{std::cos(turn), 0.0F, std::sin(turn)};
            const float reach = size * t *
                                (1.0F + t * (0.24F * solidNoise(seed, outward * 2.0F) +
                                             0.10F * solidNoise(seed, outward * 8.0F)));
            const float bowl =
                size * (0.14F * t * t + 0.05F * solidNoise(seed, outward * t * 5.0F));
            addVertex(mesh,
                      centre + frame * glm::vec3{outward.x * reach, bowl, outward.z * reach},
                      up,
                      {colour * (0.55F + 0.55F * t * t * t), 0.9F, 0.1F},
                      0.6F + 0.4F * t);
        }
    joinRows(mesh, first, rings + 1, around + 1);
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    setSmoothNormals(mesh, first, firstIndex);
}

// A low dome; its meanders are the shader's business.
void addDome(Mesh& mesh, const Spot& spot, float size, glm::vec3 colour, Dice dice, int level) {
    const int around = level == 0 ? 20 : level == 1 ? 12 : 10 - level;
    const int rings = level == 0 ? 8 : level == 1 ? 5 : 5 - level;
    const std::uint32_t seed = dice.seed();
    const glm::mat3 frame = frameAbout(spot.normal, 0.0F);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int ring = 0; ring <= rings; ++ring)
        for (int i = 0; i <= around; ++i) {
            const float polar = 0.6F * std::numbers::pi_v<float> * static_cast<float>(ring) /
                                static_cast<float>(rings);
            const float turn = kTwoPi * static_cast<float>(i % around) / static_cast<float>(around);
            const glm::vec3 outward{std::sin(polar) * std::cos(turn),
                                    std::cos(polar),
                                    std::sin(polar) * std::sin(turn)};
            const float lumps = 1.0F + 0.16F * solidNoise(seed, outward * 2.2F);
            const float fine = solidNoise(seed, outward * 9.0F);
            addVertex(
                mesh,
                spot.position + frame * (outward * (size * lumps) * glm::vec3{1.0F, 0.75F, 1.0F}),
                frame * outward,
                {colour * (1.0F + 0.35F * fine), 1.0F, 0.05F, kFluorescence},
                glm::mix(0.4F, 1.0F, glm::smoothstep(-0.3F, 0.6F, outward.y)));
        }
    const std::size_t firstIndex = mesh.indices.size();
    joinRows(mesh, first, rings + 1, around + 1);
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

void fanBranch(Mesh& mesh, Growth& growth, const Joint& from, float angle, float length, int left) {
    const glm::mat3& plane = growth.plane;
    const glm::vec3 direction = plane[0] * std::sin(angle) + plane[1] * std::cos(angle);
    const Joint to{from.centre + direction * length,
                   glm::max(from.radius * 0.74F, 0.0045F),
                   glm::mix(growth.body, growth.tip, 1.0F / static_cast<float>(left)),
                   0.95F};
    addTwig(mesh, from, to, glm::normalize(glm::cross(direction, plane[2])), 0.35F);
    if (left == 1) return;
    for (const float side : {-1.0F, 1.0F})
        fanBranch(mesh,
                  growth,
                  to,
                  angle + side * growth.dice.between(0.18F, 0.6F),
                  length * growth.dice.between(0.74F, 0.95F),
                  left - 1);
}

// A gorgonian: a tree in one plane, across the swell.
void addFan(Mesh& mesh, const Spot& spot, float size, glm::vec3 colour, Dice dice, int level) {
    const glm::vec3 up = glm::normalize(spot.normal + glm::vec3{0, 1.2F, 0});
    const glm::mat3 plane = frameAbout(up, dice.between(-0.6F, 0.6F));
    Growth growth{
        Dice{dice.seed()}, colour * 0.75F, colour * 1.15F, level < 3 ? 6 - level : 2, 0, plane};
    for (const float angle : {-0.5F, 0.0F, 0.5F})
        fanBranch(mesh,
                  growth,
                  {spot.position, size * 0.028F, growth.body, 0.6F},
                  angle,
                  size * 0.24F,
                  growth.generations);
}

// Tubes with a lip, dark within.
void addSponge(Mesh& mesh, const Spot& spot, float size, glm::vec3 colour, Dice dice, int level) {
    const int tubes = 3 + static_cast<int>(dice.unit() * 3.0F);
    for (int tube = 0; tube < tubes; ++tube) {
        const glm::mat3 frame =
            frameAbout(spot.normal, kTwoPi * static_cast<float>(tube) / static_cast<float>(tubes));
        const float height = size * dice.between(0.5F, 1.0F);
        const float width = size * dice.between(0.08F, 0.12F);
        const glm::vec3 direction = glm::normalize(0.4F * spot.normal + glm::vec3{0, 1, 0} +
                                                   frame[0] * dice.between(0.1F, 0.4F));
        const glm::vec3 base = spot.position + frame[0] * size * 0.1F;
        addTube(
            mesh,
            std::array{Joint{base, width * 0.7F, colour * 0.6F, 0.4F},
                       Joint{base + direction * height * 0.6F, width, colour * 0.9F, 0.9F},
                       Joint{base + direction * height, width * 1.12F, colour * 1.1F, 1.0F},
                       Joint{base + direction * height * 0.97F, width * 0.75F, colour * 0.5F, 0.3F},
                       Joint{base + direction * height * 0.75F, width * 0.5F, colour * 0.2F, 0.1F}},
            level == 0 ? 8 : 5,
            0.1F);
    }
}

glm::vec3 chosen(std::span<const glm::vec3> colours, Dice& dice) {
    return colours[static_cast<std::size_t>(dice.unit() * 0.999F *
                                            static_cast<float>(colours.size()))] *
           dice.between(0.85F, 1.15F);
}

}  // namespace

void addCoral(ReefMesh& mesh, const Spot& spot, float sizeMetres, std::uint32_t seed, int level) {
    // Linear albedos: tans and olives of living hard coral, a few lilacs, creams and pinks.
    static constexpr std::array kHard{glm::vec3{0.55F, 0.42F, 0.20F},
                                      glm::vec3{0.36F, 0.25F, 0.46F},
                                      glm::vec3{0.34F, 0.38F, 0.14F},
                                      glm::vec3{0.66F, 0.34F, 0.30F},
                                      glm::vec3{0.60F, 0.54F, 0.40F},
                                      glm::vec3{0.30F, 0.34F, 0.52F}};
    static constexpr std::array kSoft{glm::vec3{0.62F, 0.14F, 0.34F},
                                      glm::vec3{0.72F, 0.34F, 0.06F},
                                      glm::vec3{0.66F, 0.10F, 0.10F},
                                      glm::vec3{0.44F, 0.16F, 0.50F},
                                      glm::vec3{0.70F, 0.55F, 0.10F}};
    Dice dice{seed};
    const Spot sunk{spot.position - spot.normal * 0.04F, spot.normal};
    const float kind = dice.unit();
    const glm::vec3 hard = chosen(kHard, dice);
    const glm::vec3 soft = chosen(kSoft, dice);
    if (kind < 0.36F) return addBranching(mesh.growth, sunk, sizeMetres, hard, dice, level);
    if (kind < 0.52F && spot.normal.y > 0.45F)
        return addTable(mesh.growth, sunk, sizeMetres * 1.1F, hard, dice, level);
    if (kind < 0.70F) return addDome(mesh.stone, sunk, sizeMetres * 0.45F, hard, dice, level);
    if (kind < 0.86F) return addFan(mesh.growth, sunk, sizeMetres * 1.2F, soft, dice, level);
    addSponge(mesh.growth, sunk, sizeMetres * 0.8F, soft, dice, level);
}

}  // namespace aquarama
