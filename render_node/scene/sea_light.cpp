// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/sea_light.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "common/place/place.h"
#include "render_node/gl/program.h"
#include "render_node/scene/texture.h"

namespace aquarama {

namespace {

constexpr int kWaveTexels = 96;
constexpr int kCausticTexels = 256;
constexpr int kTileLevels = 6;
constexpr int kShaftTexels = 128;  // as in water.glsl
constexpr int kGridCells = 72;     // of the light front, as in caustic.vert

// Two triangles a cell.
std::vector<std::uint16_t> gridIndices() {
    std::vector<std::uint16_t> indices;
    for (int row = 0; row < kGridCells; ++row)
        for (int column = 0; column < kGridCells; ++column) {
            const int a = row * (kGridCells + 1) + column;
            const int b = a + kGridCells + 1;
            for (const int corner : {a, a + 1, b + 1, a, b + 1, b})
                indices.push_back(static_cast<std::uint16_t>(corner));
        }
    return indices;
}

// As in water.glsl.
glm::vec2 shaftTexel(glm::vec3 direction) {
    const glm::vec3 size = glm::abs(direction);
    glm::vec2 p = glm::vec2(direction.x, direction.z) / (size.x + size.y + size.z);
    if (direction.y < 0.0F)
        p = (1.0F - glm::abs(glm::vec2(p.y, p.x))) *
            glm::vec2(p.x < 0.0F ? -1.0F : 1.0F, p.y < 0.0F ? -1.0F : 1.0F);
    return (0.5F + 0.5F * p * (static_cast<float>(kShaftTexels - 2) / kShaftTexels)) *
           static_cast<float>(kShaftTexels);
}

struct Box {
    glm::ivec2 low{}, high{};
};

// The texels of the map that a view reads: its rays are probed on a grid fine enough for one
// texel of margin to cover what lies between.
Box texelsInView(glm::vec3 eye, const glm::mat4& worldFromClip) {
    constexpr int kProbes = 24;
    glm::vec2 low{1.0e9F};
    glm::vec2 high{-1.0e9F};
    for (int y = 0; y <= kProbes; ++y)
        for (int x = 0; x <= kProbes; ++x) {
            const glm::vec4 near =
                worldFromClip * glm::vec4(2.0F * static_cast<float>(x) / kProbes - 1.0F,
                                          2.0F * static_cast<float>(y) / kProbes - 1.0F,
                                          1.0F,
                                          1.0F);
            const glm::vec2 texel = shaftTexel(glm::normalize(glm::vec3(near) / near.w - eye));
            low = glm::min(low, texel);
            high = glm::max(high, texel);
        }
    constexpr float kMargin = 6.0F;
    return {glm::max(glm::ivec2(low - kMargin), 0),
            glm::min(glm::ivec2(high + kMargin), kShaftTexels)};
}

}  // namespace

SeaLight::SeaLight(std::uint32_t seed, WaterType water)
    : waves_{wavesOf(seed, kMeanFloorDepthMetres)},
      water_{seaWater(water)},
      inscatter_{water_},
      tableDepthMetres_{-kEyePosition.y},
      atEye_{inscatter_.atDepth(double{tableDepthMetres_})},
      primariesKd_{primariesDownwelling(water_)},
      direct_{makeTexture(bakeDirect(water_))},
      inscatterTable_{makeVolume(atEye_)},
      openWater_{makeTexture(bakeOpenWater(water_))},
      waveTile_{makeTexture(GL_RGBA16F, glm::ivec2{kWaveTexels}, kTileLevels, Edge::Repeat)},
      causticTile_{makeTexture(GL_R16F, glm::ivec2{kCausticTexels}, kTileLevels, Edge::Repeat)},
      shaftMap_{makeTexture(GL_RGBA16F, glm::ivec2{kShaftTexels}, 1, Edge::Clamp)},
      waveTarget_{makeTarget(waveTile_)},
      causticTarget_{makeTarget(causticTile_)},
      shaftTarget_{makeTarget(shaftMap_)},
      waveProgram_{gl::makeProgram({"quad.vert", "waves.frag"})},
      causticProgram_{gl::makeProgram({"caustic.vert", "caustic.frag"})},
      shaftProgram_{gl::makeProgram({"quad.vert", "shaft.frag"})} {
    glNamedBufferStorage(seaBlock_.name(), sizeof(SeaNow), nullptr, GL_DYNAMIC_STORAGE_BIT);
    const auto indices = gridIndices();
    causticIndexCount_ = static_cast<int>(indices.size());
    glNamedBufferStorage(causticIndices_.name(),
                         static_cast<GLsizeiptr>(indices.size() * sizeof(indices.front())),
                         indices.data(),
                         0);
    glVertexArrayElementBuffer(causticGrid_.name(), causticIndices_.name());
}

void SeaLight::update(double timeSeconds, glm::vec3 sharedEyeMetres) {
    if (tableDepthMetres_ != -sharedEyeMetres.y) {
        tableDepthMetres_ = -sharedEyeMetres.y;
        inscatter_.mixAtDepth(double{tableDepthMetres_}, atEye_);
        refill(inscatterTable_, atEye_);
    }
    const SeaNow now = seaAt(waves_, timeSeconds);
    glNamedBufferSubData(seaBlock_.name(), 0, sizeof(now), &now);
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, seaBlock_.name());
    glDisable(GL_DEPTH_TEST);
    drawWaves();
    drawCaustics();
}

glm::vec4 SeaLight::kdAndExposure(glm::vec3 sharedEyeMetres) const {
    return {primariesKd_, inscatter_.exposureAt(-double{sharedEyeMetres.y})};
}

void SeaLight::drawWaves() {
    glBindFramebuffer(GL_FRAMEBUFFER, waveTarget_.name());
    glViewport(0, 0, kWaveTexels, kWaveTexels);
    glUseProgram(waveProgram_.name());
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glGenerateTextureMipmap(waveTile_.name());
}

// A front of light refracted at the surface: where its triangles shrink, light gathers.
void SeaLight::drawCaustics() {
    glBindFramebuffer(GL_FRAMEBUFFER, causticTarget_.name());
    glViewport(0, 0, kCausticTexels, kCausticTexels);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(causticProgram_.name());
    glBindTextureUnit(13, waveTile_.name());
    glBindVertexArray(causticGrid_.name());
    glDrawElements(GL_TRIANGLES, causticIndexCount_, GL_UNSIGNED_SHORT, nullptr);
    glDisable(GL_BLEND);
    glGenerateTextureMipmap(causticTile_.name());
}

void SeaLight::drawShafts(glm::vec3 eyeMetres, const glm::mat4& worldFromClip) {
    const Box box = texelsInView(eyeMetres, worldFromClip);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, shaftTarget_.name());
    glViewport(0, 0, kShaftTexels, kShaftTexels);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
    glUseProgram(shaftProgram_.name());
    glBindTextureUnit(11, causticTile_.name());
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

void SeaLight::bind() const {
    glBindTextureUnit(8, direct_.name());
    glBindTextureUnit(9, inscatterTable_.name());
    glBindTextureUnit(10, openWater_.name());
    glBindTextureUnit(11, causticTile_.name());
    glBindTextureUnit(12, shaftMap_.name());
    glBindTextureUnit(13, waveTile_.name());
}

}  // namespace aquarama
