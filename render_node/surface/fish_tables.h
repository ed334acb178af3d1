// SPDX-License-Identifier: Apache-2.0
// Tables of a cast that the GPU keeps, and the plan by which the kernels of a view and its draws
// exchange counts and commands (fish_plan.glsl).
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

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/body/fish_body.h"
#include "common/motion/motion_state.h"
#include "common/motion/repertoire.h"
#include "common/skin/limit_table.h"
#include "render_node/gl/handle.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/few_triangles.h"
#include "render_node/surface/visibility.h"

namespace aquarama::surface {

// Surfaces of a view have room for every fish as a mesh, and so much more for those that are
// nearer; in all, so many bytes at most: 60 000 control meshes, or 18 000 meshes, or 4 800 heroes.
// Heroes are placed first. Fish for which no room is left are drawn as few triangles. That needs a
// school denser than one fish in each cube of its length.
inline constexpr std::size_t kMeshBytes = std::size_t{32} << 10U;
inline constexpr std::size_t kNearBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kSurfaceBytes = std::size_t{512} << 20U;
// Without levels of detail, where all fish are heroes: room for 24 000.
inline constexpr std::size_t kMostSurfaceBytes = 5 * kSurfaceBytes;
// They are divided into pages, storage blocks of their own.
inline constexpr std::size_t kMostPages = shaders::kMostPages;
inline constexpr std::size_t kDetailStride = shaders::kDetailStride;
inline constexpr std::size_t kSurfaces = shaders::kSurfaces;
// Few triangles, then one mesh for each level that has a surface.
inline constexpr std::size_t kMeshes = shaders::kMeshes;
inline constexpr std::size_t kTails = shaders::kTails;
static_assert(kSurfaces <= skin::kSurfaceLevels);
// Fish that one workgroup of fish_cull.comp tests.
inline constexpr std::size_t kGroup = shaders::kGroupSize;

// Layout of the plan buffer, as fish_plan.glsl declares it in plain numbers. Written by the GPU;
// the CPU reads only totals, in tests.
struct FishPlan {
    // As glDrawElementsIndirect takes it.
    struct Command {
        std::uint32_t count, instances, firstIndex, firstVertex, firstInstance;
    };
    // Fish of one species and level whose surfaces are in one page.
    struct Piece {
        std::uint32_t firstFish, fish, firstVertex;
    };
    // Workgroups that make its surfaces, as glDispatchComputeIndirect takes them.
    struct Page {
        std::array<std::uint32_t, 3> groups;
        std::uint32_t firstFish;
    };
    template <class T>
    using EachPiece = std::array<std::array<std::array<T, kSurfaces>, kMostSpecies>, kMostPages>;

    // By species and list: how many fish a view shows, and the index of the first of them among
    // the drawn fish.
    std::array<std::array<std::uint32_t, kDetailStride>, kMostSpecies> totals, firsts;
    std::array<Page, kMostPages> pages;
    EachPiece<Piece> pieces;
    // Draws of fish in their own skins, and of those that wear drawings.
    struct Draws {
        EachPiece<Command> bodies, fins;
        // Of a species, those that need no surface.
        std::array<std::array<Command, kTails>, kMostSpecies> tails;
    };
    Draws own, drawn;
};
static_assert(shaders::kMostSpecies == kMostSpecies);
static_assert(sizeof(FishPlan::Command) == 20 && sizeof(FishPlan::Page) == 16);

// Tables of the species: recorded control points, and the meshes of each level of detail, all
// species in the same buffers. Made once.

// One species of a cast and its fish. In the school they follow the fish of the species before it.
struct SchoolSpecies {
    body::FishBody body;
    body::FishSkin skin;
    motion::Repertoire repertoire;
    std::vector<motion::FishTraits> fish;
    // Digest of the files that body and repertoire were read from; without it the tables are not
    // cached.
    std::optional<Digest> source = {};
    bool takesDrawings = false;  // whether its fish may wear what visitors have painted
};

// A recorded control point: place x, y, z in units of motion::kPoseUnit (body lengths), and a
// heading (body::headingsOf()) in units of pi / 32767; 16 bits each.
using RecordedPoint = std::array<std::int16_t, 4>;

// All recorded control points, by segment, phase and control point. Segments that were captured
// without control points get them from their nodal points (paper, section 3.1), so that the GPU
// sees no difference. Throws Error where one is further than a body length from the body frame's
// origin.
[[nodiscard]] std::vector<RecordedPoint> recordedPoints(const body::FishBody& body,
                                                        const motion::Repertoire& repertoire);

// The greatest distance of any control point of any pose from the body frame's origin, in body
// lengths. Poses that are interpolated between recorded ones do not exceed it.
[[nodiscard]] float reachOf(std::span<const RecordedPoint> points);

// Layout of Species in fish_lists.glsl, std430.
struct SpeciesTables {
    // Where the parts of one mesh begin in the shared buffers, and their sizes.
    struct Mesh {
        std::uint32_t vertices, firstEntry, firstParent;
        std::uint32_t firstVertex, bodyIndices, firstBodyIndex, finIndices, firstFinIndex;
    };
    std::uint32_t firstFish = 0, fish = 0, firstGroup = 0, groups = 0;
    // Area seen from the front (x), from above (y) and from the side (z), square body lengths; w:
    // reachOf(), or further where a whip reaches further.
    glm::vec4 area{};
    // Centroid of the side view, body frame, body lengths.
    glm::vec4 middle{};
    std::array<Mesh, kMeshes> meshes{};
};
static_assert(sizeof(SpeciesTables) == 208);

// A vertex of a surface: its place on the skin, and the place on the skin from which it fades in at
// the next coarser level.
struct SurfaceVertex {
    skin::SkinPlace place;
    glm::vec4 coarserRest{};
    glm::vec2 coarserFin{};
};
static_assert(sizeof(SurfaceVertex) == 52);

// The same tables as arrays, before they are uploaded. Indices count within each array.
struct FishArrays {
    std::vector<SpeciesTables> species;
    std::vector<RecordedPoint> recorded;
    std::vector<std::uint32_t> firstEntry, parents, indices;
    std::vector<skin::StencilEntry> entries;
    std::vector<SurfaceVertex> places;
    std::vector<FewTriangles::Vertex> fewVertices;
    std::vector<std::uint32_t> fewIndices;

    // All arrays, for the cache of derived data.
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

// Makes the tables of a cast. finest: index of the finest surface, 0 to kSurfaces - 1. Where every
// species has a source, the tables come from the cache of derived data. Throws Error: too many
// species, a control point out of range.
[[nodiscard]] FishArrays fishArrays(std::span<const SchoolSpecies> cast, std::size_t finest);

// The tables on the GPU. Construct, use and destroy them with the same context current.
struct FishTables {
    FishTables(const FishArrays& arrays, std::size_t finest);

    // Vertices of the largest surface of any species.
    std::size_t mostVertices = 1;
    // Workgroups of fish_cull.comp for the whole school.
    std::size_t groups = 0;
    gl::Buffer cast, recorded, firstEntries, entries, parents, places, indices;
    gl::Texture poses{GL_TEXTURE_BUFFER};  // the recorded points
    gl::Buffer fewVertices, fewIndices;
};

}  // namespace aquarama::surface
