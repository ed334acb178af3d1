// SPDX-License-Identifier: Apache-2.0
// The tiers of quality, and the viewpoint from which the detail of a frame follows.
#pragma once

#include <array>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/visibility.h"

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

// The viewpoint of a frame, and its detail.

// The index of the first limit that is greater than the range; the number of limits where none is.
// Limits must ascend.
template <std::size_t Limits>
[[nodiscard]] constexpr std::size_t levelAt(float range, const std::array<float, Limits>& limits) {
    std::size_t level = 0;
    while (level < Limits && range >= limits[level]) ++level;
    return level;
}

// The viewpoint of a frame. Levels of detail are the same on every node, as they depend on the
// shared eye alone.
struct Viewpoint {
    surface::FrustumPlanes frustum;
    // The shared eye, world frame.
    glm::vec3 eyeMetres{};
    bool culling = true;
    bool levelsOfDetail = true;
    // Quality::placeReach of the tier, times how much finer than the wall's pixels those of the
    // picture are: distances are divided by it.
    float detail = 1.0F;

    // Whether a part of the ball may be in view.
    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const {
        return !culling || frustum.sees(centre, radius);
    }
    // The level of detail of a place: 0 is the finest, at limits[i] metres and beyond it is at
    // least i + 1.
    template <std::size_t Limits>
    [[nodiscard]] std::size_t levelOf(glm::vec3 place, std::array<float, Limits> limits) const {
        if (!levelsOfDetail) return 0;
        return levelAt(glm::distance(place, eyeMetres) / detail, limits);
    }
    // How far that level has faded into the next, 0 to 1: 1 at its limit.
    template <std::size_t Limits>
    [[nodiscard]] float fadedOf(glm::vec3 place, std::array<float, Limits> limits) const {
        const std::size_t level = levelOf(place, limits);
        if (!levelsOfDetail || level == Limits) return 0.0F;
        const float range = glm::distance(place, eyeMetres) / detail;
        return glm::smoothstep(limits[level] / shaders::kFade, limits[level], range);
    }
};

}  // namespace aquarama::scene
