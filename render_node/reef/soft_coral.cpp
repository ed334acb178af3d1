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

// The surface of a soft coral, relative to the tint.
Surface flesh(float lightness, float translucency, float sway) {
    return {.albedo = glm::vec3{0.5F * lightness},
            .roughness = 0.25F,
            .translucency = translucency,
            .fluorescence = 0.4F,
            .sway = sway};
}

// How a fan branches. sides 0 means ribbons; broader: radius relative to the finest level; bow:
// curvature of the fan's plane.
struct FanHabit {
    int generations;
    int sides;
    float broader;
    float bow;
};

// A branch at its foot. angle: from upright, radians; key: of this branch, the same at all levels,
// from which its dice follow.
struct FanShoot {
    Joint from;
    float angle;
    float length;
    std::uint32_t key;
};

// Grows a branch and its children in the plane z = 0, slightly bowed; thin late branches are
// ribbons.
void fanBranch(Mesh& mesh, const FanHabit& habit, const FanShoot& shoot, int left) {
    const Joint& from = shoot.from;
    const glm::vec3 way{std::sin(shoot.angle), std::cos(shoot.angle), 0};
    glm::vec3 end = from.centre + way * shoot.length;
    end.z = habit.bow * (end.x * end.x + 0.4F * end.y * end.y);
    const float age = 1.0F - static_cast<float>(left) / static_cast<float>(habit.generations);
    const Joint to{end,
                   left == 1 ? 0.4F * from.radius : 0.80F * from.radius,
                   flesh(0.7F + 0.6F * age, 0.35F, glm::clamp(end.y, 0.0F, 1.0F)),
                   glm::mix(0.6F, 1.0F, age)};
    mesh.nextKey = shoot.key;
    addStrand(mesh, std::array{from, to}, left > 3 ? habit.sides : 0);
    if (left == 1) return;
    Dice dice{shoot.key};
    const int children = 2 + (dice.unit() < (left > 4 ? 0.5F : 0.15F) ? 1 : 0);
    for (int child = 0; child < children; ++child) {
        const float aside = (static_cast<float>(child) - 0.5F * static_cast<float>(children - 1)) *
                            dice.between(0.45F, 0.75F);
        const float next = glm::clamp(shoot.angle * 0.93F + aside, -1.7F, 1.7F);
        const float length = shoot.length * dice.between(0.74F, 0.98F);
        fanBranch(mesh, habit, {to, next, length, dice.seed()}, left - 1);
    }
}

// How a soft tree branches; members as of FanHabit.
struct TreeHabit {
    int sides;
    // Of the balls of polyps: rings, segments around, and their size relative to the finest level.
    int rings, around;
    float broader;
};

// As FanShoot.
struct TreeShoot {
    Joint from;
    glm::vec3 way;
    float length;
    std::uint32_t key;
};

// A cluster of polyps at the end of a branch: a ball with few faces.
void addPolyps(Mesh& mesh, const TreeHabit& habit, const Joint& at, std::uint32_t key) {
    mesh.nextKey = hashOf(key, 1);
    addBall(mesh,
            {.centre = at.centre,
             .radii = glm::vec3{at.radius * 2.1F * habit.broader},
             .capRadians = 3.0F,
             .rings = habit.rings,
             .around = habit.around,
             .seed = key,
             .lumps = 0.35F,
             .cells = 3.0F},
            flesh(1.25F, 0.5F, at.surface.sway));
}

// Grows a branch and three children; the last generation ends in polyps.
void treeBranch(Mesh& mesh, const TreeHabit& habit, const TreeShoot& shoot, int left) {
    const glm::vec3 end = shoot.from.centre + shoot.way * shoot.length;
    const Joint to{
        end, shoot.from.radius * 0.7F, flesh(0.95F, 0.6F, glm::clamp(end.y, 0.0F, 1.0F)), 0.85F};
    mesh.nextKey = shoot.key;
    addStrand(mesh, std::array{shoot.from, to}, habit.sides, {0.2F, 0.1F, 0.97F});
    if (left == 1) return addPolyps(mesh, habit, to, shoot.key);
    Dice dice{shoot.key};
    const float turn = dice.between(0.0F, kTwoPi);
    for (int child = 0; child < 3; ++child) {
        const glm::mat3 frame =
            frameAbout(shoot.way, turn + kTwoPi * static_cast<float>(child) / 3.0F);
        const float angle = dice.between(0.35F, 0.95F);
        const glm::vec3 next = glm::normalize(shoot.way * std::cos(angle) +
                                              frame[0] * std::sin(angle) + glm::vec3{0, 0.15F, 0});
        const float length = shoot.length * dice.between(0.65F, 0.9F);
        treeBranch(mesh, habit, {to, next, length, dice.seed()}, left - 1);
    }
}

}  // namespace

// A sea fan: one main branch and two beside it, all in one plane.
void growFan(Mesh& mesh, std::size_t level, Dice dice) {
    // By level. Levels with fewer generations have longer branches, so that the fan keeps its size.
    constexpr std::array kGenerations{8, 7, 6, 5, 4};
    constexpr std::array kSides{6, 4, 0, 0, 0};
    constexpr std::array kLonger{1.0F, 1.0F, 1.2F, 1.55F, 2.2F};
    const std::uint32_t seed = dice.seed();
    const FanHabit habit{kGenerations.at(level),
                         kSides.at(level),
                         1.0F + 0.35F * static_cast<float>(level),
                         dice.between(-0.25F, 0.25F)};
    const float length = 0.19F * kLonger.at(level);
    const Surface foot = flesh(0.6F, 0.2F, 0.0F);
    fanBranch(mesh,
              habit,
              {{{0, -0.05F, 0}, 0.028F * habit.broader, foot, 0.5F}, 0.0F, length, seed},
              habit.generations);
    if (level == 4) return;
    for (const float lean : {-0.75F, 0.7F})
        fanBranch(mesh,
                  habit,
                  {{{0, 0.02F, 0}, 0.022F * habit.broader, foot, 0.5F},
                   lean,
                   length,
                   hashOf(seed, lean < 0.0F ? 1 : 2)},
                  habit.generations - 1);
}

// Gorgonian whips: long rods that stand in the current and bend outwards.
void growWhips(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kWhips{15, 15, 13, 10, 7};
    constexpr std::array kSides{6, 4, 0, 0, 0};
    constexpr std::array kJoints{17, 13, 9, 5, 4};
    for (int whip = 0; whip < kWhips.at(level); ++whip) {
        const float turn = kGoldenAngle * static_cast<float>(whip);
        const glm::vec3 side{std::cos(turn), 0, std::sin(turn)};
        const float tall = dice.between(0.55F, 1.0F);
        const float lean = dice.between(0.05F, 0.42F);
        std::vector<Joint> joints;
        for (int i = 0; i < kJoints.at(level); ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(kJoints.at(level) - 1);
            const glm::vec3 at =
                side * (0.04F + lean * std::sqrt(t) * 0.8F) + glm::vec3{0, tall * t - 0.04F, 0};
            joints.push_back({at,
                              (0.016F - 0.006F * t) * (1.0F + 0.22F * static_cast<float>(level)),
                              flesh(0.7F + 0.5F * t, 0.3F, tall * t),
                              0.5F + 0.5F * t});
        }
        addStrand(mesh, joints, kSides.at(level));
    }
}

// Tube sponges: four to six bodies of revolution, open at the top; the inner wall is dark.
void growTubes(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kAround{20, 14, 10, 7, 4};
    const int tubes = 4 + static_cast<int>(3.0F * dice.unit());
    for (int tube = 0; tube < tubes; ++tube) {
        const float turn = kGoldenAngle * static_cast<float>(tube);
        const glm::vec3 side{std::cos(turn), 0, std::sin(turn)};
        const float tall = dice.between(0.45F, 1.0F);
        const float wide = dice.between(0.075F, 0.11F);
        const std::array rings{Ring{0.75F * wide, -0.08F, 0.35F, 0.6F},
                               Ring{0.95F * wide, 0.35F * tall, 0.7F, 0.8F},
                               Ring{1.25F * wide, 0.85F * tall, 0.9F, 0.95F},
                               Ring{1.22F * wide, tall, 1.0F, 1.3F},
                               Ring{0.9F * wide, tall, 0.6F, 0.9F},
                               Ring{0.8F * wide, 0.85F * tall, 0.34F, 0.6F},
                               Ring{0.7F * wide, 0.7F * tall, 0.08F, 0.3F}};
        const std::array few = everySecond(rings);
        addTurned(mesh,
                  level < 4 ? std::span<const Ring>{rings} : few,
                  {.centre = side * dice.between(0.05F, 0.22F),
                   .up = glm::normalize(glm::vec3{0, 1, 0} + side * dice.between(0.0F, 0.5F)),
                   .around = kAround.at(level),
                   .seed = dice.seed(),
                   .wide = 0.14F,
                   .lobes = 1.5F},
                  {.albedo = glm::vec3{0.5F},
                   .roughness = 0.6F,
                   .translucency = 0.2F,
                   .fluorescence = 0.2F});
    }
}

// A barrel sponge: one body of revolution with a ribbed wall, hollow inside.
void growBarrel(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kAround{96, 48, 24, 14, 9};
    const std::array rings{Ring{0.34F, -0.08F, 0.35F, 0.6F},
                           Ring{0.46F, 0.25F, 0.7F, 0.85F},
                           Ring{0.52F, 0.6F, 0.9F, 1.0F},
                           Ring{0.44F, 0.92F, 1.0F, 1.15F},
                           Ring{0.40F, 0.95F, 1.0F, 1.25F},
                           Ring{0.34F, 0.90F, 0.5F, 0.8F},
                           Ring{0.26F, 0.5F, 0.08F, 0.3F}};
    const std::array few = everySecond(rings);
    addTurned(mesh,
              level < 4 ? std::span<const Ring>{rings} : few,
              {.around = kAround.at(level),
               .seed = dice.seed(),
               .wide = 0.22F,
               .high = 0.03F,
               .lobes = 5.0F},
              {.albedo = glm::vec3{0.5F}, .roughness = 0.9F, .translucency = 0.1F});
}

// A leather coral: a stalk and a folded cap.
void growLeather(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kAround{44, 30, 20, 14, 8};
    const float folds = dice.between(0.10F, 0.20F);
    const std::array rings{Ring{0.30F, -0.10F, 0.3F, 0.6F, 0.2F},
                           Ring{0.20F, 0.15F, 0.4F, 0.7F, 0.2F},
                           Ring{0.32F, 0.32F, 0.4F, 0.7F, 0.4F},
                           Ring{0.80F, 0.42F, 0.5F, 0.8F},
                           Ring{0.90F, 0.48F, 0.9F, 1.2F},
                           Ring{0.76F, 0.52F, 1.0F, 1.1F},
                           Ring{0.4F, 0.46F, 0.9F, 1.0F, 0.5F},
                           Ring{0.2F, 0.445F, 0.9F, 1.0F, 0.25F},
                           Ring{0.0F, 0.44F, 0.9F, 1.0F, 0.0F}};
    const std::array few = everySecond(rings);
    addTurned(mesh,
              level < 4 ? std::span<const Ring>{rings} : few,
              {.around = kAround.at(level),
               .seed = dice.seed(),
               .wide = 0.22F,
               .high = folds,
               .lobes = 2.6F},
              {.albedo = glm::vec3{0.5F},
               .roughness = 0.35F,
               .translucency = 0.35F,
               .fluorescence = 0.5F,
               .sway = 0.15F});
}

// A soft tree coral: a translucent trunk whose branches end in clusters of polyps.
void growSoftTree(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kGenerations{4, 4, 4, 3, 2};
    constexpr std::array kSides{8, 6, 4, 0, 0};
    constexpr std::array kRings{6, 4, 3, 2, 2};
    constexpr std::array kAround{12, 8, 6, 5, 5};
    constexpr std::array kBroader{1.0F, 1.0F, 1.05F, 1.5F, 2.2F};
    constexpr std::array kLengths{0.30F, 0.30F, 0.30F, 0.36F, 0.48F};
    const TreeHabit habit{
        kSides.at(level), kRings.at(level), kAround.at(level), kBroader.at(level)};
    const Joint foot{{0, -0.06F, 0}, 0.085F, flesh(0.8F, 0.5F, 0.0F), 0.5F};
    treeBranch(
        mesh, habit, {foot, {0, 1, 0}, kLengths.at(level), dice.seed()}, kGenerations.at(level));
}

// An anemone: a dome covered with tentacles, which sway more towards their tips.
void growAnemone(Mesh& mesh, std::size_t level, Dice dice) {
    // By level; the tentacles become broader as their number falls.
    constexpr std::array kTentacles{190, 150, 110, 50, 14};
    constexpr std::array kSides{6, 4, 0, 0, 0};
    constexpr std::array kDomeRings{6, 5, 4, 3, 2};
    constexpr std::array kDomeAround{28, 20, 14, 9, 7};
    const int tentacles = kTentacles.at(level);
    const float broader = std::sqrt(190.0F / static_cast<float>(tentacles));
    addBall(mesh,
            {.centre = {0, 0.0F, 0},
             .radii = {0.62F, 0.26F, 0.62F},
             .capRadians = 2.0F,
             .rings = kDomeRings.at(level),
             .around = kDomeAround.at(level),
             .lumps = 0.05F},
            flesh(0.55F, 0.3F, 0.0F));
    for (int i = 0; i < tentacles; ++i) {
        const float out = std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(tentacles));
        const float turn = kGoldenAngle * static_cast<float>(i) + 0.6F * dice.unit();
        const float lean = 1.35F * out + 0.3F * (dice.unit() - 0.5F);
        const glm::vec3 way{
            std::sin(lean) * std::cos(turn), std::cos(lean), std::sin(lean) * std::sin(turn)};
        const glm::vec3 foot = way * glm::vec3{0.58F, 0.24F, 0.58F};
        const float length = dice.between(0.30F, 0.46F);
        const float radius = 0.020F * broader;
        const glm::vec3 middle = foot + way * (0.5F * length) + glm::vec3{0, 0.03F, 0};
        const glm::vec3 end = foot + way * length + glm::vec3{0, 0.12F, 0};
        const std::array joints{
            Joint{foot, radius, flesh(0.7F, 0.5F, 0.05F), 0.5F},
            Joint{middle, 0.9F * radius, flesh(0.95F, 0.6F, 0.35F), 0.85F},
            Joint{end, 1.25F * radius, flesh(1.35F, 0.6F, 0.8F), 1.0F},
            Joint{end + 1.2F * radius * way, 0.2F * radius, flesh(1.6F, 0.6F, 0.85F), 1.0F}};
        // The coarsest levels end without a round tip.
        addStrand(
            mesh, std::span{joints}.first(level < 3 ? 4 : 3), kSides.at(level), {0.3F, 0.2F, 0.9F});
    }
}

// A feather star: arms that curl upwards, drawn as leaves with dark and light bands.
void growFeathers(Mesh& mesh, std::size_t level, Dice dice) {
    constexpr std::array kArms{24, 24, 20, 14, 9};
    constexpr std::array kJoints{29, 15, 8, 5, 4};
    for (int arm = 0; arm < kArms.at(level); ++arm) {
        const float turn = kGoldenAngle * static_cast<float>(arm);
        const glm::vec3 out{std::cos(turn), 0, std::sin(turn)};
        const float reach = dice.between(0.7F, 1.0F);
        const float lean = dice.between(0.25F, 1.0F);
        std::vector<Joint> joints;
        for (int i = 0; i < kJoints.at(level); ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(kJoints.at(level) - 1);
            const glm::vec3 at = reach * (out * (lean * std::sin(2.2F * t)) +
                                          glm::vec3{0, t * (1.15F - 0.3F * lean), 0});
            const bool dark = (i + arm) % 2 == 0;
            joints.push_back({at,
                              0.055F * std::sin(0.35F + 2.5F * t),
                              flesh(dark ? 0.55F : 1.25F, 0.6F, 0.7F * t),
                              0.5F + 0.5F * t});
        }
        addLeaf(mesh, joints, {.side = glm::vec3{-out.z, 0, out.x}});
    }
}

}  // namespace aquarama::scene
