// SPDX-License-Identifier: Apache-2.0
// Immutable textures with the filters that the scene uses.
#pragma once

#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render_node/gl/handle.h"
#include "render_node/scene/water_tables.h"

namespace aquarama::scene {

enum class Edge : std::uint8_t { Clamp, Repeat };

// levels > 1: trilinear.
[[nodiscard]] gl::Texture makeTexture(GLenum format, glm::ivec2 size, int levels, Edge edge);
// A table as RGBA16F, an array where it has layers.
[[nodiscard]] gl::Texture makeTexture(const Table& table);
// One that is read smoothly between its layers, too.
[[nodiscard]] gl::Texture makeVolume(const Table& table);
void refill(const gl::Texture& texture, const Table& table);
[[nodiscard]] gl::Framebuffer makeTarget(const gl::Texture& colour);

}  // namespace aquarama::scene
