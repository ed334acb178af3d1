// SPDX-License-Identifier: Apache-2.0
#include "render_node/water/waves.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {
namespace {

constexpr std::uint32_t kSeed = 1;

void expectOnTile(const Waves& waves, float tileMetres, double pace) {
    for (const Wave& wave : waves) {
        const glm::dvec2 onTile =
            wave.number * (static_cast<double>(tileMetres) / (2.0 * std::numbers::pi));
        EXPECT_NEAR(onTile.x, std::round(onTile.x), 1e-9);
        EXPECT_NEAR(onTile.y, std::round(onTile.y), 1e-9);
        const double number = glm::length(wave.number);
        EXPECT_NEAR(wave.frequency * wave.frequency,
                    pace * pace * number * (9.81 + 7.4e-5 * number * number),
                    1e-9 * number);
    }
}

TEST(Waves, fitTheirTilesAndFocusOnTheSand) {
    const Sea sea = seaOf(kSeed, place::kMeanFloorDepthMetres);
    expectOnTile(sea.waves, shaders::kTileMetres, 0.55);
    expectOnTile(sea.ripples, shaders::kRippleTileMetres, 1.0);
    const double focus = focusNumber(sea.waves, static_cast<double>(place::kMeanFloorDepthMetres));
    EXPECT_GT(focus, 0.45);
    EXPECT_LT(focus, 0.70);
}

// As they are seen from below (waves 1.5 times steeper, as in water_surface.frag): Cox and Munk
// 1954 measured 0.003 + 0.00512 U, U the wind in m/s.
TEST(Waves, areAsSteepAsInALightBreeze) {
    const Sea sea = seaOf(kSeed, place::kMeanFloorDepthMetres);
    const double square =
        std::pow(1.5 * steepness(sea.waves), 2) + std::pow(steepness(sea.ripples), 2);
    EXPECT_GT(square, 0.003 + 0.00512 * 2.0);
    EXPECT_LT(square, 0.003 + 0.00512 * 7.0);
}

TEST(Waves, keepTheirPhaseForMonths) {
    const Sea sea = seaOf(kSeed, place::kMeanFloorDepthMetres);
    constexpr double kMonth = 30.0 * 86400.0;
    const auto expectPhase = [](const Wave& wave, float phase) {
        const double exact =
            std::remainder(wave.phase - wave.frequency * kMonth - static_cast<double>(phase),
                           2.0 * std::numbers::pi);
        EXPECT_NEAR(exact, 0.0, 1e-5);
    };
    const SeaNow now = seaAt(sea, kMonth);
    for (std::size_t i = 0; i < kWaves; ++i) {
        expectPhase(sea.waves[i], now.waves[i].w);
        expectPhase(sea.ripples[i], now.ripples[i].w);
    }
}

}  // namespace
}  // namespace aquarama::scene
