// SPDX-License-Identifier: Apache-2.0
// The files of render_node/shaders as strings; the definition is generated at build time
// (cmake/EmbedShaders.cmake).
#pragma once

#include <span>
#include <string_view>

namespace aquarama::gl {

struct EmbeddedShader {
    std::string_view name;
    std::string_view text;
};

[[nodiscard]] std::span<const EmbeddedShader> embeddedShaders();

}  // namespace aquarama::gl
