// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "render_node/reef/scatter.h"

namespace aquarama::scene {

namespace {

// Albedos in linear Rec. 709; the first is chosen most often.
using Colours = std::array<glm::vec3, 3>;

// Forms that are coloured alike: a form has the hues of its kind, not every hue.
enum class Kind : std::uint8_t { Branching, Plates, Massive, Fans, Sponges, Soft };
constexpr std::size_t kKinds = 6;
// What grows in one kind of patch, by kind of form.
using Harmony = std::array<Colours, kKinds>;

// Five harmonies, one for a patch of the reef. In each, massive corals are the darkest and
// branching ones the palest; fans, sponges and soft corals have the strong colours, of hues that
// stand against each other.
constexpr std::array<Harmony, 5> kHarmonies{
    // Gold with crimson.
    Harmony{Colours{glm::vec3{0.69F, 0.46F, 0.11F}, {0.66F, 0.36F, 0.03F}, {0.71F, 0.54F, 0.28F}},
            Colours{glm::vec3{0.63F, 0.33F, 0.03F}, {0.49F, 0.24F, 0.03F}, {0.72F, 0.47F, 0.10F}},
            Colours{glm::vec3{0.46F, 0.32F, 0.03F}, {0.37F, 0.24F, 0.03F}, {0.59F, 0.40F, 0.11F}},
            Colours{glm::vec3{0.66F, 0.06F, 0.08F}, {0.74F, 0.15F, 0.04F}, {0.49F, 0.04F, 0.10F}},
            Colours{glm::vec3{0.37F, 0.09F, 0.23F}, {0.76F, 0.39F, 0.03F}, {0.45F, 0.14F, 0.08F}},
            Colours{glm::vec3{0.78F, 0.32F, 0.12F}, {0.73F, 0.47F, 0.20F}, {0.74F, 0.12F, 0.14F}}},
    // Violet with yellow.
    Harmony{Colours{glm::vec3{0.42F, 0.29F, 0.68F}, {0.56F, 0.39F, 0.62F}, {0.67F, 0.52F, 0.46F}},
            Colours{glm::vec3{0.47F, 0.25F, 0.40F}, {0.37F, 0.20F, 0.32F}, {0.63F, 0.41F, 0.48F}},
            Colours{glm::vec3{0.52F, 0.38F, 0.21F}, {0.40F, 0.25F, 0.26F}, {0.64F, 0.47F, 0.26F}},
            Colours{glm::vec3{0.49F, 0.09F, 0.49F}, {0.35F, 0.11F, 0.53F}, {0.76F, 0.52F, 0.03F}},
            Colours{glm::vec3{0.81F, 0.56F, 0.03F}, {0.42F, 0.19F, 0.56F}, {0.69F, 0.46F, 0.07F}},
            Colours{glm::vec3{0.59F, 0.29F, 0.62F}, {0.70F, 0.48F, 0.53F}, {0.50F, 0.13F, 0.46F}}},
    // Coral red with khaki.
    Harmony{Colours{glm::vec3{0.77F, 0.30F, 0.19F}, {0.70F, 0.42F, 0.23F}, {0.73F, 0.21F, 0.15F}},
            Colours{glm::vec3{0.64F, 0.25F, 0.06F}, {0.54F, 0.17F, 0.05F}, {0.75F, 0.43F, 0.18F}},
            Colours{glm::vec3{0.44F, 0.30F, 0.11F}, {0.39F, 0.20F, 0.08F}, {0.56F, 0.39F, 0.20F}},
            Colours{glm::vec3{0.82F, 0.27F, 0.03F}, {0.72F, 0.11F, 0.05F}, {0.77F, 0.39F, 0.06F}},
            Colours{glm::vec3{0.74F, 0.15F, 0.03F}, {0.55F, 0.10F, 0.07F}, {0.79F, 0.33F, 0.05F}},
            Colours{glm::vec3{0.78F, 0.14F, 0.20F}, {0.76F, 0.34F, 0.25F}, {0.63F, 0.05F, 0.15F}}},
    // Green and lime with lilac.
    Harmony{Colours{glm::vec3{0.47F, 0.47F, 0.03F}, {0.34F, 0.51F, 0.12F}, {0.63F, 0.55F, 0.18F}},
            Colours{glm::vec3{0.32F, 0.37F, 0.05F}, {0.43F, 0.38F, 0.05F}, {0.29F, 0.29F, 0.09F}},
            Colours{glm::vec3{0.26F, 0.35F, 0.07F}, {0.41F, 0.34F, 0.03F}, {0.25F, 0.25F, 0.08F}},
            Colours{glm::vec3{0.76F, 0.56F, 0.03F}, {0.54F, 0.29F, 0.56F}, {0.73F, 0.33F, 0.05F}},
            Colours{glm::vec3{0.52F, 0.29F, 0.59F}, {0.60F, 0.40F, 0.08F}, {0.38F, 0.17F, 0.42F}},
            Colours{glm::vec3{0.61F, 0.57F, 0.17F}, {0.68F, 0.63F, 0.39F}, {0.53F, 0.29F, 0.55F}}},
    // Rose and rust.
    Harmony{Colours{glm::vec3{0.71F, 0.29F, 0.42F}, {0.69F, 0.45F, 0.45F}, {0.62F, 0.36F, 0.18F}},
            Colours{glm::vec3{0.57F, 0.25F, 0.23F}, {0.50F, 0.28F, 0.10F}, {0.66F, 0.37F, 0.37F}},
            Colours{glm::vec3{0.43F, 0.22F, 0.10F}, {0.49F, 0.30F, 0.13F}, {0.38F, 0.16F, 0.16F}},
            Colours{glm::vec3{0.62F, 0.05F, 0.16F}, {0.70F, 0.15F, 0.30F}, {0.79F, 0.35F, 0.18F}},
            Colours{glm::vec3{0.75F, 0.41F, 0.46F}, {0.50F, 0.13F, 0.18F}, {0.75F, 0.29F, 0.06F}},
            Colours{glm::vec3{0.76F, 0.41F, 0.47F}, {0.73F, 0.55F, 0.49F}, {0.70F, 0.10F, 0.30F}}},
};
// Turf has one palette everywhere, and so have anemones.
constexpr Colours kTurfColours{
    glm::vec3{0.26F, 0.22F, 0.07F}, {0.20F, 0.22F, 0.07F}, {0.34F, 0.20F, 0.12F}};
constexpr Colours kAnemoneColours{
    glm::vec3{0.50F, 0.36F, 0.15F}, {0.36F, 0.42F, 0.16F}, {0.54F, 0.32F, 0.30F}};

// Of a coral, a sponge or a feather star.
Kind kindOf(Form form) {
    switch (form) {
        case Form::Staghorn:
        case Form::Bush:
        case Form::Fingers:
            return Kind::Branching;
        case Form::Table:
        case Form::Leaves:
            return Kind::Plates;
        case Form::Brain:
        case Form::Lobes:
        case Form::Crust:
            return Kind::Massive;
        case Form::Fan:
        case Form::Whips:
            return Kind::Fans;
        case Form::Tubes:
        case Form::Barrel:
            return Kind::Sponges;
        default:
            return Kind::Soft;
    }
}

// A random colour of three: half have the first.
glm::vec3 oneOf(const Colours& colours, Dice& dice) {
    const float pick = dice.unit();
    return colours.at(pick < 0.5F ? 0 : pick < 0.8F ? 1 : 2);
}

}  // namespace

glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice) {
    const float bright = dice.between(0.82F, 1.15F);
    if (form == Form::Kelp) return glm::vec3{0.74F, 0.40F, 0.045F} * bright;
    if (form == Form::Seagrass) return glm::vec3{0.19F, 0.26F, 0.055F} * bright;
    if (form == Form::Turf) return oneOf(kTurfColours, dice) * bright;
    if (form == Form::Anemone) return oneOf(kAnemoneColours, dice) * bright;
    const Harmony& harmony = kHarmonies.at(patch % kHarmonies.size());
    return oneOf(harmony.at(static_cast<std::size_t>(kindOf(form))), dice) * bright;
}

}  // namespace aquarama::scene
