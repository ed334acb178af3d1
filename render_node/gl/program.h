// SPDX-License-Identifier: Apache-2.0
// Diagnostics of OpenGL, and programs from the shader files that are embedded in the node.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

// Writes the driver's errors and warnings to the log from now on, for the current context, at the
// call that causes them (synchronous output). For development: it costs time.
void logMessages();

// Names a stage of the frame until the end of the scope. Graphics debuggers and profilers show the
// name, and tests/bench/gpu measures the time between. Stages nest.
class Stage {
  public:
    explicit Stage(const char* name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

// Text of a shader with its includes expanded, and its errors mapped back to the files.

// The expanded text. sources has one entry for each line of text, in order.
struct ShaderText {
    // A line of a shader file.
    struct Place {
        std::string file;
        int line = 0;  // from 1
    };
    // Starts with the #version line.
    std::string text;
    // Origin of each line of text, from the first.
    std::vector<Place> sources;
};

// Returns the text of the shader file of this name; throws Error where there is none. The text must
// outlive the expansion.
using ReadShader = std::function<std::string_view(std::string_view name)>;

// Includes file `by` wherever a shader says #include "file". In this way one shader serves several
// species and quality tiers.
struct Replacement {
    std::string file, by;
};
using Replacements = std::vector<Replacement>;

// "#version 450 core" and the text of the file, its #include "name" lines expanded recursively.
// There are no include guards but those in the files themselves; #include lines are expanded even
// inside #if blocks that are false.
[[nodiscard]] ShaderText expand(std::string_view name,
                                const ReadShader& read,
                                const Replacements& replacements = {});

// Replaces the places in a driver's log by places in the files, as "water.glsl:12". Drivers write a
// line of the text as 0:40, NVIDIA as 0(40). We do not use #line: Mesa loses the file name where an
// error is found after parsing.
[[nodiscard]] std::string withFiles(const std::string& log, const ShaderText& shader);

// The files of render_node/shaders as strings. The array is generated at build time
// (cmake/EmbedShaders.cmake) and lives as long as the program.

// One file: its name without folder, and its text.
struct EmbeddedShader {
    std::string_view name;
    std::string_view text;
};

// The sources of all shaders of the program.
[[nodiscard]] std::span<const EmbeddedShader> embeddedShaders();

// Programs from the embedded files.

// The text of a file of render_node/shaders. Throws Error for an unknown name.
[[nodiscard]] std::string_view shaderSource(std::string_view name);
// The names of all embedded files.
[[nodiscard]] std::vector<std::string_view> shaderNames();

// For Handle: a shader object of one stage.
struct ShaderTraits {
    // Makes an object, and deletes it.
    static unsigned create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(unsigned name) { glDeleteShader(name); }
};
using ShaderHandle = Handle<ShaderTraits>;

// Compiles one shader. Its stage follows from the ending of the name: .vert .frag .comp. Throws
// Error with the driver's log, which names file and line of each mistake, also in an included file.
[[nodiscard]] ShaderHandle compileShader(const std::string& file,
                                         const Replacements& replacements = {},
                                         const ReadShader& read = shaderSource);

// Compiles and links the shaders, or loads the driver's binary that an earlier run of this user has
// cached. The names, and those of the replacements, label the program. Needs a current context.
// Throws Error as above.
[[nodiscard]] ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                                        const Replacements& replacements = {});

}  // namespace aquarama::gl
