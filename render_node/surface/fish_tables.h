// SPDX-License-Identifier: Apache-2.0
// What the kernels of a view tell each other and the draws, all in one buffer: fish_plan.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/body/fish_body.h"
#include "common/motion/motion_state.h"
#include "common/motion/repertoire.h"
#include "common/skin/limit_table.h"
#include "common/units/digest.h"
#include "common/units/units.h"
#include "render_node/gl/handle.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/few_triangles.h"
#include "render_node/surface/visibility.h"

namespace aquarama::surface {

// The surface buffer is filled so often at most for one view. With its 64 MiB that is room for
// 78 000 control meshes, or 19 000 meshes, or 4 900 heroes; heroes come first. Fish beyond are
// drawn as few triangles. It takes more than a fish in each cube of its length to get there.
inline constexpr std::size_t kTurns = shaders::kTurns;
inline constexpr std::size_t kDetailStride = shaders::kDetailStride;
inline constexpr std::size_t kSurfaces = shaders::kSurfaces;
inline constexpr std::size_t kMeshes = 1 + kSurfaces;
inline constexpr std::size_t kTails = shaders::kTails;
static_assert(kTails == 2 * kMeshes + 1);
inline constexpr std::size_t kGroup =
    shaders::kGroupSize;  // fish that one workgroup of fish_cull.comp looks at

struct FishPlan {
    struct Command {  // as glDrawElementsIndirect takes it
        std::uint32_t count, instances, firstIndex, firstVertex, firstInstance;
    };
    struct Piece {
        std::uint32_t firstFish, fish, firstVertex;
    };
    struct Turn {
        std::array<std::uint32_t, 3> bodyGroups,
            finGroups;  // as glDispatchComputeIndirect takes it
        std::uint32_t firstFish, padding;
    };
    template <class T>
    using EachPiece = std::array<std::array<std::array<T, kSurfaces>, kMostSpecies>, kTurns>;

    std::array<std::array<std::uint32_t, kDetailStride>, kMostSpecies> totals, firsts;
    std::array<Turn, kTurns> turns;
    EachPiece<Piece> pieces;
    EachPiece<Command> bodies, fins;
    std::array<std::array<Command, kTails>, kMostSpecies> tails;
};
static_assert(shaders::kMostSpecies == kMostSpecies);
static_assert(sizeof(FishPlan::Command) == 20 && sizeof(FishPlan::Turn) == 32);

// What the GPU keeps of the species of a cast: recorded control points, and the meshes of each
// level of detail, all in the same few buffers. Made once.

// The fish of one species of a school, which follow those of the species before it.
struct SchoolSpecies {
    body::FishBody body;
    body::FishSkin skin;
    motion::Repertoire repertoire;
    std::vector<motion::FishTraits> fish;
    std::optional<Digest> source = {};  // of the files that body and repertoire were read from
};

// A place, body lengths, and a heading (headingsOf()), half turns: 16 bits each.
using RecordedPoint = std::array<std::int16_t, 4>;

// By segment, phase and control point. Of segments that were captured without control points they
// are computed from the nodal points (paper, section 3.1), so that the GPU sees no difference.
// Throws Error where one lies further than a body length from the body frame's origin.
[[nodiscard]] std::vector<RecordedPoint> recordedPoints(const body::FishBody& body,
                                                        const motion::Repertoire& repertoire);

// How far from the body frame's origin any control point of any pose gets, in body lengths. Poses
// between recorded ones get no further.
[[nodiscard]] float reachOf(std::span<const RecordedPoint> points);

// What shaders know of a species, as fish_lists.glsl has it.
struct SpeciesTables {
    struct Mesh {
        std::uint32_t vertices, firstEntry, firstParent;
        std::uint32_t firstVertex, bodyIndices, firstBodyIndex, finIndices, firstFinIndex;
    };
    std::uint32_t firstFish = 0, fish = 0, firstGroup = 0, groups = 0;
    glm::vec4 area{};    // seen from the front, from above, from the side: square body lengths; w:
                         // reachOf()
    glm::vec4 middle{};  // of the body, in its frame, body lengths
    std::array<Mesh, kMeshes> meshes{};
};
static_assert(sizeof(SpeciesTables) == 208);

// A vertex of a surface, and what is painted where the next coarser level has it.
struct SurfaceVertex {
    skin::SkinPlace place;
    glm::vec4 coarserRest{};
    glm::vec2 coarserFin{};
};
static_assert(sizeof(SurfaceVertex) == 52);

// What the GPU keeps of the species of a cast, before it goes there.
struct FishArrays {
    std::vector<SpeciesTables> species;
    std::vector<RecordedPoint> recorded;
    std::vector<std::uint32_t> firstEntry, parents, indices;
    std::vector<skin::StencilEntry> entries;
    std::vector<SurfaceVertex> places;
    std::vector<FewTriangles::Vertex> fewVertices;
    std::vector<std::uint32_t> fewIndices;

    auto arrays() {
        return std::tie(species,
                        recorded,
                        firstEntry,
                        parents,
                        indices,
                        entries,
                        places,
                        fewVertices,
                        fewIndices);
    }
};

// finest: of the surfaces, 0 .. kSurfaces - 1; there are none beyond. Made once on a machine, where
// each species says what it was made from: derived data. Throws Error.
[[nodiscard]] FishArrays fishArrays(std::span<const SchoolSpecies> cast, std::size_t finest);

struct FishTables {
    FishTables(const FishArrays& arrays, std::size_t finest);

    std::size_t mostVertices = 1;  // of a fish
    std::size_t groups = 0;
    gl::Buffer cast, recorded, firstEntries, entries, parents, places, indices;
    gl::Buffer fewVertices, fewIndices;
};

}  // namespace aquarama::surface
