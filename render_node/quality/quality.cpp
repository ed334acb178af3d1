// SPDX-License-Identifier: Apache-2.0
#include "render_node/quality/quality.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace aquarama::scene {

namespace {

// The light of each tier but the lowest, whose values are the defaults.
constexpr LightQuality kMediumLight{.waveTexels = 128,
                                    .rippleTexels = 128,
                                    .surfaceTaps = 2,
                                    .causticLayers = 2,
                                    .causticTexels = 512,
                                    .causticCells = 120,
                                    .shaftTexels = 256,
                                    .shaftSteps = 32,
                                    .shadowTexels = 1024,
                                    .fishShadowTexels = 512,
                                    .flakes = 14000,
                                    .isFine = true};
constexpr LightQuality kHighLight{.waveTexels = 192,
                                  .rippleTexels = 256,
                                  .surfaceTaps = 4,
                                  .causticLayers = 4,
                                  .causticTexels = 512,
                                  .causticCells = 160,
                                  .shaftTexels = 512,
                                  .shaftSteps = 48,
                                  .shadowTexels = 2048,
                                  .fishShadowTexels = 1024,
                                  .flakes = 20000,
                                  .isFine = true};
constexpr LightQuality kUltraLight{.waveTexels = 192,
                                   .rippleTexels = 256,
                                   .surfaceTaps = 8,
                                   .causticLayers = 4,
                                   .causticTexels = 1024,
                                   .causticCells = 200,
                                   .shaftTexels = 768,
                                   .shaftSteps = 64,
                                   .shadowTexels = 2048,
                                   .fishShadowTexels = 1024,
                                   .flakes = 20000,
                                   .isFine = true};

}  // namespace

gl::Replacements replacementsOf(const LightQuality& light) {
    if (!light.isFine) return {};
    return {{"light_plain.glsl", "light_fine.glsl"}};
}

Quality qualityOf(config::QualityTier tier) {
    assert(static_cast<std::size_t>(tier) < config::kTierNames.size());
    // In the order of config::QualityTier.
    static constexpr std::array<Quality, config::kTierNames.size()> kTiers{
        Quality{.pictureShare = 0.85F,
                .fishFineness = 0.75F,
                .skinLevelsLeftOut = 1,
                .light = {},
                .placeDetail = 0.45F,
                .placeReach = 0.32F},
        Quality{.samples = 1,
                .softening = true,
                .bloom = true,
                .light = kMediumLight,
                .placeDetail = 0.9F,
                .placeReach = 0.9F,
                .rockScales = 2,
                .plantsGiveWay = true,
                .growthAtPixels = true},
        Quality{.samples = 4,
                .softening = true,
                .bloom = true,
                .closeUps = true,
                .fishFineness = 1.25F,
                .light = kHighLight,
                .placeDetail = 1.4F,
                .placeReach = 1.4F,
                .rockScales = 3,
                .plantsGiveWay = true,
                .growthAtPixels = true},
        Quality{.samples = 4,
                .softening = true,
                .bloom = true,
                .closeUps = true,
                .fishFineness = 1.6F,
                .light = kUltraLight,
                .placeDetail = 2.5F,
                .placeReach = 2.5F,
                .rockScales = 3,
                .plantsGiveWay = true,
                .growthAtPixels = true},
    };
    return kTiers.at(static_cast<std::size_t>(tier));
}

}  // namespace aquarama::scene
