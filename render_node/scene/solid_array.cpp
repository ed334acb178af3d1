// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/solid_array.h"

#include <cstddef>

#include "render_node/gl/buffer.h"
#include "render_node/scene/texture.h"

namespace aquarama::scene {

namespace {

void setAttribute(unsigned array, unsigned location, GLint size, GLenum type, std::size_t offset) {
    const bool normalised = type != GL_FLOAT;
    glEnableVertexArrayAttrib(array, location);
    glVertexArrayAttribFormat(
        array, location, size, type, normalised ? GL_TRUE : GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, location, 0);
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
    setAttribute(array.name(), 0, 3, GL_FLOAT, offsetof(SolidVertex, position));
    setAttribute(array.name(), 1, 4, GL_BYTE, offsetof(SolidVertex, normal));
    setAttribute(array.name(), 2, 4, GL_UNSIGNED_BYTE, offsetof(SolidVertex, albedo));
    setAttribute(array.name(), 3, 4, GL_UNSIGNED_BYTE, offsetof(SolidVertex, response));
}

gl::Texture makeTexture(const Tile& tile) {
    gl::Texture texture = makeTexture(GL_RGBA8, glm::ivec2{kDetailTexels}, 8, Edge::Repeat);
    glTextureSubImage2D(texture.name(),
                        0,
                        0,
                        0,
                        kDetailTexels,
                        kDetailTexels,
                        GL_RGBA,
                        GL_UNSIGNED_BYTE,
                        tile.values.data());
    glGenerateTextureMipmap(texture.name());
    return texture;
}

}  // namespace aquarama::scene
