// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "common/wall/pattern.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/show/projection.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

class PatternPassTest : public testing::Test {
  protected:
    // The reference at the middle of a pixel, top row first.
    [[nodiscard]] double gridAt(glm::ivec2 pixel) const {
        const glm::dvec2 place = (glm::dvec2(pixel) + 0.5) / glm::dvec2(kSize);
        const glm::dvec4 inCamera(glm::mix(frustum_.left, frustum_.right, place.x),
                                  glm::mix(frustum_.top, frustum_.bottom, place.y),
                                  -1,
                                  0);
        return wall::gridLight(glm::dvec3(glm::inverse(frustum_.cameraFromWall) * inCamera));
    }

    static constexpr glm::ivec2 kSize{500, 380};
    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("auto", kSize);
    wall::ChannelFrustum frustum_ = wall::Wall(wall::shippedRig("desk")).frustum(2, 0.01);
    gl::Target target_{GL_RGBA32F, kSize};
    PatternPass pass_{frustum_, wall::makeSurface(wall::shippedRig("desk"))->patternGround()};
};

TEST_F(PatternPassTest, theGridIsTheReferences) {
    pass_.drawGrid(target_.framebuffer(), kSize);
    const std::vector<float> drawn = gl::readRgb<float>(target_);
    double brightest = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const double light =
                static_cast<double>(drawn[static_cast<std::size_t>(y * kSize.x + x) * 3]);
            ASSERT_NEAR(light, gridAt({x, y}), 0.004) << "at " << x << ", " << y;
            brightest = std::fmax(brightest, light);
        }
    EXPECT_GT(brightest, 0.9) << "no bright line is in view";
}

TEST_F(PatternPassTest, theGridIsAddedToWhatIsThere) {
    pass_.drawGrid(target_.framebuffer(), kSize);
    const std::vector<float> grid = gl::readRgb<float>(target_);
    pass_.drawGrey(target_.framebuffer(), kSize);
    pass_.addGrid(target_.framebuffer(), kSize);
    const std::vector<float> both = gl::readRgb<float>(target_);
    for (std::size_t i = 0; i < both.size(); i += 3)
        ASSERT_FLOAT_EQ(both[i], grid[i] + static_cast<float>(wall::kGreyLight));
}

}  // namespace
}  // namespace aquarama::show
