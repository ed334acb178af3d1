// SPDX-License-Identifier: Apache-2.0
// How a level of detail fades into the next coarser one: each of its vertices has a place there, to
// which it moves as the thing gets smaller on the wall. When the levels change, both have the same
// shape. The shaders move them (instance.glsl).
#pragma once

#include "render_node/reef/mesh.h"

namespace aquarama::scene {

// Sets Mesh::coarse of all levels. Patches of equal keys fade into each other. A patch that the
// coarser level lacks shrinks into the nearest part that both have. The coarsest level fades into
// nothing else.
void setCoarse(Levels& levels);

// A place along one direction of a patch: a cell, and the share of the way across it.
struct Step {
    int cell = 0;
    float share = 0.0F;
};
// The i-th of `from` cell borders, as a place among `to` cells. Exact where the cells nest.
[[nodiscard]] Step stepOf(int i, int from, int to);
// The point of a patch of the mesh on the triangles that joinRows() made.
[[nodiscard]] CoarseVertex pointOn(const Mesh& mesh, const Patch& patch, Step down, Step across);

}  // namespace aquarama::scene
