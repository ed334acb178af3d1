// SPDX-License-Identifier: Apache-2.0
// What waves, shafts and shadows do to the light: on software GL, read back as numbers.
#include <algorithm>
#include <memory>
#include <vector>

#include <epoxy/gl.h>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/context/context.h"
#include "render_node/scene/sea_light.h"
#include "render_node/scene/shade.h"
#include "render_node/shaders/frame_uniforms.h"

namespace aquarama {
namespace {

constexpr float kFilterDepthMetres = 4.9F;

class Sunlight : public testing::Test {
  protected:
    static void SetUpTestSuite() { context() = makeOffscreenContext("auto", {16, 16}); }
    static void TearDownTestSuite() { context().reset(); }
    static std::unique_ptr<Context>& context() {
        static std::unique_ptr<Context> instance;
        return instance;
    }

    Sunlight() {
        uniforms_.eyeAndTime = glm::vec4(kEyePosition, 0.0F);
        uniforms_.sharedEyeAndPixel = glm::vec4(kEyePosition, 0.002F);
        uniforms_.sunAndFilterDepth = glm::vec4(sunInWater(), kFilterDepthMetres);
        uniforms_.daylight = glm::vec4(1.0F);
        glNamedBufferStorage(block_.name(), sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
        setUniforms();
    }
    void setUniforms() const {
        glNamedBufferSubData(block_.name(), 0, sizeof(uniforms_), &uniforms_);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, block_.name());
    }

    FrameUniforms uniforms_{};
    gl::Buffer block_;
};

std::vector<float> texelsOf(const gl::Texture& texture, int count) {
    std::vector<float> texels(static_cast<std::size_t>(count));
    glGetTextureImage(texture.name(),
                      0,
                      GL_RED,
                      GL_FLOAT,
                      static_cast<GLsizei>(texels.size() * sizeof(float)),
                      texels.data());
    return texels;
}

double meanOf(std::span<const float> values) {
    double sum = 0;
    for (const float value : values) sum += static_cast<double>(value);
    return sum / static_cast<double>(values.size());
}

// At every depth at which it is drawn.
TEST_F(Sunlight, wavesGatherLightAndMakeNone) {
    const LightQuality quality{.causticLayers = 4, .causticTexels = 256, .causticCells = 120};
    SeaLight light{{.quality = quality}};
    for (const double time : {0.0, 2.7, 1000.3}) {
        light.update(time, kEyePosition, {});
        const int texels = quality.causticTexels * quality.causticTexels;
        const std::vector<float> all =
            texelsOf(light.causticLayers(), texels * quality.causticLayers);
        for (int layer = 0; layer < quality.causticLayers; ++layer) {
            const auto net = std::span(all).subspan(static_cast<std::size_t>(layer * texels),
                                                    static_cast<std::size_t>(texels));
            EXPECT_NEAR(meanOf(net), 1.0, 0.05) << time << " s, layer " << layer;
            EXPECT_GT(*std::ranges::max_element(net), layer == 0 ? 1.3F : 3.0F) << "no net";
        }
    }
}

}  // namespace
}  // namespace aquarama
