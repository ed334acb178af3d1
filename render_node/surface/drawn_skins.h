// SPDX-License-Identifier: Apache-2.0
// The skins that visitors have painted, on the GPU: an array of textures, and the table by which
// shaders find the layer of a number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/body/side_skin.h"
#include "render_node/gl/handle.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::surface {

// The array has as many layers as were ever needed at once, rounded up to a power of two. Owns its
// GL objects; construct, use and destroy it with the same context current.
class DrawnSkins {
  public:
    // leftOut: how many of the finest levels are left out, to save memory.
    explicit DrawnSkins(std::size_t leftOut);
    // These from now on. Others give up their layers; of those that are new, those with the lowest
    // numbers are uploaded, `most` at once. Takes memory only where the array has to grow.
    void wear(const body::SkinsByNumber& skins, std::size_t most);
    // Binds the table, for drawn_layers.glsl.
    void bindTable() const;
    // Binds the array, where there is one, for drawn_skin.glsl.
    void bindTexture() const;
    [[nodiscard]] bool isEmpty() const { return !array_; }

  private:
    // Free where `skin` is null.
    struct Layer {
        std::uint32_t number = 0;
        std::shared_ptr<const body::SideSkin> skin;
    };
    // DrawnLayers of drawn_layers.glsl, std140.
    struct Table {
        std::array<std::uint32_t, shaders::kMostDrawn> numbers{};
        std::uint32_t layers = 0;
        std::array<std::uint32_t, 3> padding{};
    };
    // Whether there were any.
    bool dropOthers(const body::SkinsByNumber& skins);
    [[nodiscard]] bool isWorn(std::uint32_t number) const;
    [[nodiscard]] std::size_t freeLayer();
    void grow();
    void upload(std::size_t layer, const body::SideSkin& skin) const;
    void tell() const;

    std::size_t leftOut_;
    std::vector<Layer> layers_;
    std::optional<gl::Texture> array_;
    gl::Buffer table_;
};

}  // namespace aquarama::surface
