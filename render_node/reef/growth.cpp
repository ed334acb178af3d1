// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/growth.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_node/reef/angles.h"
#include "render_node/reef/fade.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

namespace {

// The functions, in the order of Form.
constexpr std::array<void (*)(Mesh&, std::size_t, Dice), kForms> kGrow{
    growStaghorn, growBush,     growFingers, growTable, growBrain,    growLobes,   growLeaves,
    growCrust,    growFan,      growWhips,   growTubes, growBarrel,   growLeather, growSoftTree,
    growAnemone,  growFeathers, growTurf,    growKelp,  growSeagrass,
};

}  // namespace

Levels grow(Form form, int shape) {
    assert(shape >= 0);
    assert(shape < kShapesOfForm);
    const auto at = static_cast<std::size_t>(form);
    const std::uint32_t seed =
        hashOf(hashOf(static_cast<std::uint32_t>(at)), static_cast<std::uint32_t>(shape));
    Levels levels;
    // Every level starts with the same dice, so that the levels resemble one another.
    for (std::size_t level = 0; level < kLevels; ++level)
        kGrow.at(at)(levels.at(level), level, Dice{seed});
    setCoarse(levels);
    return levels;
}

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// The surface of a leaf. lightness: relative to the tint; sway: share of the height, see Surface.
Surface leaf(float lightness, float sway) {
    return {.albedo = glm::vec3{0.5F * lightness}, .translucency = 0.8F, .sway = sway};
}

// The size of a blade, on a plant of unit height. rows: of the mesh, at least 2. isRibbed: folded
// at its midrib and ruffled.
struct Blade {
    float length, width;
    int rows;
    bool isRibbed;
};

// A blade of kelp: long and narrow, hanging out and up from the stipe, thinnest at its ends. It
// sways with its foot.
void addBlade(Mesh& mesh, glm::vec3 foot, glm::vec3 out, const Blade& blade, Dice& dice) {
    const glm::vec3 side = glm::normalize(glm::cross(out, glm::vec3{0, 1, 0}) +
                                          glm::vec3{0, dice.between(-0.3F, 0.3F), 0});
    const float droop = dice.between(0.1F, 0.65F);
    const float light = dice.between(0.75F, 1.3F);
    std::vector<Joint> joints;
    for (int row = 0; row < blade.rows; ++row) {
        const float v = static_cast<float>(row) / static_cast<float>(blade.rows - 1);
        const glm::vec3 at = foot + blade.length * (out * v - glm::vec3{0, droop * v * v, 0});
        const float broad =
            blade.width * std::pow(std::sin(kPi * (0.05F + 0.93F * std::pow(v, 0.55F))), 0.8F);
        joints.push_back({at,
                          broad,
                          leaf(light * (0.85F + 0.35F * v), foot.y + 0.06F * v),
                          0.45F + 0.55F * foot.y});
    }
    addLeaf(mesh,
            joints,
            {.side = side,
             .ruffle = blade.isRibbed ? 0.55F : 0.0F,
             .waves = 22.0F,
             .phase = 6.0F * dice.unit()});
}

// The axis of the stipe at a share of its height; it leans in x, with the drift.
glm::vec3 stipeAt(float share) {
    return {0.05F * share * share + 0.012F * std::sin(7.0F * share),
            share,
            0.010F * std::sin(9.0F * share)};
}

}  // namespace

// A tuft of filaments and small leaves, which covers rock where nothing else does. The leaves stand
// on a disc in a spiral by the golden angle.
void growTurf(Mesh& mesh, std::size_t level, Dice dice) {
    // By level; the leaves become broader as their number falls.
    constexpr std::array kLeaves{34, 28, 20, 11, 6};
    constexpr std::array kRows{7, 5, 4, 3, 2};
    const int leaves = kLeaves.at(level);
    const float broader = std::sqrt(34.0F / static_cast<float>(leaves));
    for (int i = 0; i < leaves; ++i) {
        const float turn = kGoldenAngle * static_cast<float>(i);
        const float reach = std::sqrt(static_cast<float>(i) / static_cast<float>(leaves));
        const glm::vec3 out{std::cos(turn), 0, std::sin(turn)};
        const float tall = dice.between(0.35F, 0.8F) * (1.1F - 0.5F * reach);
        const float light = dice.between(0.7F, 1.25F);
        std::vector<Joint> joints;
        for (int row = 0; row < kRows.at(level); ++row) {
            const float v = static_cast<float>(row) / static_cast<float>(kRows.at(level) - 1);
            const glm::vec3 at =
                out * (0.75F * reach + 0.35F * tall * v * v) + glm::vec3{0, tall * v - 0.05F, 0};
            joints.push_back({at,
                              0.045F * broader * (1.02F - v),
                              {.albedo = glm::vec3{0.5F * light * (0.55F + 0.6F * v)},
                               .translucency = 0.6F,
                               .sway = 0.6F * v},
                              0.35F + 0.6F * v});
        }
        addLeaf(mesh, joints, {.side = glm::normalize(glm::vec3{-out.z, 0.2F, out.x})});
    }
}

// A stipe of height 1 (drawn at about 7 m) with narrow ruffled blades, each on its float. Coarse
// levels have no floats.
void growKelp(Mesh& mesh, std::size_t level, Dice dice) {
    // By level: blades, rows of a blade, joints of the stipe, sides of the stipe.
    constexpr std::array kBlades{92, 92, 64, 40, 24};
    constexpr std::array kRows{13, 9, 7, 5, 4};
    constexpr std::array kStem{25, 13, 13, 7, 5};
    constexpr std::array kSides{6, 4, 4, 0, 0};
    std::vector<Joint> stem;
    for (int i = 0; i < kStem.at(level); ++i) {
        const float v = static_cast<float>(i) / static_cast<float>(kStem.at(level) - 1);
        stem.push_back({stipeAt(v),
                        0.0028F * (1.0F - 0.5F * v),
                        {.albedo = glm::vec3{0.33F}, .translucency = 0.2F, .sway = v},
                        0.45F + 0.55F * v});
    }
    addStrand(mesh, stem, kSides.at(level));
    const int blades = kBlades.at(level);
    const float broader = std::sqrt(92.0F / static_cast<float>(blades));
    for (int i = 0; i < blades; ++i) {
        const float share =
            std::pow((static_cast<float>(i) + 0.8F) / static_cast<float>(blades), 0.8F);
        const float turn = kGoldenAngle * static_cast<float>(i) + dice.unit();
        const glm::vec3 out = glm::normalize(
            glm::vec3{std::cos(turn) + 0.7F, dice.between(-0.1F, 0.8F), std::sin(turn)});
        const glm::vec3 foot = stipeAt(share);
        // Blades have even keys, floats odd ones.
        mesh.nextKey = 2U * static_cast<std::uint32_t>(i) + 1U;
        if (level < 2)
            addBall(mesh,
                    {.centre = foot + out * 0.007F,
                     .radii = {0.0034F, 0.0048F, 0.0034F},
                     .rings = 3,
                     .around = 5,
                     .lumps = 0.0F},
                    leaf(0.9F, share));
        mesh.nextKey = 2U * static_cast<std::uint32_t>(i) + 2U;
        addBlade(mesh,
                 foot + out * 0.009F,
                 out,
                 {.length = dice.between(0.070F, 0.125F) * (1.1F - 0.35F * share),
                  .width = 0.0052F * broader,
                  .rows = kRows.at(level),
                  .isRibbed = level < 3},
                 dice);
    }
}

// A tuft of narrow leaves from one root, some of them grazed.
void growSeagrass(Mesh& mesh, std::size_t level, Dice dice) {
    // By level; the leaves become broader as their number falls.
    constexpr std::array kLeaves{16, 14, 12, 8, 5};
    constexpr std::array kRows{13, 9, 7, 4, 3};
    const int leaves = kLeaves.at(level);
    const float broader = std::sqrt(16.0F / static_cast<float>(leaves));
    for (int i = 0; i < leaves; ++i) {
        const float turn = kGoldenAngle * static_cast<float>(i) + dice.unit();
        const glm::vec3 out{std::cos(turn), 0, std::sin(turn)};
        const glm::vec3 foot = out * dice.between(0.0F, 0.34F);
        const float tall = dice.between(0.45F, 1.0F);
        const float bend = dice.between(0.15F, 0.6F);
        const float light = dice.between(0.7F, 1.3F);
        std::vector<Joint> joints;
        for (int row = 0; row < kRows.at(level); ++row) {
            const float v = static_cast<float>(row) / static_cast<float>(kRows.at(level) - 1);
            const glm::vec3 at = foot + out * (bend * tall * v * v) +
                                 glm::vec3{0, tall * (v - 0.2F * bend * v * v), 0};
            joints.push_back({at,
                              0.013F * broader * (1.03F - 0.6F * v * v),
                              leaf(light * (0.6F + 0.55F * v), at.y),
                              0.4F + 0.6F * v});
        }
        addLeaf(mesh, joints, {.side = glm::normalize(glm::vec3{-out.z, 0, out.x} + 0.4F * out)});
    }
}

}  // namespace aquarama::scene
