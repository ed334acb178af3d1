// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/program.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "common/units/error.h"
#include "render_node/gl/embedded_shaders.h"

namespace aquarama::gl {

namespace {

thread_local std::string definitions;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

const EmbeddedShader& embedded(std::string_view name) {
    const auto shaders = embeddedShaders();
    const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
    if (found == shaders.end())
        throw Error("no shader file named \"" + std::string(name) + "\" in render_node/shaders");
    return *found;
}

GLenum stageOf(const std::string& file) {
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    if (file.ends_with(".comp")) return GL_COMPUTE_SHADER;
    throw Error("shader file \"" + file + "\" must end in .vert, .frag or .comp");
}

struct ShaderTraits {
    static unsigned create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(unsigned name) { glDeleteShader(name); }
};

Handle<ShaderTraits> compile(const std::string& file, std::span<const Replacement> replacements) {
    const std::string source =
        "#version 450 core\n" + definitions + shaderSource(file, replacements);
    const char* text = source.c_str();
    Handle<ShaderTraits> shader{stageOf(file)};
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    int compiled = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        std::array<char, 4096> log{};
        glGetShaderInfoLog(shader.name(), log.size(), nullptr, log.data());
        throw Error("render_node/shaders/" + file + " does not compile: " + log.data());
    }
    return shader;
}

}  // namespace

Definitions::Definitions(std::string lines)
    : outer_{std::exchange(definitions, std::move(lines))} {}

Definitions::~Definitions() {
    definitions = std::move(outer_);
}

std::string shaderSource(std::string_view name, std::span<const Replacement> replacements) {
    constexpr std::string_view kInclude = "#include \"";
    std::string expanded;
    std::string_view rest = embedded(name).text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end);
        if (line.starts_with(kInclude)) {
            const std::string_view file =
                line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
            const auto replaced = std::ranges::find(replacements, file, &Replacement::file);
            expanded +=
                shaderSource(replaced == replacements.end() ? file : replaced->by, replacements);
        } else {
            expanded += line;
        }
    }
    return expanded;
}

std::vector<std::string_view> shaderNames() {
    std::vector<std::string_view> names;
    for (const EmbeddedShader& shader : embeddedShaders()) names.push_back(shader.name);
    return names;
}

ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                          std::span<const Replacement> replacements) {
    ProgramHandle program;
    for (const std::string& file : shaderFiles) {
        const auto shader = compile(file, replacements);
        glAttachShader(program.name(), shader.name());
    }
    glLinkProgram(program.name());
    int linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == 0) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program.name(), log.size(), nullptr, log.data());
        throw Error("render_node/shaders/" + shaderFiles.front() + " does not link: " + log.data());
    }
    glObjectLabel(GL_PROGRAM, program.name(), -1, shaderFiles.front().c_str());
    return program;
}

}  // namespace aquarama::gl
