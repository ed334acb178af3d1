// SPDX-License-Identifier: Apache-2.0
// A shader's text with the files that it includes, and its errors as places in those files.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace aquarama::gl {

struct ShaderText {
    struct Place {
        std::string file;
        int line = 0;  // from 1
    };
    std::string text;            // with its #version
    std::vector<Place> sources;  // of each line, from the first
};

// The text of a file of this name; throws Error where there is none.
using ReadShader = std::function<std::string_view(std::string_view name)>;

// Includes `by` wherever a file says #include "file": so one shader serves several species and
// tiers.
struct Replacement {
    std::string file, by;
};
using Replacements = std::vector<Replacement>;

// "#version 450 core" and the file, its #include "name" lines expanded.
[[nodiscard]] ShaderText expand(std::string_view name,
                                const ReadShader& read,
                                const Replacements& replacements = {});

// A driver's log with places in files, "water.glsl:12", for the lines of the text that drivers
// write as 0:40, NVIDIA's as 0(40). The text has no #line for them: Mesa loses its file where an
// error is found after parsing.
[[nodiscard]] std::string withFiles(const std::string& log, const ShaderText& shader);

}  // namespace aquarama::gl
