// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/sea_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>

#include "common/base/hash.h"
#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Mip levels of the tiles and of the caustic layers.
constexpr int kTileLevels = 6;
// Side of the cloud tile.
constexpr int kCloudTexels = 256;
// The ratio of the depths of two consecutive layers of caustics. One layer lies on the sand of the
// reef.
constexpr float kLayerRatio = 2.15F;
// The share of the dispersion of water that is shown: all of it would look exaggerated.
constexpr float kDispersion = 0.6F;

// Two triangles for each cell of a square grid of (cells + 1)^2 vertices, as 16-bit indices.
std::vector<std::uint16_t> gridIndices(int cells) {
    assert(cells > 0);
    assert((cells + 1) * (cells + 1) <= 65536);
    std::vector<std::uint16_t> indices;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const int a = row * (cells + 1) + column;
            const int b = a + cells + 1;
            for (const int corner : {a, a + 1, b + 1, a, b + 1, b})
                indices.push_back(static_cast<std::uint16_t>(corner));
        }
    return indices;
}

// Depth at which the sunlight of a layer is computed, metres. The layer on the sand is the last but
// one, so that one lies below it; with one or two layers it is the last.
float layerDepth(int layer, int layers) {
    assert(layer >= 0);
    assert(layer < layers);
    const int onTheSand = layers > 2 ? layers - 2 : layers - 1;
    return place::kMeanFloorDepthMetres *
           std::pow(kLayerRatio, static_cast<float>(layer - onTheSand));
}

// One layer of light for each depth, 16-bit floats, mean 1; repeats, as the waves do.
gl::Texture makeLayers(int texels, int layers) {
    gl::Texture texture{static_cast<GLenum>(GL_TEXTURE_2D_ARRAY)};
    glTextureStorage3D(texture.name(), kTileLevels, GL_R16F, texels, texels, layers);
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

// Cloud cover 0 to 1: value noise in five octaves, from 6 cells across the tile. Each octave has a
// whole number of cells, so that the tile repeats without a seam. The division makes the sum of the
// weights 1.
gl::Texture makeClouds(std::uint32_t seed) {
    constexpr int kCells = 6;
    const auto at = [&](glm::vec2 place, int cells) {
        const auto corner = [&](glm::ivec2 c) {
            const auto index = static_cast<std::uint32_t>((c.y % cells) * cells + c.x % cells);
            return unitOf(hashOf(hashOf(seed, static_cast<std::uint32_t>(cells)), index));
        };
        const glm::vec2 p = place * static_cast<float>(cells);
        const glm::ivec2 c(p);
        const glm::vec2 t = glm::smoothstep(0.0F, 1.0F, p - glm::vec2(c));
        return glm::mix(glm::mix(corner(c), corner(c + glm::ivec2{1, 0}), t.x),
                        glm::mix(corner(c + glm::ivec2{0, 1}), corner(c + 1), t.x),
                        t.y);
    };
    std::vector<glm::u8> texels;
    for (int row = 0; row < kCloudTexels; ++row)
        for (int column = 0; column < kCloudTexels; ++column) {
            const glm::vec2 place = (glm::vec2{column, row} + 0.5F) / float{kCloudTexels};
            float sum = 0.0F;
            for (int octave = 0; octave < 5; ++octave)
                sum += at(place, kCells << octave) * std::exp2(-1.0F - static_cast<float>(octave));
            texels.push_back(static_cast<glm::u8>(255.0F * sum / (1.0F - 1.0F / 32.0F)));
        }
    gl::Texture texture = makeTexture(GL_R8, glm::ivec2{kCloudTexels}, kTileLevels, Edge::Repeat);
    glTextureSubImage2D(texture.name(),
                        0,
                        0,
                        0,
                        kCloudTexels,
                        kCloudTexels,
                        GL_RED,
                        GL_UNSIGNED_BYTE,
                        texels.data());
    glGenerateTextureMipmap(texture.name());
    return texture;
}

}  // namespace

SeaLight::SeaLight(const SeaLightOptions& options, WaterTables tables)
    : quality_{options.quality},
      sea_{options.calm ? calmSea() : seaOf(options.seed, place::kMeanFloorDepthMetres)},
      water_{options.water, std::move(tables)},
      cloudTile_{makeClouds(options.seed)},
      waveTile_{
          makeTexture(GL_RGBA16F, glm::ivec2{quality_.waveTexels}, kTileLevels, Edge::Repeat)},
      rippleTile_{
          makeTexture(GL_RGBA16F, glm::ivec2{quality_.rippleTexels}, kTileLevels, Edge::Repeat)},
      causticLayers_{makeLayers(quality_.causticTexels, quality_.causticLayers)},
      waveTarget_{makeTarget(waveTile_)},
      rippleTarget_{makeTarget(rippleTile_)},
      waveProgram_{gl::makeProgram({"quad.vert", "waves.frag"}, replacementsOf(quality_))},
      causticProgram_{gl::makeProgram({"caustic.vert", "caustic.frag"})},
      shafts_{quality_},
      shade_{options.quality} {
    const SeaNow start = seaAt(sea_, 0.0);
    seaBlock_ = gl::makeBuffer(std::span{&start, 1}, "sea now", GL_DYNAMIC_STORAGE_BIT);
    const auto indices = gridIndices(quality_.causticCells);
    causticIndexCount_ = static_cast<int>(indices.size());
    causticIndices_ = gl::makeBuffer(indices, "caustic indices");
    glVertexArrayElementBuffer(causticGrid_.name(), causticIndices_.name());
}

void SeaLight::update(double timeSeconds, glm::vec3 sharedEyeMetres) {
    water_.dive(-sharedEyeMetres.y);
    SeaNow now = seaAt(sea_, timeSeconds);
    now.causticAxis = {layerDepth(0, quality_.causticLayers),
                       1.0F / std::log2(kLayerRatio),
                       quality_.causticLayers - 1,
                       std::log2(static_cast<float>(quality_.causticTexels) / 256.0F)};
    now.surfaceDetail = {quality_.surfaceTaps,
                         quality_.isFine ? kDispersion : 0.0F,
                         static_cast<float>(quality_.waveTexels) / shaders::kTileMetres,
                         static_cast<float>(quality_.rippleTexels) / shaders::kRippleTileMetres};
    now.fishWindow = shade_.fishWindow(sharedEyeMetres);
    glNamedBufferSubData(seaBlock_.name(), 0, sizeof(now), &now);
    glBindBufferBase(GL_UNIFORM_BUFFER, shaders::kSeaBlock, seaBlock_.name());
    glDisable(GL_DEPTH_TEST);
    drawWaves();
    drawCaustics();
}

// Evaluates the sums of sines on both tiles, and their mip levels for coarser views.
void SeaLight::drawWaves() {
    const gl::Stage stage{"waves"};
    glUseProgram(waveProgram_.name());
    glBindVertexArray(empty_.name());
    const auto draw = [](const gl::Framebuffer& target, int texels, float metres, bool ripples) {
        glBindFramebuffer(GL_FRAMEBUFFER, target.name());
        glViewport(0, 0, texels, texels);
        glUniform1f(shaders::kTileMetresLocation, metres);
        glUniform1i(shaders::kDrawsRipplesLocation, ripples ? 1 : 0);
        glUniform1f(shaders::kTexelMetresLocation, metres / static_cast<float>(texels));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    };
    draw(waveTarget_, quality_.waveTexels, shaders::kTileMetres, false);
    draw(rippleTarget_, quality_.rippleTexels, shaders::kRippleTileMetres, true);
    glGenerateTextureMipmap(waveTile_.name());
    glGenerateTextureMipmap(rippleTile_.name());
}

// A grid of light on the surface is refracted and projected to the depth of each layer: where its
// triangles shrink, light gathers. The triangles are added, as the front folds over itself.
void SeaLight::drawCaustics() {
    const gl::Stage stage{"caustics"};
    glBindFramebuffer(GL_FRAMEBUFFER, causticTarget_.name());
    glViewport(0, 0, quality_.causticTexels, quality_.causticTexels);
    glClearColor(0, 0, 0, 0);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(causticProgram_.name());
    glUniform1i(shaders::kCellsLocation, quality_.causticCells);
    glUniform1f(shaders::kCausticTexelLocation,
                shaders::kTileMetres / static_cast<float>(quality_.causticTexels));
    glBindTextureUnit(shaders::kWaveTileUnit, waveTile_.name());
    glBindVertexArray(causticGrid_.name());
    for (int layer = 0; layer < quality_.causticLayers; ++layer) {
        glNamedFramebufferTextureLayer(
            causticTarget_.name(), GL_COLOR_ATTACHMENT0, causticLayers_.name(), 0, layer);
        glClear(GL_COLOR_BUFFER_BIT);
        glUniform1f(shaders::kReceiverMetresLocation, layerDepth(layer, quality_.causticLayers));
        glDrawElements(GL_TRIANGLES, causticIndexCount_, GL_UNSIGNED_SHORT, nullptr);
    }
    glDisable(GL_BLEND);
    glGenerateTextureMipmap(causticLayers_.name());
}

void SeaLight::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, shaders::kSeaBlock, seaBlock_.name());
    water_.bind();
    glBindTextureUnit(shaders::kCausticLayersUnit, causticLayers_.name());
    glBindTextureUnit(shaders::kShaftMapUnit, shafts_.texture().name());
    glBindTextureUnit(shaders::kWaveTileUnit, waveTile_.name());
    glBindTextureUnit(shaders::kRippleTileUnit, rippleTile_.name());
    glBindTextureUnit(shaders::kCloudTileUnit, cloudTile_.name());
    shade_.bind();
}

}  // namespace aquarama::scene
