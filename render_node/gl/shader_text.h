// SPDX-License-Identifier: Apache-2.0
// A shader's text with the files that it includes, and its errors as places in those files.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace aquarama::gl {

struct ShaderText {
    std::string text;                // with its #version; #line says where each line came from
    std::vector<std::string> files;  // by the numbers that #line gives them
};

// The text of a file of this name; throws Error where there is none.
using ReadShader = std::function<std::string_view(std::string_view name)>;

// "#version 450 core" and the file, its #include "name" lines expanded.
[[nodiscard]] ShaderText expand(std::string_view name, const ReadShader& read);

// A driver's log with files in place of their numbers, "water.glsl:12" for what Mesa writes as
// 2:12, NVIDIA as 2(12) and others as ERROR: 2:12.
[[nodiscard]] std::string withFiles(const std::string& log, const std::vector<std::string>& files);

}  // namespace aquarama::gl
