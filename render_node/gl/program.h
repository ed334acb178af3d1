// SPDX-License-Identifier: Apache-2.0
// What the driver has to say about our mistakes, and what we tell those who look into a frame.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

// Writes the driver's errors and warnings to the log from now on, for the current context.
void logMessages();

// A stage of the frame, to the end of the scope: debuggers and profilers of graphics show it by its
// name, and tests/bench/gpu takes its time.
class Stage {
  public:
    explicit Stage(const char* name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

// A shader's text with the files that it includes, and its errors as places in those files.

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

// The files of render_node/shaders as strings; the definition is generated at build time
// (cmake/EmbedShaders.cmake).

struct EmbeddedShader {
    std::string_view name;
    std::string_view text;
};

[[nodiscard]] std::span<const EmbeddedShader> embeddedShaders();

// Shader programs from the files of render_node/shaders, which are embedded at build time.

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
