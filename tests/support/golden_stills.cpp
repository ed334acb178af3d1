// SPDX-License-Identifier: Apache-2.0
#include "tests/support/golden_stills.h"

#include <cmath>

namespace aquarama::test {

namespace {

using Stills = std::vector<GoldenStill>;

void addPlace(Stills& stills) {
    struct Direction {
        const char* name;
        float azimuthDegrees;
    };
    constexpr Direction kDirections[]{{"ahead", 8.0F}, {"left", -45.0F}, {"behind", 190.0F}};
    for (const Direction& direction : kDirections) {
        Still still;
        still.camera.azimuthDegrees = direction.azimuthDegrees;
        still.camera.sizePixels = {320, 180};
        still.options.quality = config::QualityTier::Medium;
        stills.push_back({std::string("place/") + direction.name, still, {}});
    }
}

void addWater(Stills& stills) {
    constexpr GoldenLimits kLimits{.meanCodes = 0.6};
    for (std::size_t i = 0; i < config::kWaterTypeNames.size(); ++i)
        stills.push_back({"water/" + std::string(config::kWaterTypeNames.at(i)),
                          reefIn(static_cast<config::WaterType>(i)),
                          kLimits});
    for (const float depth : {1.2F, 25.0F})
        stills.push_back({"water/open_sea_" + std::to_string(std::lround(depth)) + "_m",
                          openSea(depth),
                          kLimits});
}

Still openSeaTowards(float azimuthDegrees, float elevationDegrees, float heightDegrees) {
    Still still;
    still.options.quality = config::QualityTier::Medium;
    still.options.place.kind = config::PlaceKind::OpenSea;
    still.camera = {
        place::kEyePosition, azimuthDegrees, elevationDegrees, heightDegrees, glm::ivec2{320, 180}};
    return still;
}

// The window, the wall of light, and a school that shades itself.
void addSurface(Stills& stills) {
    stills.push_back({"surface/window", openSeaTowards(-28.0F, 50.0F, 70.0F), {}});
    stills.push_back({"surface/wall", openSeaTowards(30.0F, 16.0F, 50.0F), {}});
    Still school = openSeaTowards(-10.0F, 6.0F, 45.0F);
    school.fish =
        ballOf("bigeye_scad", 250, place::kEyePosition + glm::vec3{-0.8F, 0.4F, -4.5F}, 1.2F);
    stills.push_back({"surface/school", school, {}});
}

struct Sitter {
    const char* species;
    float lengthMetres;
    float height;  // of the picture, body lengths
};
constexpr Sitter kSitters[]{{"bigeye_scad", 0.24F, 0.78F},
                            {"clownfish", 0.09F, 0.80F},
                            {"moorish_idol", 0.18F, 1.10F},
                            {"blue_tang", 0.22F, 0.80F},
                            {"parrotfish", 0.32F, 0.78F},
                            {"trumpetfish", 0.50F, 0.75F},
                            {"blacktip_reef_shark", 1.30F, 0.78F}};

Still portrait(const Sitter& sitter, float turnDegrees) {
    constexpr float kTangent = 0.17F;  // of half the view's height
    Still still;
    still.camera.sizePixels = {320, 180};
    still.camera.heightDegrees = 19.3F;
    still.options.place.kind = config::PlaceKind::OpenSea;
    still.options.quality = config::QualityTier::High;
    const float away = sitter.lengthMetres * sitter.height / (2 * kTangent);
    still.fish = {portraitOf(sitter.species, still.camera, away, turnDegrees, sitter.lengthMetres)};
    return still;
}

void addSpecies(Stills& stills) {
    for (const Sitter& sitter : kSitters) {
        const std::string name = std::string("species/") + sitter.species;
        stills.push_back({name + "_side", portrait(sitter, 0.0F), {}});
        stills.push_back({name + "_front", portrait(sitter, 75.0F), {}});
    }
}

struct Level {
    const char* name;
    float pixels;  // of a fish's length
    config::QualityTier tier;
};
constexpr Level kLevels[]{{"point", 2.0F, config::QualityTier::Low},
                          {"fading", 3.2F, config::QualityTier::Low},
                          {"few_triangles", 9.0F, config::QualityTier::Low},
                          {"control_mesh", 40.0F, config::QualityTier::Low},
                          {"mesh", 120.0F, config::QualityTier::Low},
                          {"hero", 170.0F, config::QualityTier::High},
                          {"close_up", 640.0F, config::QualityTier::High}};

Still fishAtLevel(const Level& level) {
    Still still;
    // So wide or narrow that the fish is some metres away.
    const bool isSmall = level.pixels < 10.0F;
    still.camera.sizePixels = isSmall ? glm::ivec2{96, 54} : glm::ivec2{224, 126};
    still.camera.heightDegrees = isSmall ? 75.0F : 10.0F;
    still.options.place.kind = config::PlaceKind::OpenSea;
    still.options.quality = level.tier;
    const float metres = 0.24F / (level.pixels * pixelRadiansOf(still.camera));
    const int fish = isSmall ? 12 : 1;
    for (int i = 0; i < fish; ++i) {
        Camera towards = still.camera;
        if (fish > 1) {
            const auto column = i % 4;
            const auto row = i / 4;
            towards.azimuthDegrees = 20.0F * static_cast<float>(column) - 30.0F;
            towards.elevationDegrees = 18.0F * static_cast<float>(row) - 18.0F;
        }
        const std::string species = i % 2 == 0 ? "moorish_idol" : "bigeye_scad";
        still.fish.push_back(
            portraitOf(species, towards, metres, 20.0F + 30.0F * static_cast<float>(i), 0.24F));
    }
    return still;
}

void addLevels(Stills& stills) {
    for (const Level& level : kLevels)
        stills.push_back({std::string("lod/") + level.name, fishAtLevel(level), {}});
}

}  // namespace

Still reefIn(config::WaterType type) {
    Still still;
    still.colourReturned = 0.0F;  // as in nature
    still.camera.sizePixels = {320, 180};
    still.camera.heightDegrees = 60.0F;
    still.options.quality = config::QualityTier::Medium;
    still.options.water = type;
    return still;
}

Still openSea(float depthMetres) {
    Still still = reefIn(config::WaterType::IA);
    still.camera.eyeMetres = {0.0F, -depthMetres, 0.0F};
    still.options.place.kind = config::PlaceKind::OpenSea;
    return still;
}

std::vector<GoldenStill> goldenStills(std::string_view beginning) {
    Stills stills;
    addPlace(stills);
    addWater(stills);
    addSurface(stills);
    addSpecies(stills);
    addLevels(stills);
    std::erase_if(stills,
                  [&](const GoldenStill& still) { return !still.name.starts_with(beginning); });
    return stills;
}

}  // namespace aquarama::test
