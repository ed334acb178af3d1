// SPDX-License-Identifier: Apache-2.0
// The shaders that pose fish, which the species of a cast share, and those that paint and light a
// species.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/body/fish_body.h"
#include "common/motion/motion_state.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/surface/fish_tables.h"
#include "render_node/surface/visibility.h"

namespace aquarama::surface {

struct SkinPrograms {
    gl::ProgramHandle surface;      // fish.comp
    gl::Replacements replacements;  // of a tier: for the skin shaders
};
[[nodiscard]] std::shared_ptr<const SkinPrograms> makeSkinPrograms(
    gl::Replacements replacements = {});

// What draws the skin of one species: fish_body.frag near, fish_far.frag far and fish_fin.frag with
// its skin shader, shaders/skin_SPECIES.glsl, or plainly where there is none.
struct SkinShader {
    // eye: s, y and radius, body lengths.
    SkinShader(const body::FishSkin& skin, glm::vec3 eye, const gl::Replacements& replacements);

    gl::ProgramHandle nearBody, farBody, fins;
    gl::ProgramHandle fewBody, fewFins, point;  // with the vertex shaders of coarser levels

    // Far bodies have no level finer than 0.
    [[nodiscard]] unsigned bodyOf(int level) const {
        return level == 0 ? farBody.name() : nearBody.name();
    }
};

// All fish of a node on the GPU: from the wire's records to the surfaces that a view draws.
// Culling, level of detail, control points and limit surface (eq. 13, paper sections 4.3 and 6) are
// compute shaders, and the GPU draws what it found: what a frame costs the processor does not
// depend on the number of fish, but for copying their bytes.

struct SurfaceOptions {
    bool culling = true;         // off only to measure what it saves
    bool levelsOfDetail = true;  // off: all are heroes
    DetailLevel finest = DetailLevel::Hero;
    float fineness = 1.0F;  // of the meshes: see detailLimits()
    // Of the surface buffer. Half of the least block that GL drivers allow in practice (128 MiB on
    // software Mesa).
    std::size_t surfaceBytes = std::size_t{64} << 20U;
};

// The school between two ticks, as the wire brings it: at `fraction` of the way from `before` to
// `after`. Without a tick before it is at `after`.
struct SchoolMoment {
    std::span<const motion::FishRecord> before, after;
    float fraction = 1.0F;
};

// One fish that a view draws, as fish_data.glsl has it.
struct DrawnFish {
    glm::vec3 positionMetres{};
    float lengthMetres = 0;
    glm::vec4 rotation{};
    float phase = 0, fromPhase = 0, warpWeight = 0;
    std::uint32_t segment = 0, fromSegment = 0;
    std::uint32_t id = 0, species = 0;
    DetailLevel level = DetailLevel::Point;
    float blend = 0;
    std::uint32_t firstVertex = 0;
    float speed = 0;  // body lengths a second
    std::uint32_t padding = 0;
};
static_assert(sizeof(DrawnFish) == 80);

struct SurfaceCounts {  // of the last look
    std::size_t visible = 0;
    std::array<std::size_t, kDetailLevels> atLevel{};
};

struct SkinPrograms;

class SchoolSurface {
  public:
    SchoolSurface(std::span<const SchoolSpecies> cast,
                  const SurfaceOptions& options,
                  std::shared_ptr<const SkinPrograms> skins);
    ~SchoolSurface();
    SchoolSurface(SchoolSurface&&) noexcept;
    SchoolSurface& operator=(SchoolSurface&&) noexcept;
    SchoolSurface(const SchoolSurface&) = delete;
    SchoolSurface& operator=(const SchoolSurface&) = delete;

    // Once a frame. Records beyond the school's traits are left out.
    void update(const SchoolMoment& moment);

    // Once for each view: culls by a single point against the enlarged frustum, chooses levels by
    // the angle that a fish fills at the shared eye, and sorts what is left. The fish that will be
    // drawn are then bound as shader storage 0.
    void look(const glm::mat4& clipFromWorld, const SharedView& shared);

    // Draw what the last look found, with its painted skin, lit and seen through the water by
    // light.glsl. Expect the frame's uniform block to be bound (shaders/frame_uniforms.h). Bodies
    // are solid things. Points, fish of few triangles and fins are blended over what is behind
    // them: draw them after the water and all solid things, before what floats in front. The order
    // is that of the school, in every frame.
    void drawBodies() const;
    void drawBlended() const;

    // Makes the records readable by shaders that include fish_record.glsl.
    void bindRecords() const;
    [[nodiscard]] std::size_t fishInRecords() const;
    [[nodiscard]] float fraction() const;

    // Waits for the GPU: for tests and benchmarks.
    [[nodiscard]] SurfaceCounts counts() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace aquarama::surface
