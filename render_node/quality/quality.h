// SPDX-License-Identifier: Apache-2.0
// The tiers of quality.
#pragma once

#include <cstddef>

#include "common/config/rig.h"
#include "render_node/gl/program.h"

namespace aquarama::scene {

// Quality of the light in the sea: waves, caustics, shafts, shadows, snow. Texels count along one
// side of a square texture.
struct LightQuality {
    int waveTexels = 96;
    int rippleTexels = 64;
    // Samples of the surface along the long side of a pixel's footprint.
    int surfaceTaps = 1;
    // Depths at which caustics are drawn.
    int causticLayers = 1;
    int causticTexels = 256;
    // Cells along a side of the grid of refracted light; (cells + 1)^2 vertices must fit 16-bit
    // indices.
    int causticCells = 72;
    // Side of the map of shafts over all directions.
    int shaftTexels = 112;
    // Samples along each direction.
    int shaftSteps = 18;
    // Side of the place's shadow maps; they are drawn only where isFine.
    int shadowTexels = 64;
    int fishShadowTexels = 128;
    // Specks of marine snow.
    int flakes = 6000;
    // Soft shadows, also of fish; a mirrored reef, clouds, coloured rims of caustics.
    bool isFine = false;
};

// Includes that shaders of the tier replace. What a tier omits is not compiled, so that it costs
// nothing even where a driver executes both sides of a branch.
[[nodiscard]] gl::Replacements replacementsOf(const LightQuality& light);

// The settings of a tier of quality.
struct Quality {
    // Pixels of the scene's picture relative to the projector's, along either axis.
    float pictureShare = 1.0F;
    // Samples of a pixel (multisampling), 1 or shaders::kSamples.
    int samples = 1;
    // Blurs the distance by forward scattering in water: 17 texture reads for each pixel.
    bool softening = false;
    // Mip levels of the picture, and a glow of a quarter of its width.
    bool bloom = false;
    // Fish that fill much of the picture are refined a third time.
    bool closeUps = false;
    // Fineness of the meshes of fish: see detailLimits() in surface/visibility.h.
    float fishFineness = 1.0F;
    // Of what visitors have painted: how many of the finest levels are left out.
    std::size_t skinLevelsLeftOut = 0;
    LightQuality light;
    // How finely the place is drawn: at 1 its meshes deviate from smooth shapes by about 0.7 of the
    // wall's finest pixels.
    float placeDetail = 1.0F;
    // How small a thing of the place is still drawn: at 1, a coral of 2.2 pixels.
    float placeReach = 1.0F;
    // Scales of the relief on rock, 1 to 3; at 1 rock is lit at its vertices.
    int rockScales = 1;
    // Plants bend when fish pass.
    bool plantsGiveWay = false;
    // Near corals are lit at each pixel, not at their vertices.
    bool growthAtPixels = false;
};

// All that a tier chooses.
[[nodiscard]] Quality qualityOf(config::QualityTier tier);

}  // namespace aquarama::scene
