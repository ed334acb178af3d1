// SPDX-License-Identifier: Apache-2.0
// Each species as it was when somebody last looked and found it right: from the side and the front.
#include <string>

#include <gtest/gtest.h>

#include "render_node/context/context.h"
#include "tests/support/golden.h"
#include "tests/support/still.h"

namespace aquarama {
namespace {

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

void expectPortrait(const Sitter& sitter, float turnDegrees, const char* side) {
    constexpr float kTangent = 0.17F;  // of half the view's height
    test::Still still;
    still.camera.sizePixels = {320, 180};
    still.camera.heightDegrees = 19.3F;
    still.options.place = PlaceKind::OpenSea;
    still.options.quality = QualityTier::High;
    const float away = sitter.lengthMetres * sitter.height / (2 * kTangent);
    still.fish = {
        test::portraitOf(sitter.species, still.camera, away, turnDegrees, sitter.lengthMetres)};
    test::expectGolden(test::pictureOf(still),
                       std::string("species/") + sitter.species + "_" + side);
}

TEST(SpeciesPictures, everySpeciesLooksFromTheSideAsItDid) {
    const auto context = makeOffscreenContext("mesa", {16, 16});
    for (const Sitter& sitter : kSitters) expectPortrait(sitter, 0.0F, "side");
}

TEST(SpeciesPictures, everySpeciesLooksFromTheFrontAsItDid) {
    const auto context = makeOffscreenContext("mesa", {16, 16});
    for (const Sitter& sitter : kSitters) expectPortrait(sitter, 75.0F, "front");
}

}  // namespace
}  // namespace aquarama
