// SPDX-License-Identifier: Apache-2.0
// What a frame of fish takes: no memory, whatever their number.
#include <gtest/gtest.h>

#include "tests/render_node/surface/surface_fixture.h"
#include "tests/support/count_memory.h"

namespace aquarama::surface {
namespace {

class FrameMemory : public test::SurfaceTest {};

TEST_F(FrameMemory, noFrameTakesAny) {
    std::vector<motion::PresentedFish> school;
    for (int i = 0; i < 3000; ++i) {
        const float k = static_cast<float>(i);
        const glm::vec3 place{std::sin(k), std::sin(2 * k), -0.4F - 0.01F * k};
        school.push_back(test::fishAt(place, {1, 0, 0, 0}));
    }
    const test::RecordedSchool recorded{school};
    SchoolSurface surface = surfaceFor(recorded.traits);
    const auto frame = [&](float fraction) {
        surface.update({recorded.records, recorded.records, fraction});
        surface.look(clip_, {});
        evaluate(surface);
    };
    frame(0.1F);
    frame(0.2F);  // drivers keep what they make for the first
    const std::size_t before = test::bytesTaken;
    for (int i = 0; i < 5; ++i) frame(0.3F + 0.1F * static_cast<float>(i));
    EXPECT_EQ(test::bytesTaken - before, 0U);
}

}  // namespace
}  // namespace aquarama::surface
