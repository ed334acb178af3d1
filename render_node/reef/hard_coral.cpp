// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/reef/angles.h"
#include "render_node/reef/growth.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

namespace {

// Living tissue, relative to the tint: dark where it is old, pale where it grows.
Surface tissue(float lightness, float relief = 0.0F) {
    return {.albedo = glm::vec3{0.5F * lightness},
            .roughness = 0.45F,
            .translucency = 0.15F,
            .fluorescence = 0.5F,
            .relief = relief};
}

// How a coral branches.
struct Branching {
    int generations;
    int sides;
    // Radius of a child relative to its parent's.
    float thin;
    // Least angle between child and parent, radians; the greatest is twice that.
    float wide;
    // How strongly branches bend upwards.
    float upward;
    // Radius of a coarse level relative to the finest: it has fewer branches.
    float broader;
};

// A branch at its foot. key: of this branch, the same at all levels, from which its dice follow.
struct Shoot {
    Joint from;
    glm::vec3 way;
    float length;
    std::uint32_t key;
};

// Grows a branch and, recursively, two or three children; `left` generations remain with this one.
// The last generation ends in a pale tip. `way` is a unit vector.
void branch(Mesh& mesh, const Branching& habit, const Shoot& shoot, int left) {
    const Joint& from = shoot.from;
    // 1 in the last generation; tissue is paler there.
    const float age = 1.0F - static_cast<float>(left - 1) / static_cast<float>(habit.generations);
    const glm::vec3 bent = glm::normalize(shoot.way + glm::vec3{0, 0.5F * habit.upward, 0});
    const float light = 0.62F + 0.75F * age * age;
    const Joint middle{from.centre + shoot.way * (0.5F * shoot.length),
                       from.radius * (0.5F + 0.5F * habit.thin),
                       tissue(0.5F * (light + 2.0F * from.surface.albedo.x)),
                       glm::mix(0.45F, 1.0F, age)};
    Joint to{middle.centre + bent * (0.5F * shoot.length),
             from.radius * habit.thin,
             tissue(light),
             middle.ambientOcclusion};
    mesh.nextKey = shoot.key;
    const glm::vec3 facing = frameAbout(bent, from.centre.x * 9.0F)[0];
    if (left == 1) {
        const Joint tip{
            to.centre + bent * (0.7F * to.radius), 0.25F * to.radius, tissue(1.75F), 1.0F};
        to.radius *= 0.85F;
        return addStrand(mesh, std::array{from, to, tip}, habit.sides, facing);
    }
    // Ribbons omit the joint in the middle.
    if (habit.sides > 0)
        addStrand(mesh, std::array{from, middle, to}, habit.sides);
    else
        addStrand(mesh, std::array{from, to}, 0, facing);
    Dice dice{shoot.key};
    const int children = 2 + (dice.unit() < 0.45F ? 1 : 0);
    const float turn = dice.between(0.0F, kTwoPi);
    for (int child = 0; child < children; ++child) {
        const glm::mat3 frame = frameAbout(
            bent, turn + kTwoPi * static_cast<float>(child) / static_cast<float>(children));
        const float angle = dice.between(habit.wide, 2.0F * habit.wide);
        const glm::vec3 next = glm::normalize(bent * std::cos(angle) + frame[0] * std::sin(angle) +
                                              glm::vec3{0, 0.4F * habit.upward, 0});
        const float length = shoot.length * dice.between(0.68F, 0.95F);
        branch(mesh, habit, {to, next, length, dice.seed()}, left - 1);
    }
}

}  // namespace

// Staghorn, Acropora: slender branches from one foot, the first stem upright, the others leaning.
void growStaghorn(Mesh& mesh, std::size_t level, Dice dice) {
    // By level: generations of branches, and sides of a tube (0: a ribbon). Levels with fewer
    // generations have longer branches.
    constexpr std::array kGenerations{4, 4, 3, 3, 2};
    constexpr std::array kSides{8, 6, 4, 0, 0};
    constexpr std::array kLonger{1.0F, 1.0F, 1.22F, 1.22F, 1.6F};
    constexpr std::array kBroader{1.0F, 1.0F, 1.22F, 1.44F, 1.66F};
    const int stems = 5 + static_cast<int>(dice.unit() * 3.0F);
    const float slender = dice.between(0.036F, 0.052F);
    const Branching habit{kGenerations.at(level),
                          kSides.at(level),
                          dice.between(0.74F, 0.84F),
                          dice.between(0.30F, 0.46F),
                          dice.between(0.4F, 0.9F),
                          kBroader.at(level)};
    const float length = 0.34F * kLonger.at(level);
    for (int stem = 0; stem < stems; ++stem) {
        const float lean = stem == 0 ? 0.1F : dice.between(0.5F, 1.25F);
        const glm::mat3 frame =
            frameAbout({0, 1, 0},
                       kTwoPi * static_cast<float>(stem) / static_cast<float>(stems) +
                           dice.between(-0.3F, 0.3F));
        const glm::vec3 way = glm::normalize(frame[1] * std::cos(lean) + frame[0] * std::sin(lean));
        const Joint foot{
            way * 0.02F - glm::vec3{0, 0.06F, 0}, slender * habit.broader, tissue(0.5F), 0.4F};
        branch(mesh, habit, {foot, way, length, dice.seed()}, habit.generations);
    }
}

// A cushion of short upright fingers, as of corymbose Acropora and Pocillopora, on a dome that
// hides the gaps.
void growBush(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kFingers{110, 90, 64, 34, 14};
    constexpr std::array kSides{6, 4, 4, 0, 0};
    constexpr std::array kDomeRings{6, 5, 4, 3, 2};
    constexpr std::array kDomeAround{24, 18, 12, 9, 6};
    const float spread = dice.between(0.85F, 1.2F);
    const float tall = dice.between(0.30F, 0.48F);
    const int fingers = kFingers.at(level);
    // The area that all fingers cover stays the same at each level.
    const float broader = std::sqrt(110.0F / static_cast<float>(fingers));
    addBall(mesh,
            {.centre = {0, -0.05F, 0},
             .radii = {0.62F, 0.34F, 0.62F},
             .capRadians = 1.9F,
             .rings = kDomeRings.at(level),
             .around = kDomeAround.at(level)},
            tissue(0.42F));
    for (int i = 0; i < fingers; ++i) {
        const float out = std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(fingers));
        const float turn = kGoldenAngle * static_cast<float>(i) + 0.5F * dice.unit();
        const float lean = spread * out;
        const glm::vec3 way{
            std::sin(lean) * std::cos(turn), std::cos(lean), std::sin(lean) * std::sin(turn)};
        const float length = tall * dice.between(0.75F, 1.15F) * (1.1F - 0.25F * out);
        const glm::vec3 foot = way * glm::vec3{0.55F, 0.26F, 0.55F};
        const float radius = 0.042F * broader * dice.between(0.8F, 1.2F);
        const Joint low{foot, radius, tissue(0.55F), 0.35F};
        const Joint high{foot + way * length, radius * 0.8F, tissue(1.15F), 0.9F};
        const Joint tip{foot + way * (length + 0.03F), radius * 0.25F, tissue(1.7F), 1.0F};
        const glm::vec3 facing = way + glm::vec3{0.3F, 0, 0.9F};
        if (level < 3)
            addStrand(mesh, std::array{low, high, tip}, kSides.at(level));
        else
            addStrand(mesh, std::array{low, tip}, kSides.at(level), facing);
    }
}

// Thick blunt fingers that stand close together.
void growFingers(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kFingers{22, 22, 18, 12, 7};
    constexpr std::array kSides{14, 10, 7, 5, 4};
    const int fingers = kFingers.at(level);
    const float broader = std::sqrt(22.0F / static_cast<float>(fingers));
    for (int i = 0; i < fingers; ++i) {
        const float out = std::sqrt((static_cast<float>(i) + 0.3F) / static_cast<float>(fingers));
        const float turn = kGoldenAngle * static_cast<float>(i);
        const glm::vec3 side{std::cos(turn), 0, std::sin(turn)};
        const float tall = dice.between(0.55F, 1.0F) * (1.0F - 0.45F * out * out);
        const float radius = 0.085F * broader * dice.between(0.75F, 1.15F);
        const glm::vec3 foot = side * (0.42F * out);
        const glm::vec3 top = foot + side * (0.30F * out * dice.unit()) + glm::vec3{0, tall, 0};
        const glm::vec3 middle = glm::mix(foot, top, 0.5F) + side * (0.05F * out);
        const std::array joints{
            Joint{foot - glm::vec3{0, 0.08F, 0}, radius, tissue(0.45F), 0.3F},
            Joint{middle, radius * 1.12F, tissue(0.8F), 0.7F},
            Joint{top, radius, tissue(1.1F), 0.95F},
            Joint{top + glm::vec3{0, 0.6F * radius, 0}, radius * 0.62F, tissue(1.35F), 1.0F},
            Joint{top + glm::vec3{0, 0.8F * radius, 0}, 0.0F, tissue(1.4F), 1.0F}};
        if (level < 4)
            addStrand(mesh, joints, kSides.at(level));
        else
            addStrand(mesh, std::array{joints[0], joints[2], joints[4]}, kSides.at(level));
    }
}

// A table coral: a plate on a foot, covered with small fingers; its rim is pale, where it grows.
void growTable(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kAround{128, 64, 32, 16, 8};
    constexpr std::array kCarpet{560, 300, 0, 0, 0};
    const std::uint32_t seed = dice.seed();
    const float foot = dice.between(0.22F, 0.40F);
    const float bowl = dice.between(0.05F, 0.14F);
    // The rim is the middle one, so that coarse levels, with every second ring, keep it.
    const std::array rings{Ring{0.20F, -0.12F, 0.3F, 0.4F, 0.3F},
                           Ring{0.13F, 0.5F * foot, 0.3F, 0.45F, 0.3F},
                           Ring{0.34F, foot - 0.07F, 0.3F, 0.5F, 0.5F},
                           Ring{0.85F, foot - 0.01F + 0.7F * bowl, 0.45F, 0.65F},
                           Ring{1.0F, foot + 0.03F + bowl, 1.0F, 1.55F},
                           Ring{0.90F, foot + 0.03F + 0.8F * bowl, 1.0F, 1.0F},
                           Ring{0.55F, foot + 0.03F + 0.3F * bowl, 0.9F, 0.8F, 0.6F},
                           Ring{0.28F, foot + 0.03F + 0.1F * bowl, 0.9F, 0.78F, 0.3F},
                           Ring{0.0F, foot + 0.03F, 0.9F, 0.75F, 0.0F}};
    const Turning turning{
        .around = kAround.at(level), .seed = seed, .wide = 0.26F, .high = 0.07F, .lobes = 1.8F};
    const std::array few = everySecond(rings);
    addTurned(mesh, level < 3 ? std::span<const Ring>{rings} : few, turning, tissue(1.0F));
    // The fingers stand on the plate: they follow its irregular rim and height, as addTurned()
    // makes them.
    const int carpet = kCarpet.at(level);
    const float broader = carpet > 0 ? std::sqrt(560.0F / static_cast<float>(carpet)) : 0.0F;
    for (int i = 0; i < carpet; ++i) {
        const float out =
            0.95F * std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(carpet));
        const float turn = kGoldenAngle * static_cast<float>(i);
        const glm::vec3 side{std::cos(turn), 0, std::sin(turn)};
        const glm::vec3 at = side * turning.lobes;
        const float waver = waverAt(turning, side);
        const float reach = out * (1.0F + 0.26F * waver * glm::mix(0.3F, 1.0F, out));
        const float lift = 0.07F * solidNoise(seed ^ 1U, at * 1.4F) * out;
        const glm::vec3 base =
            side * reach + glm::vec3{0, foot + 0.02F + bowl * out * out + lift, 0};
        const glm::vec3 way = glm::normalize(glm::vec3{0, 1, 0} + side * (0.9F * out * out));
        const float tall = 0.085F * dice.between(0.6F, 1.2F);
        const float radius = 0.020F * broader;
        addStrand(
            mesh,
            std::array{Joint{base, radius, tissue(0.6F), 0.6F},
                       Joint{base + way * tall, 0.3F * radius, tissue(1.25F + 0.4F * out), 1.0F}},
            3);
    }
}

// A brain coral: one lumpy dome, whose meanders are painted by coral.frag (relief 1).
void growBrain(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kRings{16, 11, 7, 5, 3};
    constexpr std::array kAround{48, 34, 20, 13, 8};
    addBall(mesh,
            {.centre = {0, 0.02F, 0},
             .radii = {0.85F, dice.between(0.5F, 0.75F), dice.between(0.7F, 0.9F)},
             .capRadians = 2.0F,
             .rings = kRings.at(level),
             .around = kAround.at(level),
             .seed = dice.seed(),
             .lumps = 0.24F,
             .cells = 2.0F},
            tissue(1.0F, 1.0F));
}

// Massive heads that have grown together, as of Porites.
void growLobes(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kBalls{13, 13, 11, 8, 4};
    constexpr std::array kRings{11, 7, 5, 4, 2};
    constexpr std::array kAround{30, 20, 15, 12, 8};
    for (int i = 0; i < kBalls.at(level); ++i) {
        const float out =
            0.62F * std::sqrt(static_cast<float>(i) / static_cast<float>(kBalls.at(level)));
        const float turn = kGoldenAngle * static_cast<float>(i);
        const float radius = dice.between(0.24F, 0.40F) * (level == 4 ? 1.3F : 1.0F);
        addBall(mesh,
                {.centre = {out * std::cos(turn),
                            0.42F - 0.55F * out + 0.1F * dice.unit(),
                            out * std::sin(turn)},
                 .radii = glm::vec3{radius, radius * dice.between(0.8F, 1.1F), radius},
                 .capRadians = 2.2F,
                 .rings = kRings.at(level),
                 .around = kAround.at(level),
                 .seed = dice.seed(),
                 .lumps = 0.16F,
                 .cells = 2.2F},
                tissue(1.0F));
    }
}

// Whorls of thin plates, as of Montipora and Turbinaria; the plates rise in a spiral. Each is a
// grid of rows outwards and columns across.
void growLeaves(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kPlates{13, 13, 11, 8, 6};
    constexpr std::array kAcross{16, 16, 8, 8, 4};
    constexpr std::array kOut{8, 4, 4, 2, 2};
    const int across = kAcross.at(level);
    // The noise of the rim has 4.6 cells.
    const float wavy = 0.22F * resolvedShare(static_cast<float>(across) / 4.6F);
    const int outward = kOut.at(level);
    for (int plate = 0; plate < kPlates.at(level); ++plate) {
        const float storey = static_cast<float>(plate) / static_cast<float>(kPlates.at(level));
        const float turn = kGoldenAngle * static_cast<float>(plate);
        const float half = dice.between(0.7F, 1.25F);
        const float size = dice.between(0.6F, 0.95F) * (1.0F - 0.45F * storey);
        const float rise = 0.35F + 0.75F * storey;
        const std::uint32_t seed = dice.seed();
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const std::size_t firstIndex = mesh.indices.size();
        for (int row = 0; row <= outward; ++row)
            for (int column = 0; column <= across; ++column) {
                const float t = static_cast<float>(row) / static_cast<float>(outward);
                const float u =
                    2.0F * static_cast<float>(column) / static_cast<float>(across) - 1.0F;
                const float angle = turn + half * u;
                const float rim =
                    1.0F + wavy * solidNoise(seed, glm::vec3{u * 2.3F, 0, t}) - 0.25F * u * u;
                const float reach = 0.06F + size * t * rim;
                const float curl =
                    size * (rise * t * t +
                            0.45F * wavy * t * solidNoise(seed ^ 1U, glm::vec3{u * 3.0F, 1, 0}));
                const float light = 0.5F + 0.45F * t + (row == outward ? 0.55F : 0.0F);
                addVertex(mesh,
                          {reach * std::cos(angle),
                           0.02F + 0.22F * storey + curl,
                           reach * std::sin(angle)},
                          {0, 1, 0},
                          {.albedo = glm::vec3{0.5F * light},
                           .roughness = 0.4F,
                           .translucency = 0.6F,
                           .fluorescence = 0.4F},
                          0.35F + 0.65F * t);
            }
        joinRows(mesh, first, outward + 1, across + 1);
        turnOver(mesh, firstIndex);
        setSmoothNormals(mesh, first, firstIndex);
    }
}

// Low mounds that cover the rock; two in five have meanders.
void growCrust(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kMounds{7, 7, 6, 5, 3};
    constexpr std::array kRings{12, 8, 6, 4, 3};
    constexpr std::array kAround{36, 26, 18, 12, 8};
    const float meanders = dice.unit() < 0.4F ? 1.0F : 0.0F;
    for (int i = 0; i < kMounds.at(level); ++i) {
        const float out =
            0.6F * std::sqrt(static_cast<float>(i) / static_cast<float>(kMounds.at(level)));
        const float turn = kGoldenAngle * static_cast<float>(i);
        const float radius = dice.between(0.34F, 0.55F) * (level == 4 ? 1.35F : 1.0F);
        addBall(mesh,
                {.centre = {out * std::cos(turn), -0.10F, out * std::sin(turn)},
                 .radii = {radius, dice.between(0.24F, 0.38F), radius},
                 .capRadians = 1.9F,
                 .rings = kRings.at(level),
                 .around = kAround.at(level),
                 .seed = dice.seed(),
                 .lumps = 0.22F,
                 .cells = 2.4F},
                tissue(1.0F, meanders));
    }
}

}  // namespace aquarama::scene
