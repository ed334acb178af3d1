// SPDX-License-Identifier: Apache-2.0
// The forms of corals, sponges and plants on a reef. Each form has a few shapes, and each shape
// five levels of detail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render_node/reef/mesh.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

// The forms. Their order is that of the prototypes (scatter.h), of kGrow in growth.cpp, and of
// ranges that are compared with < and >=.
enum class Form : std::uint8_t {
    // Hard corals.
    Staghorn,
    Bush,
    Fingers,
    Table,
    Brain,
    Lobes,
    Leaves,
    Crust,
    // Soft ones, sponges and their company.
    Fan,
    Whips,
    Tubes,
    Barrel,
    Leather,
    SoftTree,
    Anemone,
    Feathers,
    // Plants.
    Turf,
    Kelp,
    Seagrass,
};
// The number of forms, and of shapes of each.
inline constexpr std::size_t kForms = 19;
inline constexpr int kShapesOfForm = 3;

// Grows one shape of a form, the same on every machine. In a frame of its own: y up, the foot at
// the origin, about 1 in size. Albedos are relative: 0.5 stands for the tint of the instance.
// shape: 0 to kShapesOfForm - 1.
[[nodiscard]] Levels grow(Form form, int shape);

// One function for each form. Each appends the form at a level of detail, 0 the finest of five, to
// an empty mesh; the dice choose the shape. Coarser levels have fewer and broader parts, so that
// the form remains as dense.

// Each adds one form at a level of detail, 0 the finest, in metres about the origin; the dice
// decide its branches.
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
