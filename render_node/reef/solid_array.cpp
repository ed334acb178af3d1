// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/solid_array.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "common/base/derived_cache.h"
#include "common/base/hash.h"
#include "render_node/gl/handle.h"
#include "render_node/reef/angles.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Filter and wrap of a texture.
void setSampling(unsigned name, int levels, Edge edge) {
    const GLenum wrap = edge == Edge::Repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    const GLenum shrink = levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR;
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(shrink));
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap));
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap));
}

}  // namespace

gl::Texture makeTexture(GLenum format, glm::ivec2 size, int levels, Edge edge) {
    assert(levels >= 1);
    assert(size.x > 0);
    assert(size.y > 0);
    gl::Texture texture{static_cast<GLenum>(GL_TEXTURE_2D)};
    glTextureStorage2D(texture.name(), levels, format, size.x, size.y);
    setSampling(texture.name(), levels, edge);
    return texture;
}

gl::Texture makeTexture(const Table& table) {
    const GLenum target = table.layers > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    gl::Texture texture{target};
    if (table.layers > 1)
        glTextureStorage3D(texture.name(), 1, GL_RGBA16F, table.width, table.height, table.layers);
    else
        glTextureStorage2D(texture.name(), 1, GL_RGBA16F, table.width, table.height);
    setSampling(texture.name(), 1, Edge::Clamp);
    refill(texture, table);
    return texture;
}

gl::Texture makeVolume(const Table& table) {
    gl::Texture texture{static_cast<GLenum>(GL_TEXTURE_3D)};
    glTextureStorage3D(texture.name(), 1, GL_RGBA16F, table.width, table.height, table.layers);
    setSampling(texture.name(), 1, Edge::Clamp);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    refill(texture, table);
    return texture;
}

void refill(const gl::Texture& texture, const Table& table) {
    assert(table.texels.size() == static_cast<std::size_t>(table.width) *
                                      static_cast<std::size_t>(table.height) *
                                      static_cast<std::size_t>(table.layers));
    const void* texels = table.texels.data();
    if (table.layers > 1)
        glTextureSubImage3D(texture.name(),
                            0,
                            0,
                            0,
                            0,
                            table.width,
                            table.height,
                            table.layers,
                            GL_RGB,
                            GL_FLOAT,
                            texels);
    else
        glTextureSubImage2D(
            texture.name(), 0, 0, 0, table.width, table.height, GL_RGB, GL_FLOAT, texels);
}

gl::Framebuffer makeTarget(const gl::Texture& colour) {
    gl::Framebuffer framebuffer;
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, colour.name(), 0);
    return framebuffer;
}

namespace {

// Value noise, -1 to 1, with so many lattice cells on the tile, so that it repeats. uv: in tiles.
float tiled(std::uint32_t seed, glm::vec2 uv, int cells) {
    const glm::vec2 place = uv * static_cast<float>(cells);
    const glm::vec2 cell = glm::floor(place);
    const glm::vec2 t = place - cell;
    const glm::vec2 s = t * t * (3.0F - 2.0F * t);
    const auto corner = [&](int x, int y) {
        const int column = ((static_cast<int>(cell.x) + x) % cells + cells) % cells;
        const int row = ((static_cast<int>(cell.y) + y) % cells + cells) % cells;
        return signedUnitOf(hashOf(hashOf(seed, static_cast<std::uint32_t>(column)),
                                   static_cast<std::uint32_t>(row)));
    };
    return glm::mix(
        glm::mix(corner(0, 0), corner(1, 0), s.x), glm::mix(corner(0, 1), corner(1, 1), s.x), s.y);
}

// The relief at a point of a tile. albedo: 1 is the mean; crest: 0 hollow to 1 crest.
struct Relief {
    // Metres.
    float height = 0.0F;
    float albedo = 1.0F;
    float crest = 0.5F;
};

// Sand: ripples of the swell (about 0.24 m apart, 16 mm high, with sharp crests and wide troughs),
// grains and shells.
Relief sandAt(glm::vec2 uv) {
    const float bent = 0.9F * tiled(1, uv, 3) + 0.45F * tiled(2, uv, 7) + 0.15F * tiled(3, uv, 17);
    const float crest = 0.5F + 0.5F * std::sin(kTwoPi * (10.0F * uv.x + 4.0F * uv.y) + 4.6F * bent);
    const float sharp = 1.0F - std::pow(1.0F - crest, 1.6F);
    const float amount = glm::clamp(0.5F + 0.75F * tiled(4, uv, 4), 0.0F, 1.0F);
    const float grains = tiled(5, uv, 110) + 0.7F * tiled(6, uv, 220);
    const float shell = tiled(7, uv, 160) > 0.93F ? 0.55F : 0.0F;
    const float dark = tiled(8, uv, 190) > 0.94F ? 0.4F : 0.0F;
    Relief relief;
    relief.height = 0.016F * amount * sharp + 0.0012F * grains;
    relief.albedo = 0.90F + 0.09F * sharp + 0.05F * grains + 0.06F * tiled(9, uv, 9) + shell - dark;
    relief.crest = sharp;
    return relief;
}

// Cellular noise: distance to the nearest of points scattered one to a cell, in cells. The nine
// cells about a place are searched. uv: in tiles.
float toNearest(std::uint32_t seed, glm::vec2 uv, int cells) {
    const glm::vec2 place = uv * static_cast<float>(cells);
    const glm::ivec2 cell{glm::floor(place)};
    float nearest2 = 4.0F;
    for (int i = 0; i < 9; ++i) {
        const glm::ivec2 at = cell + glm::ivec2{i % 3 - 1, i / 3 - 1};
        const glm::ivec2 on = (at % cells + cells) % cells;
        const std::uint32_t hash = hashOf(hashOf(seed, static_cast<std::uint32_t>(on.x)),
                                          static_cast<std::uint32_t>(on.y));
        const glm::vec2 way = glm::vec2(at) + glm::vec2{unitOf(hash), unitOf(hashOf(hash))} - place;
        nearest2 = std::min(nearest2, glm::dot(way, way));
    }
    return std::sqrt(nearest2);
}

// Limestone built by corals and bored by worms: knobs with pits between them, cracks, grit.
Relief rockAt(glm::vec2 uv) {
    const glm::vec2 bent = uv + 0.02F * glm::vec2{tiled(11, uv, 7), tiled(12, uv, 7)};
    const float lumps = tiled(13, bent, 5);
    const float crack = glm::smoothstep(0.0F, 0.16F, std::abs(tiled(14, bent, 8)));
    const float knob = 1.0F - toNearest(17, bent, 17);
    const float pit = glm::smoothstep(0.12F, 0.42F, toNearest(18, bent, 31));
    const float grain = 1.0F - toNearest(19, uv, 84);
    const float grit = tiled(15, uv, 128);
    Relief relief;
    relief.height = 0.022F * lumps + 0.013F * knob + 0.006F * pit + 0.008F * crack +
                    0.0025F * grain + 0.0006F * grit;
    relief.crest =
        glm::clamp(0.16F * lumps + 0.50F * knob + 0.30F * pit + 0.24F * crack - 0.16F, 0.0F, 1.0F);
    relief.albedo = 0.30F + 0.42F * knob + 0.26F * pit + 0.20F * crack + 0.30F * grain +
                    0.12F * grit + 0.26F * tiled(16, uv, 26);
    return relief;
}

// A share in 255ths.
glm::u8 packed(float x) {
    return static_cast<glm::u8>(glm::round(glm::clamp(x, 0.0F, 1.0F) * 255.0F));
}

// Evaluates the relief at each texel, then its slopes by central differences across the edges.
template <class ReliefAt>
Tile tileOf(float sideMetres, ReliefAt reliefAt) {
    constexpr int kTexels = shaders::kDetailTexels;
    const auto side = static_cast<std::size_t>(kTexels);
    std::vector<Relief> reliefs;
    reliefs.reserve(side * side);
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x)
            reliefs.push_back(reliefAt((glm::vec2{x, y} + 0.5F) / static_cast<float>(kTexels)));
    const auto heightAt = [&](int x, int y) {
        const auto column = static_cast<std::size_t>((x + kTexels) % kTexels);
        const auto row = static_cast<std::size_t>((y + kTexels) % kTexels);
        return reliefs[row * side + column].height;
    };
    // Metres between the two neighbours of a texel.
    const float twoTexels = 2.0F * sideMetres / static_cast<float>(kTexels);
    Tile tile;
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) {
            const float slopeX = (heightAt(x + 1, y) - heightAt(x - 1, y)) / twoTexels;
            const float slopeZ = (heightAt(x, y + 1) - heightAt(x, y - 1)) / twoTexels;
            const Relief& relief = reliefs[tile.values.size()];
            // Slopes from -1 to 1, albedos up to twice the mean.
            tile.values.emplace_back(packed(0.5F + 0.5F * slopeX),
                                     packed(0.5F + 0.5F * slopeZ),
                                     packed(0.5F * relief.albedo),
                                     packed(relief.crest));
        }
    return tile;
}

// The tile from the cache of derived data. The name is its key.
template <class ReliefAt>
Tile keptTile(const char* name, float sideMetres, ReliefAt reliefAt) {
    return derivedTables<Tile>(DerivedKey(name), [&] { return tileOf(sideMetres, reliefAt); });
}

}  // namespace

Tile sandTile() {
    return keptTile("sand", shaders::kSandTileMetres, sandAt);
}
Tile rockTile() {
    return keptTile("rock", shaders::kRockTileMetres, rockAt);
}

namespace {

// Where a vertex array reads a struct: the name of the array, and its buffer.
struct Source {
    unsigned array;
    unsigned binding;
};

// A float attribute of the struct; bytes are normalised.
void setAttribute(
    const Source& source, unsigned location, GLint size, GLenum type, std::size_t offset) {
    const bool normalised = type != GL_FLOAT;
    glEnableVertexArrayAttrib(source.array, location);
    glVertexArrayAttribFormat(source.array,
                              location,
                              size,
                              type,
                              normalised ? GL_TRUE : GL_FALSE,
                              static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(source.array, location, source.binding);
}

}  // namespace

void setSolids(const gl::VertexArray& array,
               gl::Buffer& vertices,
               gl::Buffer& indices,
               const std::vector<SolidVertex>& meshVertices,
               const std::vector<std::uint32_t>& meshIndices) {
    vertices = gl::makeBuffer(meshVertices, "solid vertices");
    indices = gl::makeBuffer(meshIndices, "solid indices");
    glVertexArrayVertexBuffer(array.name(), 0, vertices.name(), 0, sizeof(SolidVertex));
    glVertexArrayElementBuffer(array.name(), indices.name());
    const Source source{array.name(), 0};
    setAttribute(source, 0, 3, GL_FLOAT, offsetof(SolidVertex, position));
    setAttribute(source, 1, 4, GL_BYTE, offsetof(SolidVertex, normal));
    setAttribute(source, 2, 4, GL_UNSIGNED_BYTE, offsetof(SolidVertex, albedo));
    setAttribute(source, 3, 4, GL_UNSIGNED_BYTE, offsetof(SolidVertex, response));
}

void attachCoarse(const gl::VertexArray& array, const gl::Buffer& coarse) {
    constexpr unsigned kFirst = shaders::kCoarseAttribute;
    glVertexArrayVertexBuffer(array.name(), kFirst, coarse.name(), 0, sizeof(CoarseVertex));
    const Source source{array.name(), kFirst};
    setAttribute(source, kFirst, 3, GL_FLOAT, offsetof(CoarseVertex, position));
    setAttribute(source, kFirst + 1, 4, GL_BYTE, offsetof(CoarseVertex, normal));
    setAttribute(source, kFirst + 2, 4, GL_UNSIGNED_BYTE, offsetof(CoarseVertex, albedo));
}

gl::Texture makeTexture(const Tile& tile) {
    gl::Texture texture =
        makeTexture(GL_RGBA8, glm::ivec2{shaders::kDetailTexels}, 8, Edge::Repeat);
    glTextureSubImage2D(texture.name(),
                        0,
                        0,
                        0,
                        shaders::kDetailTexels,
                        shaders::kDetailTexels,
                        GL_RGBA,
                        GL_UNSIGNED_BYTE,
                        tile.values.data());
    glGenerateTextureMipmap(texture.name());
    return texture;
}

}  // namespace aquarama::scene
