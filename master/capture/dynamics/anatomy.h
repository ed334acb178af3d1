// SPDX-License-Identifier: Apache-2.0
// The biomechanical fish's connections: 23 nodal points, 91 spring-damper units of which 12 are
// muscles, and the faces that push water (Tu & Terzopoulos 1994; the paper's Fig. 1).
#pragma once

#include <array>
#include <cstdint>

#include "common/body/fish_body.h"

namespace aquarama::capture {

inline constexpr int kUnits = 91;
inline constexpr int kMuscles = 12;
inline constexpr int kDragFaces = 78;

enum class UnitKind : std::uint8_t { Normal, Cross, FrontMuscle, MiddleMuscle, BackMuscle };
enum class Side : std::uint8_t { Neither, Left, Right };

// A spring with a damper between two nodal points; first < second.
struct Unit {
    std::uint8_t first = 0;
    std::uint8_t second = 0;
    UnitKind kind = UnitKind::Normal;
    Side side = Side::Neither;
    friend auto operator<=>(const Unit&, const Unit&) = default;
};

// A triangle of the surface, outward when seen counter-clockwise. Quads are split along both
// diagonals, each half counting half: along one alone, the fish would not be its own mirror image
// and would drift.
struct DragFace {
    std::array<std::uint8_t, 3> nodes{};
    double weight = 1;
};

struct Anatomy {
    std::array<Unit, kUnits> units;
    std::array<DragFace, kDragFaces> faces;
};
[[nodiscard]] const Anatomy& anatomy();

// The node that takes a node's place in a mirror.
[[nodiscard]] int mirroredLeftRight(int node);
[[nodiscard]] int mirroredTopBottom(int node);

}  // namespace aquarama::capture
