// SPDX-License-Identifier: Apache-2.0
// Each species as it was when somebody last looked and found it right: from the side and the front.
#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "tests/support/golden_stills.h"

namespace aquarama::surface {
namespace {

TEST(SpeciesPictures, everySpeciesLooksFromTheSideAndTheFrontAsItDid) {
    const auto context = gl::makeOffscreenContext("mesa", {16, 16});
    test::Photographer photographer;
    for (const test::GoldenStill& golden : test::goldenStills("species/"))
        test::expectGolden(photographer.pictureOf(golden.still), golden.name, golden.limits);
}

}  // namespace
}  // namespace aquarama::surface
