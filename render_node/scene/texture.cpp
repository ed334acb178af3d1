// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/texture.h"

namespace aquarama::scene {

namespace {

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

}  // namespace aquarama::scene
