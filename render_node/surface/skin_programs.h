// SPDX-License-Identifier: Apache-2.0
// The shaders that pose, paint and light fish, which the species of a cast share.
#pragma once

#include <memory>

#include <glm/vec3.hpp>

#include "common/body/fish_skin.h"
#include "render_node/gl/handle.h"

namespace aquarama {

struct SkinPrograms {
    SkinPrograms();

    gl::ProgramHandle surface;  // fish.comp
    gl::ProgramHandle nearScad, farScad, scadFins, reefFish, reefFins;

    // The program for the bodies of a species at a level of detail, and for its fins.
    [[nodiscard]] unsigned bodyOf(SkinPattern pattern, int level) const;
    [[nodiscard]] unsigned finsOf(SkinPattern pattern) const;
    // Gives the program in use what it needs to know of the species. eye: s, y and radius, body
    // lengths.
    void dress(unsigned program, const FishSkin& skin, glm::vec3 eye) const;
};
[[nodiscard]] std::shared_ptr<const SkinPrograms> makeSkinPrograms();

}  // namespace aquarama
