// SPDX-License-Identifier: Apache-2.0
// How much a frame may cost: what each tier of quality buys, in one place.
#pragma once

#include <array>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "render_node/gl/program.h"
#include "render_node/surface/visibility.h"

namespace aquarama::scene {

// Of the sunlight in the sea: waves, caustics, shafts, shadows, snow. Texels are of one side.
struct LightQuality {
    int waveTexels = 96;
    int rippleTexels = 64;
    int surfaceTaps = 1;    // of the surface along a pixel's long side
    int causticLayers = 1;  // depths at which caustics are drawn
    int causticTexels = 256;
    int causticCells = 72;  // of the light front, a side
    int shaftTexels = 112;  // of the map of all directions
    int shaftSteps = 18;    // along a direction
    int shadowTexels = 64;  // of the place's shadows; drawn where isFine
    int fishShadowTexels = 128;
    int flakes = 6000;  // of marine snow
    // Soft shadows, of fish too; a mirrored reef, clouds, coloured rims of caustics.
    bool isFine = false;
};

// What shaders of the tier include instead: what a tier leaves out costs nothing, also where a
// driver runs both sides of every branch.
[[nodiscard]] gl::Replacements replacementsOf(const LightQuality& light);

struct Quality {
    float pictureShare = 1.0F;  // of the projector's pixels along either axis that are drawn
    int samples = 1;            // of multisampling
    bool softening = false;     // of the distance, by forward scattering: 32 fetches a pixel
    bool bloom = false;         // 18 fetches a pixel, and smaller copies of the picture
    bool closeUps = false;      // fish that fill much of the picture are refined a third time
    float fishFineness = 1.0F;  // of fishes' meshes: detailLimits() of surface/visibility.h
    LightQuality light;
    // How finely the place is cut: at 1 a facet of a coral fills some 7 of the wall's finest
    // pixels.
    float placeDetail = 1.0F;
    int rockScales = 1;           // of the grit on rock, 1 to 3; 1 is lit at corners
    bool plantsGiveWay = false;   // to fish that pass
    bool growthAtPixels = false;  // near corals are lit at pixels, not at corners
};

[[nodiscard]] Quality qualityOf(config::QualityTier tier);

// From where a frame is seen, and how finely.

// The first limit that a range does not reach.
template <std::size_t Limits>
[[nodiscard]] constexpr std::size_t levelAt(float range, const std::array<float, Limits>& limits) {
    std::size_t level = 0;
    while (level < Limits && range >= limits[level]) ++level;
    return level;
}

// How a frame is drawn: the same choice on every node, as it depends on the shared eye alone.
struct Viewpoint {
    surface::Frustum frustum;
    glm::vec3 eyeMetres{};
    bool culling = true;
    bool levelsOfDetail = true;
    float detail = 1.0F;  // of the tier of quality

    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const {
        return !culling || frustum.sees(centre, radius);
    }
    // 0 the finest; further than limits[i] is level i + 1.
    template <std::size_t Limits>
    [[nodiscard]] std::size_t levelOf(glm::vec3 place, std::array<float, Limits> limits) const {
        if (!levelsOfDetail) return 0;
        return levelAt(glm::distance(place, eyeMetres) / detail, limits);
    }
};

}  // namespace aquarama::scene
