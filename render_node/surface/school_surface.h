// SPDX-License-Identifier: Apache-2.0
// Draws all fish of a node on the GPU, and the programs for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/body/fish_body.h"
#include "common/body/side_skin.h"
#include "common/motion/motion_state.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/surface/fish_tables.h"
#include "render_node/surface/school_records.h"
#include "render_node/surface/visibility.h"

namespace aquarama::surface {

// The program that makes surfaces, which all species share, and the includes of a tier. Several
// schools of one context may share it.
struct SkinPrograms {
    // fish.comp
    gl::ProgramHandle surface;
    // Includes that the tier replaces in the skin shaders.
    gl::Replacements replacements;
};
// Compiles them; needs a current context.
[[nodiscard]] std::shared_ptr<const SkinPrograms> makeSkinPrograms(
    gl::Replacements replacements = {});

// A program of these shaders with the species' skin shader and its constants. Needs a current
// context.
[[nodiscard]] gl::ProgramHandle skinProgram(const std::vector<std::string>& shaderFiles,
                                            const body::FishSkin& skin,
                                            gl::Replacements replacements);

// What the fish of a species wear.
enum class Worn : std::uint8_t { Own, Drawing };

// The programs of one species: fish_body.frag near, fish_far.frag far, and fish_fin.frag, each with
// the species' skin shader, shaders/skin_SPECIES.glsl, or skin_plain.glsl where there is none. For
// fish that wear drawings, drawn_skin.glsl has the colours.
struct SkinShader {
    SkinShader(const SchoolSpecies& species, Worn worn, const gl::Replacements& tier);

    gl::ProgramHandle nearBody, farBody, fins;
    // The same fragment shaders with the vertex shaders of the coarser levels.
    gl::ProgramHandle fewBody, fewFins, point;

    // The program for bodies at a surface level (0 is the control mesh, which is always far).
    [[nodiscard]] unsigned bodyOf(int level) const {
        return level == 0 ? farBody.name() : nearBody.name();
    }

  private:
    SkinShader(const body::FishSkin& skin, const gl::Replacements& replacements);
};

// Makes the surfaces that a view draws from the wire's records. Culling, level of detail, control
// points and limit surface (eq. 13, paper sections 4.3 and 6) are compute shaders, and the GPU
// draws their results. The processor's cost of a frame does not depend on the number of fish,
// except for copying their records.

// Fixed for the life of a SchoolSurface.
struct SurfaceOptions {
    // Switched off only to measure what culling saves.
    bool culling = true;
    // Switched off, all fish are heroes.
    bool levelsOfDetail = true;
    DetailLevel finest = DetailLevel::Hero;
    // Fineness of the meshes: see detailLimits().
    float fineness = 1.0F;
    // The finest levels of drawn skins that are left out.
    std::size_t skinLevelsLeftOut = 0;
    // Size of a page of surfaces, bytes; no page is larger than half of the driver's limit for a
    // block, which is 128 MiB on software Mesa. Each page costs a draw of each species.
    std::size_t pageBytes = kSurfaceBytes;
};

// Layout of Fish in fish_data.glsl, std430: one fish that a view draws.
struct DrawnFish {
    glm::vec3 positionMetres{};
    float lengthMetres = 0;
    glm::vec4 rotation{};
    float phase = 0, fromPhase = 0, warpWeight = 0;
    std::uint32_t action = 0, fromAction = 0;
    std::uint32_t id = 0, species = 0;
    DetailLevel level : 16 = DetailLevel::Point;
    std::uint32_t drawing : 16 = 0;  // 1 + its layer of the drawn skins; 0: its own skin
    float blend = 0;
    std::uint32_t firstVertex = 0;
    // Body lengths a second.
    float speed = 0;
    float spread = 0;
    // Body frame, unit; and how far its mouth is open by its record, 0 to 1.
    glm::vec3 gaze{};
    float mouth = 0;
};
static_assert(sizeof(DrawnFish) == 96);

// How many fish the last look() found, in all and at each level.
struct SurfaceCounts {
    std::size_t visible = 0;
    std::array<std::size_t, kDetailLevels> atLevel{};
    // Of those at levels that have a surface: for these no page had room, and they are drawn
    // as few triangles.
    std::size_t withoutRoom = 0;
};

struct SkinPrograms;

// For each frame update(), for each view look(), then the draws. Owns its GL objects; construct,
// use and destroy it with the same context current.
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

    // Drawings that fish wear from now on, by the numbers that records name. A fish without one, or
    // of a species that takes none, keeps the skin of its species. Of those that are new, `most`
    // are uploaded at once: each takes about a millisecond.
    void wear(const body::SkinsByNumber& skins, std::size_t most);

    // Uploads the records of a frame. Records beyond the cast's fish are ignored.
    void update(const SchoolMoment& moment);

    // Prepares the draws of a view: culls each fish by one point against the enlarged frustum,
    // chooses its level by the angle that it fills at the shared eye, and sorts the visible ones by
    // species and level. The drawn fish are then bound as shader storage 0.
    void look(const glm::mat4& clipFromWorld, const SharedView& shared);

    // Draw what the last look() found, with painted skin, lit and seen through the water
    // (light.glsl). They expect the frame's uniform block to be bound (shaders/frame_uniforms.h).
    // Bodies are opaque. Points, fish of few triangles and fins are blended with what is behind
    // them: draw them after the water and all opaque things, before what floats in front. The order
    // is always that of the school.
    void drawBodies() const;
    void drawBlended() const;

    // Binds the records for shaders that include fish_record.glsl.
    void bindRecords() const;
    // Number of fish in the last update(), and its fraction.
    [[nodiscard]] std::size_t fishInRecords() const;
    [[nodiscard]] float fraction() const;

    // Reads the counts back and waits for the GPU: for tests and benchmarks.
    [[nodiscard]] SurfaceCounts counts() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace aquarama::surface
