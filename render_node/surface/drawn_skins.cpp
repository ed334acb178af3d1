// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/drawn_skins.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "render_node/gl/program.h"

namespace aquarama::surface {

namespace {

constexpr std::size_t kFirstLayers = 4;

gl::Texture makeArray(std::size_t leftOut, std::size_t layers) {
    gl::Texture array(GL_TEXTURE_2D_ARRAY);
    const unsigned name = array.name();
    const glm::ivec2 size = body::sideTexelsAt(leftOut);
    glTextureStorage3D(name,
                       static_cast<GLsizei>(body::kSideLevels - leftOut),
                       GL_SRGB8_ALPHA8,
                       size.x,
                       size.y,
                       static_cast<GLsizei>(layers));
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(name, axis, GL_CLAMP_TO_EDGE);
    constexpr float kAnisotropy = 4.0F;  // costs too much where drawings are small
    if (leftOut == 0 && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        glTextureParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, kAnisotropy);
    glObjectLabel(GL_TEXTURE, name, -1, "drawn skins");
    return array;
}

}  // namespace

DrawnSkins::DrawnSkins(std::size_t leftOut)
    : leftOut_{leftOut},
      table_{gl::makeBuffer(sizeof(Table), "layers of drawn skins", GL_DYNAMIC_STORAGE_BIT)} {
    assert(leftOut < body::kSideLevels);
    tell();
}

bool DrawnSkins::dropOthers(const body::SkinsByNumber& skins) {
    bool isChange = false;
    for (Layer& layer : layers_) {
        if (!layer.skin) continue;
        const auto worn = skins.find(layer.number);
        if (worn != skins.end() && worn->second == layer.skin) continue;
        layer = {};
        isChange = true;
    }
    return isChange;
}

void DrawnSkins::wear(const body::SkinsByNumber& skins, std::size_t most) {
    bool isChange = dropOthers(skins);
    for (const auto& [number, skin] : skins) {
        if (most == 0) break;
        if (isWorn(number)) continue;
        const std::size_t free = freeLayer();
        if (free == shaders::kMostDrawn) break;
        upload(free, *skin);
        layers_[free] = {number, skin};
        --most;
        isChange = true;
    }
    if (isChange) tell();
}

bool DrawnSkins::isWorn(std::uint32_t number) const {
    return std::ranges::any_of(
        layers_, [&](const Layer& layer) { return layer.skin && layer.number == number; });
}

// kMostDrawn where there is none.
std::size_t DrawnSkins::freeLayer() {
    const auto free = std::ranges::find(layers_, nullptr, &Layer::skin);
    const auto place = static_cast<std::size_t>(free - layers_.begin());
    if (place == layers_.size() && place < shaders::kMostDrawn) grow();
    return place;
}

void DrawnSkins::grow() {
    const std::size_t before = layers_.size();
    layers_.resize(std::max(kFirstLayers, 2 * before));
    gl::Texture larger = makeArray(leftOut_, layers_.size());
    for (std::size_t level = leftOut_; level < body::kSideLevels && before > 0; ++level) {
        const glm::ivec2 size = body::sideTexelsAt(level);
        const auto mip = static_cast<GLint>(level - leftOut_);
        glCopyImageSubData(array_->name(),
                           GL_TEXTURE_2D_ARRAY,
                           mip,
                           0,
                           0,
                           0,
                           larger.name(),
                           GL_TEXTURE_2D_ARRAY,
                           mip,
                           0,
                           0,
                           0,
                           size.x,
                           size.y,
                           static_cast<GLsizei>(before));
    }
    array_ = std::move(larger);
}

void DrawnSkins::upload(std::size_t layer, const body::SideSkin& skin) const {
    const gl::Stage stage{"drawn skin"};
    for (std::size_t level = leftOut_; level < body::kSideLevels; ++level) {
        const glm::ivec2 size = body::sideTexelsAt(level);
        glTextureSubImage3D(array_->name(),
                            static_cast<GLint>(level - leftOut_),
                            0,
                            0,
                            static_cast<GLint>(layer),
                            size.x,
                            size.y,
                            1,
                            GL_RGBA,
                            GL_UNSIGNED_BYTE,
                            skin.levels.at(level).data());
    }
}

void DrawnSkins::tell() const {
    Table table;
    table.layers = static_cast<std::uint32_t>(layers_.size());
    for (std::size_t i = 0; i < layers_.size(); ++i)
        table.numbers.at(i) = layers_[i].skin ? layers_[i].number : 0;
    glNamedBufferSubData(table_.name(), 0, sizeof(table), &table);
}

void DrawnSkins::bindTexture() const {
    if (array_) glBindTextureUnit(shaders::kDrawnSkinsUnit, array_->name());
}

void DrawnSkins::bindTable() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, shaders::kDrawnLayersBlock, table_.name());
}

}  // namespace aquarama::surface
