// SPDX-License-Identifier: Apache-2.0
// The place from three directions, as it looked when somebody last found it right.
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "render_node/context/context.h"
#include "tests/support/golden.h"
#include "tests/support/still.h"

namespace aquarama {
namespace {

TEST(PlaceGolden, looksAsItDidFromThreeDirections) {
    const auto context = makeOffscreenContext("mesa", {16, 16});
    test::Photographer photographer;
    struct Direction {
        std::string name;
        float azimuthDegrees;
    };
    for (const auto& [name, azimuth] : std::array{
             Direction{"ahead", 8.0F}, Direction{"left", -45.0F}, Direction{"behind", 190.0F}}) {
        test::Still still;
        still.camera.azimuthDegrees = azimuth;
        still.camera.sizePixels = {320, 180};
        still.options.quality = QualityTier::Medium;
        test::expectGolden(photographer.pictureOf(still), "place/" + name);
    }
}

}  // namespace
}  // namespace aquarama
