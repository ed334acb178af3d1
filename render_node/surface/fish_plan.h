// SPDX-License-Identifier: Apache-2.0
// What the kernels of a view tell each other and the draws, all in one buffer: fish_plan.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/units/limits.h"
#include "render_node/shaders/shader_interface.h"
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

}  // namespace aquarama::surface
