// SPDX-License-Identifier: Apache-2.0
// The place from three directions, as it looked when somebody last found it right.
#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "tests/support/golden_stills.h"

namespace aquarama::scene {
namespace {

TEST(PlaceGolden, looksAsItDidFromThreeDirections) {
    const auto context = gl::makeOffscreenContext("mesa", {16, 16});
    test::Photographer photographer;
    for (const test::GoldenStill& golden : test::goldenStills("place/"))
        test::expectGolden(photographer.pictureOf(golden.still), golden.name, golden.limits);
}

}  // namespace
}  // namespace aquarama::scene
