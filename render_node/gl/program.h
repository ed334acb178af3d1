// SPDX-License-Identifier: Apache-2.0
// Shader programs from the files of render_node/shaders, which are embedded at build time.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

// Includes `by` wherever a file says #include "file": so one shader serves several painters.
struct Replacement {
    std::string_view file, by;
};

// The text of a file of render_node/shaders, with its #include "name" lines expanded. Throws Error
// for an unknown name.
[[nodiscard]] std::string shaderSource(std::string_view name,
                                       std::span<const Replacement> replacements = {});
[[nodiscard]] std::vector<std::string_view> shaderNames();  // every embedded file

// Compiles and links; the stage follows from the ending: .vert .frag .comp. "#version 450 core" is
// put in front. Throws Error with the driver's log. The first name labels the program.
[[nodiscard]] ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                                        std::span<const Replacement> replacements = {});

}  // namespace aquarama::gl
