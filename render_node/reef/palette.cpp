// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

#include "render_node/reef/scatter.h"

namespace aquarama::scene {

namespace {

// A palette, linear Rec. 709 albedos; the first colours are chosen most often.
using Colours = std::array<glm::vec3, 5>;

// Palettes of hard coral, one for a kind of patch: brown by its algae, with ochre, olive, cream,
// lavender or rose.
constexpr std::array<Colours, 5> kHard{
    Colours{glm::vec3{0.66F, 0.38F, 0.10F},
            {0.72F, 0.44F, 0.10F},
            {0.80F, 0.60F, 0.28F},
            {0.42F, 0.22F, 0.08F},
            {0.54F, 0.40F, 0.09F}},
    Colours{glm::vec3{0.56F, 0.28F, 0.40F},
            {0.48F, 0.24F, 0.18F},
            {0.80F, 0.60F, 0.42F},
            {0.52F, 0.32F, 0.48F},
            {0.64F, 0.38F, 0.18F}},
    Colours{glm::vec3{0.76F, 0.30F, 0.18F},
            {0.58F, 0.27F, 0.10F},
            {0.82F, 0.54F, 0.28F},
            {0.68F, 0.36F, 0.10F},
            {0.46F, 0.24F, 0.12F}},
    Colours{glm::vec3{0.50F, 0.40F, 0.07F},
            {0.64F, 0.44F, 0.10F},
            {0.38F, 0.28F, 0.07F},
            {0.78F, 0.56F, 0.20F},
            {0.56F, 0.28F, 0.09F}},
    Colours{glm::vec3{0.68F, 0.44F, 0.20F},
            {0.50F, 0.26F, 0.09F},
            {0.84F, 0.64F, 0.36F},
            {0.62F, 0.32F, 0.28F},
            {0.40F, 0.22F, 0.09F}},
};
// Palettes of fans, sponges and soft corals: one hue dominates a patch.
constexpr std::array<Colours, 5> kSoft{
    Colours{glm::vec3{0.62F, 0.34F, 0.10F},
            {0.66F, 0.44F, 0.12F},
            {0.56F, 0.26F, 0.10F},
            {0.64F, 0.50F, 0.24F},
            {0.60F, 0.36F, 0.14F}},
    Colours{glm::vec3{0.42F, 0.18F, 0.44F},
            {0.50F, 0.24F, 0.46F},
            {0.36F, 0.18F, 0.36F},
            {0.56F, 0.34F, 0.50F},
            {0.58F, 0.46F, 0.30F}},
    Colours{glm::vec3{0.60F, 0.16F, 0.14F},
            {0.56F, 0.20F, 0.12F},
            {0.64F, 0.30F, 0.20F},
            {0.50F, 0.14F, 0.18F},
            {0.60F, 0.42F, 0.26F}},
    Colours{glm::vec3{0.62F, 0.48F, 0.16F},
            {0.54F, 0.42F, 0.18F},
            {0.66F, 0.54F, 0.24F},
            {0.48F, 0.36F, 0.14F},
            {0.56F, 0.30F, 0.12F}},
    Colours{glm::vec3{0.58F, 0.24F, 0.34F},
            {0.64F, 0.34F, 0.38F},
            {0.52F, 0.20F, 0.30F},
            {0.62F, 0.46F, 0.38F},
            {0.46F, 0.22F, 0.36F}},
};
// Rare strong colours of soft corals, in any patch.
constexpr Colours kAccents{glm::vec3{0.70F, 0.10F, 0.30F},
                           {0.80F, 0.30F, 0.05F},
                           {0.78F, 0.58F, 0.06F},
                           {0.62F, 0.06F, 0.08F},
                           {0.46F, 0.20F, 0.62F}};
// Turf has one palette everywhere.
constexpr Colours kTurfColours{glm::vec3{0.24F, 0.22F, 0.07F},
                               {0.30F, 0.24F, 0.10F},
                               {0.20F, 0.22F, 0.07F},
                               {0.34F, 0.20F, 0.13F},
                               {0.28F, 0.26F, 0.09F}};

// Forms that take the palettes of soft corals.
bool isSoft(Form form) {
    return form >= Form::Fan && form <= Form::Feathers && form != Form::Leather &&
           form != Form::Anemone;
}

// A random colour of a palette.
glm::vec3 oneOf(const Colours& colours, Dice& dice) {
    // Cumulated probabilities: the first two colours are two thirds.
    const float pick = dice.unit();
    constexpr std::array kUpTo{0.40F, 0.66F, 0.82F, 0.92F, 1.0F};
    std::size_t at = 0;
    while (pick > kUpTo.at(at)) ++at;
    return colours.at(at);
}

}  // namespace

glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice) {
    const float bright = dice.between(0.82F, 1.15F);
    if (form == Form::Kelp) return glm::vec3{0.74F, 0.40F, 0.045F} * bright;
    if (form == Form::Seagrass) return glm::vec3{0.19F, 0.26F, 0.055F} * bright;
    if (form == Form::Turf) return oneOf(kTurfColours, dice) * bright;
    if (form == Form::Anemone) return glm::vec3{0.58F, 0.46F, 0.24F} * bright;
    const bool soft = isSoft(form);
    if (soft && dice.unit() < 0.16F) return oneOf(kAccents, dice) * bright;
    return oneOf((soft ? kSoft : kHard).at(patch % kHard.size()), dice) * bright;
}

}  // namespace aquarama::scene
