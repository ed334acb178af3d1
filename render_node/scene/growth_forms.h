// SPDX-License-Identifier: Apache-2.0
// Each form at a level of detail, 0 the finest of four; coarser levels have fewer and broader
// parts, so that a thing stays as dense. See growth.h for the frame.
#pragma once

#include <cstddef>

#include "render_node/scene/mesh.h"
#include "render_node/scene/solid_noise.h"

namespace aquarama::scene {

void growStaghorn(Mesh& mesh, std::size_t level, Dice dice);
void growBush(Mesh& mesh, std::size_t level, Dice dice);
void growFingers(Mesh& mesh, std::size_t level, Dice dice);
void growTable(Mesh& mesh, std::size_t level, Dice dice);
void growBrain(Mesh& mesh, std::size_t level, Dice dice);
void growLobes(Mesh& mesh, std::size_t level, Dice dice);
void growLeaves(Mesh& mesh, std::size_t level, Dice dice);
void growCrust(Mesh& mesh, std::size_t level, Dice dice);
void growFan(Mesh& mesh, std::size_t level, Dice dice);
void growWhips(Mesh& mesh, std::size_t level, Dice dice);
void growTubes(Mesh& mesh, std::size_t level, Dice dice);
void growBarrel(Mesh& mesh, std::size_t level, Dice dice);
void growLeather(Mesh& mesh, std::size_t level, Dice dice);
void growSoftTree(Mesh& mesh, std::size_t level, Dice dice);
void growAnemone(Mesh& mesh, std::size_t level, Dice dice);
void growFeathers(Mesh& mesh, std::size_t level, Dice dice);
void growTurf(Mesh& mesh, std::size_t level, Dice dice);
void growKelp(Mesh& mesh, std::size_t level, Dice dice);
void growSeagrass(Mesh& mesh, std::size_t level, Dice dice);

}  // namespace aquarama::scene
