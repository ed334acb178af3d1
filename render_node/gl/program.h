// SPDX-License-Identifier: Apache-2.0
// Shader programs from the files of render_node/shaders, which are embedded at build time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render_node/gl/handle.h"
#include "render_node/gl/shader_text.h"

namespace aquarama::gl {

// The text of a file of render_node/shaders. Throws Error for an unknown name.
[[nodiscard]] std::string_view shaderSource(std::string_view name);
[[nodiscard]] std::vector<std::string_view> shaderNames();  // every embedded file

struct ShaderTraits {
    static unsigned create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(unsigned name) { glDeleteShader(name); }
};
using ShaderHandle = Handle<ShaderTraits>;

// The stage follows from the ending: .vert .frag .comp. Throws Error with the driver's log, which
// names file and line of each mistake, also in an included file.
[[nodiscard]] ShaderHandle compileShader(const std::string& file,
                                         const Replacements& replacements = {},
                                         const ReadShader& read = shaderSource);

// Compiles and links, or takes the driver's binary of an earlier time from this user's cache; the
// first name labels the program. Throws Error as above.
[[nodiscard]] ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                                        const Replacements& replacements = {});

}  // namespace aquarama::gl
