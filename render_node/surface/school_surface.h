// SPDX-License-Identifier: Apache-2.0
// The fish of a school on the GPU: culling, level of detail, control points, limit surface (eq. 13,
// paper section 6).
#pragma once

#include <memory>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/body/fish_skin.h"
#include "common/motion/reconstruct.h"
#include "common/motion/repertoire.h"

namespace aquarama {

struct SurfaceOptions {
    bool culling = true;
    bool levelsOfDetail = true;
    std::size_t fish = 64;  // that have room at once; more take turns
    FishSkin skin{};
};

struct SkinPrograms;

struct SurfaceCounts {  // of the last update
    int visible = 0;
    int perLevel[3] = {
        0, 0, 0};  // 0 the control mesh, 1 and 2 the limit surface at that level of refinement
};

class SchoolSurface {
  public:
    SchoolSurface(const FishBody& body,
                  const Repertoire& repertoire,
                  const SurfaceOptions& options,
                  std::shared_ptr<const SkinPrograms> skins);
    ~SchoolSurface();
    SchoolSurface(SchoolSurface&&) noexcept;
    SchoolSurface& operator=(SchoolSurface&&) noexcept;
    SchoolSurface(const SchoolSurface&) = delete;
    SchoolSurface& operator=(const SchoolSurface&) = delete;

    // Culls by a single point against the enlarged frustum, chooses each fish's level by the angle
    // it fills at the shared eye (so that all nodes agree), uploads, and evaluates control points
    // and limit surface in compute shaders.
    void update(std::span<const PresentedFish> fish,
                const glm::mat4& clipFromWorld,
                glm::vec3 sharedEyeMetres);

    // Draws the visible fish with their painted skin (fish.vert, fish.frag), lit and seen through
    // the water by light.glsl. Fins are blended over what is behind them: draw fish after the water
    // and all solid things, before what floats in front. Expects the frame's uniform block to be
    // bound (shaders/frame_uniforms.h).
    void draw() const;

    [[nodiscard]] SurfaceCounts counts() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace aquarama
