// SPDX-License-Identifier: Apache-2.0
// What the golden pictures show that a still can show: tests hold software Mesa to them, and
// tests/bench/gpu says how near a graphics card comes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/support/golden.h"
#include "tests/support/still.h"

namespace aquarama::test {

struct GoldenStill {
    std::string name;  // of tests/golden, without .png
    Still still;
    GoldenLimits limits;
};

// Those whose names begin so; all of them without.
[[nodiscard]] std::vector<GoldenStill> goldenStills(std::string_view beginning = "");

// The reef in water of a type, and the open sea from a depth below its surface.
[[nodiscard]] Still reefIn(config::WaterType type);
[[nodiscard]] Still openSea(float depthMetres);

}  // namespace aquarama::test
